// A drive that somebody steps from outside.
#include <gtest/gtest.h>

#include <optional>

#include "trial/drive/drive.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

void ExpectTheSame(const DriveResult& a, const DriveResult& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.record.true_distance_m, b.record.true_distance_m);
  EXPECT_EQ(a.record.final_x_m, b.record.final_x_m);
  EXPECT_EQ(a.record.believed_x_m, b.record.believed_x_m);
  EXPECT_EQ(a.record.sim_time_s, b.record.sim_time_s);
  EXPECT_EQ(a.record.energy_wh, b.record.energy_wh);
}

// Two drives, a decision of one after a decision of the other, are what each is alone.
TEST(DriveStepTest, SteppedInTurnIsAsRunAlone) {
  const DriveParams drive = Pathfinder("nominal", {"rover.fidelity=quasi_static"});
  Drive first(drive, {1, 0}, nullptr, {});
  Drive second(drive, {1, 1}, nullptr, {});
  std::optional<Verdict> ends[2];
  while (!ends[0] || !ends[1]) {
    if (!ends[0]) ends[0] = first.Step();
    if (!ends[1]) ends[1] = second.Step();
  }
  const DriveResult alone[] = {RunTrial(drive, {1, 0}), RunTrial(drive, {1, 1})};
  ExpectTheSame(first.Finish(*ends[0]), alone[0]);
  ExpectTheSame(second.Finish(*ends[1]), alone[1]);
  EXPECT_NE(alone[0].record.true_distance_m, alone[1].record.true_distance_m);
}

TEST(DriveStepTest, TimePassesWithEachDecisionThatMoves) {
  const DriveParams drive = Pathfinder("nominal", {"rover.fidelity=quasi_static"});
  Drive stepped(drive, {1, 0}, nullptr, {});
  double before_s = stepped.time_s();
  int moved = 0;
  for (int i = 0; i < 20 && !stepped.Step(); ++i) {
    EXPECT_GE(stepped.time_s(), before_s);
    moved += stepped.time_s() > before_s ? 1 : 0;
    before_s = stepped.time_s();
  }
  EXPECT_GE(moved, 10);
}

}  // namespace
}  // namespace rockyard::trial
