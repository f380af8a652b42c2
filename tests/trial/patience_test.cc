// A run without patience tells, trial by trial, what a run with some gives.
#include <gtest/gtest.h>

#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

constexpr std::uint32_t kTrials = 40;

struct Patience {
  double distance_m = 0.0;
  double turn_deg = 0.0;
};

// So long that it decides nothing but a drive that goes round for ever.
constexpr Patience kNone{1000.0, 36000.0};

std::vector<DriveResult> Drive(const Patience& patience) {
  return RunTrials(
      Pathfinder("nominal",
                 {"rover.fidelity=quasi_static", "terrain.rocks.k_per_m2=0.006",
                  "referee.no_path_time_s=0", "referee.time_limit_s=0", "energy.battery_wh=0",
                  "referee.no_path_distance_m=" + std::to_string(patience.distance_m),
                  "referee.no_path_turn_deg=" + std::to_string(patience.turn_deg)}),
      kTrials);
}

TrialOutcome Under(const Patience& patience, const DriveResult& result) {
  const bool ended = result.record.no_progress_distance_m > patience.distance_m ||
                     result.record.no_progress_turn_deg > patience.turn_deg;
  return ended ? TrialOutcome::kNoPath : result.outcome;
}

// Trials whose outcome the columns of a run without patience do not tell.
int WrongOf(const std::vector<DriveResult>& without, const Patience& told,
            const std::vector<DriveResult>& driven) {
  int wrong = 0;
  for (std::uint32_t i = 0; i < kTrials; ++i) {
    if (Under(told, without[i]) != driven[i].outcome) ++wrong;
  }
  return wrong;
}

class PatienceTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { without_ = Drive(kNone); }

  static std::vector<DriveResult> without_;
};

std::vector<DriveResult> PatienceTest::without_;

TEST_F(PatienceTest, ColumnsTellWhatIsDriven) {
  for (const Patience& patience :
       {Patience{4.0, 1080.0}, Patience{2.0, 36000.0}, Patience{1000.0, 720.0}}) {
    const std::vector<DriveResult> driven = Drive(patience);
    EXPECT_EQ(WrongOf(without_, patience, driven), 0);
    EXPECT_GT(WrongOf(without_, kNone, driven), 0);  // the patience has decided something
  }
}

TEST_F(PatienceTest, AnotherPatienceIsTold) {
  EXPECT_GT(WrongOf(without_, {1.0, 1080.0}, Drive({4.0, 1080.0})), 0);
}

// Below the patience everything is as it is without, to the last bit.
TEST_F(PatienceTest, ItChangesNothingBeforeTheVerdict) {
  const std::vector<DriveResult> driven = Drive({4.0, 1080.0});
  for (std::uint32_t i = 0; i < kTrials; ++i) {
    if (driven[i].outcome == TrialOutcome::kNoPath) continue;
    EXPECT_TRUE(Differences(without_[i], driven[i]).empty()) << i;
  }
}

}  // namespace
}  // namespace rockyard::trial
