// Sweeps and shards without a command line.
#include <gmock/gmock.h>

#include <optional>
#include <variant>

#include "campaign/merge.h"
#include "campaign/small_runs.h"
#include "campaign/sweep.h"

namespace rockyard::campaign {
namespace {

using testing::IsEmpty;
using testing::Not;

class SmallSweeps : public SmallRuns {};

TEST_F(SmallSweeps, ASweepReportsItsCells) {
  std::optional<FolderReport> told;
  RunObserver observer;
  observer.reported = [&](const FolderReport& report, batch::BatchEnd) { told = report; };
  const WorkResult result = RunSweep(SweepOfTwo("a"), observer);
  EXPECT_EQ(result.outcome, Outcome::kDone);
  EXPECT_EQ(result.trials.finished, 6);
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(std::get<SweepReport>(*told).sweep.cells.size(), 2U);
  EXPECT_TRUE(std::filesystem::exists(Path("a") / "cells.csv"));
}

TEST_F(SmallSweeps, ARehearsalWritesAPlan) {
  const core::Result<SweepRehearsal> told = RehearseSweep(SweepOfTwo("plan"), 2);
  ASSERT_TRUE(told.ok());
  EXPECT_EQ(told->trials.total, 6);
  EXPECT_EQ(told->plan.cost.pilots, 4);
  EXPECT_TRUE(std::filesystem::exists(Path("plan") / "plan.json"));
}

TEST_F(SmallSweeps, ABadFileIsAValue) {
  SweepRequest request = SweepOfTwo("a");
  request.file = Path("none.json");
  EXPECT_EQ(RunSweep(request).outcome, Outcome::kBadInput);
  EXPECT_FALSE(RehearseSweep(request, 0).ok());
}

TEST_F(SmallSweeps, MergedPartsAreTheWhole) {
  ASSERT_EQ(campaign::Run(Request("whole", 7)).outcome, Outcome::kDone);
  ASSERT_EQ(campaign::Run(Part("s1", 7, "1/2")).outcome, Outcome::kDone);
  ASSERT_EQ(campaign::Run(Part("s2", 7, "2/2")).outcome, Outcome::kDone);
  std::optional<FolderReport> told;
  MergeObserver observer;
  observer.reported = [&](const FolderReport& report) { told = report; };
  const MergeRequest request{.shards = {Path("s1"), Path("s2")}, .folder = Path("merged")};
  const WorkResult result = Merge(request, observer);
  EXPECT_EQ(result.outcome, Outcome::kDone);
  EXPECT_EQ(result.folder, Path("merged"));
  EXPECT_EQ(Hash("merged"), Hash("whole"));
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(std::get<RunReport>(*told).description.stored, 7);

  // What it made before is there; what it did not make is in the way.
  const WorkResult again = Merge(request);
  EXPECT_EQ(again.outcome, Outcome::kDone);
  EXPECT_THAT(again.problems, IsEmpty());
  const WorkResult other =
      Merge({.shards = {Path("s1")}, .folder = Path("merged"), .partial = true});
  EXPECT_EQ(other.outcome, Outcome::kBadInput);
  EXPECT_THAT(other.problems, Not(IsEmpty()));
}

}  // namespace
}  // namespace rockyard::campaign
