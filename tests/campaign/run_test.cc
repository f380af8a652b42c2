// Campaigns of real trials, run as a program would that has no command line.
#include "campaign/run.h"

#include <gmock/gmock.h>

#include <atomic>
#include <optional>
#include <variant>

#include "batch/run_folder.h"
#include "campaign/run_source.h"
#include "campaign/small_runs.h"
#include "report/paired_comparison.h"

namespace rockyard::campaign {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST_F(SmallRuns, ARunTellsAndReturnsWhatHappened) {
  int looks = 0;
  int ends = 0;
  std::vector<FolderReport> reports;
  RunObserver observer;
  observer.trials = [&](const batch::Progress& progress, Moment moment) {
    ++(moment == Moment::kEnd ? ends : looks);
    EXPECT_LE(progress.finished, 6);
  };
  observer.reported = [&](const FolderReport& report, batch::BatchEnd end) {
    EXPECT_EQ(end, batch::BatchEnd::kFinished);
    reports.push_back(report);
  };
  const WorkResult result = campaign::Run(Request("a", 6), observer);
  EXPECT_EQ(result.outcome, Outcome::kDone);
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.folder, Path("a"));
  EXPECT_EQ(result.trials.planned, 6);
  EXPECT_EQ(result.trials.finished, 6);
  EXPECT_EQ(result.trials.faults, 0);
  EXPECT_GE(looks, 1);
  EXPECT_EQ(ends, 1);
  ASSERT_THAT(reports, SizeIs(1));
  const auto& drives =
      std::get<statistics::DriveSummary>(std::get<RunReport>(reports.front()).summary);
  EXPECT_EQ(drives.completed, 6);
  EXPECT_TRUE(std::filesystem::exists(Path("a") / "summary.json"));
}

TEST_F(SmallRuns, StoppedAndResumedIsTheUninterruptedRun) {
  ASSERT_EQ(campaign::Run(Request("whole", 8)).outcome, Outcome::kDone);
  // The first time before any trial, then after each.
  std::atomic<int> asked = 0;
  const Stop stop{.wanted = [&] { return ++asked > 3; }};
  const WorkResult stopped = campaign::Run(Request("parts", 8), {}, stop);
  EXPECT_EQ(stopped.outcome, Outcome::kInterrupted);
  EXPECT_GE(stopped.trials.finished, 1);
  EXPECT_LE(stopped.trials.finished, 3);
  EXPECT_THAT(stopped.notes, Contains(Field(&Note::text, HasSubstr("of 8 trials are stored"))));

  RunRequest rest = Request("parts", 8);
  rest.campaign.existing = ExistingRun::kResume;
  const WorkResult resumed = campaign::Run(rest);
  EXPECT_EQ(resumed.outcome, Outcome::kDone);
  EXPECT_THAT(resumed.notes, Contains(Field(&Note::text, HasSubstr("going on with"))));
  EXPECT_EQ(Hash("parts"), Hash("whole"));
}

// A store of a program that took a short memory for a fault of the simulator.
TEST_F(SmallRuns, FaultsAreDrivenAgainWhereItIsAsked) {
  ASSERT_EQ(campaign::Run(Request("whole", 3)).outcome, Outcome::kDone);
  ASSERT_EQ(campaign::Run(Request("old", 2)).outcome, Outcome::kDone);
  {
    batch::ResultStore store =
        batch::ResultStore::Resume(Path("old"), batch::ResultStore::Read(Path("old")).identity());
    store.SetPlanned(0, 3);
    batch::AppendRecords(store, {{2, truth::TrialOutcome::kSimulatorFault, "std::bad_alloc", {}}});
  }
  RunRequest request = Request("old", 3);
  request.campaign.existing = ExistingRun::kResume;
  EXPECT_EQ(campaign::Run(request).outcome, Outcome::kTooManyFaults);
  RunRequest fresh = Request("new", 1);
  fresh.campaign.existing = ExistingRun::kResume;
  fresh.campaign.retry_faults = true;
  EXPECT_THAT(campaign::Run(fresh).notes, Contains(Field(&Note::text, HasSubstr("no fault to"))));
  for (const bool supervised : {true, false}) {  // the second finds none
    request.campaign.retry_faults = true;
    request.campaign.containment.supervisor = supervised;
    const WorkResult result = campaign::Run(request);
    EXPECT_EQ(result.outcome, Outcome::kDone);
    EXPECT_THAT(result.notes,
                Contains(Field(&Note::text, HasSubstr(supervised ? "again: 1" : "again: 0"))));
    EXPECT_EQ(Hash("old"), Hash("whole"));
  }
  const auto faults = batch::ResultStore::Read(Path("old")).InfrastructureFaults();
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_EQ(faults[0].id.trial, 2);
  EXPECT_EQ(faults[0].detail, "std::bad_alloc");
}

// What a worker process tells comes back to the one that asked for it.
TEST_F(SmallRuns, ASupervisedRunIsTheSame) {
  RunRequest request = Request("supervised", 5);
  request.campaign.containment.supervisor = true;
  const WorkResult result = campaign::Run(request);
  EXPECT_EQ(result.outcome, Outcome::kDone);
  EXPECT_EQ(result.folder, Path("supervised"));
  EXPECT_EQ(result.trials.finished, 5);
  const WorkResult again = campaign::Run(request);
  EXPECT_EQ(again.outcome, Outcome::kBadInput);
  ASSERT_THAT(again.problems, SizeIs(1));
  EXPECT_EQ(again.problems.front().reason, "holds a run already");
  ASSERT_EQ(campaign::Run(Request("plain", 5)).outcome, Outcome::kDone);
  EXPECT_EQ(Hash("supervised"), Hash("plain"));
}

TEST_F(SmallRuns, WhatIsWrongWithARequestIsAValue) {
  RunRequest missing = Request("a", 2);
  missing.source = Path("nowhere.json");
  RunRequest mistyped = Request("a", 2);
  mistyped.campaign.overrides = {"rover.fidelity=none", "referee.time_limit=1"};
  RunRequest shard = Part("a", 2, "3/2");
  for (const RunRequest& request : {missing, mistyped, shard}) {
    std::vector<core::Problem> told;
    RunObserver observer;
    observer.problems = [&](const std::vector<core::Problem>& problems) { told = problems; };
    const WorkResult result = campaign::Run(request, observer);
    EXPECT_EQ(result.outcome, Outcome::kBadInput);
    EXPECT_THAT(result.problems, Not(IsEmpty()));
    EXPECT_EQ(told.size(), result.problems.size());
    EXPECT_FALSE(std::filesystem::exists(Path("a")));
    EXPECT_FALSE(Rehearse(request).ok());
  }
}

TEST_F(SmallRuns, AFolderInUseIsRefused) {
  std::filesystem::create_directories(Path("a"));
  const batch::FolderClaim claim(Path("a"));
  const WorkResult result = campaign::Run(Request("a", 2));
  EXPECT_EQ(result.outcome, Outcome::kBadInput);
  ASSERT_THAT(result.problems, Not(IsEmpty()));
  EXPECT_THAT(result.problems.front().path, HasSubstr(Path("a").string()));
}

TEST_F(SmallRuns, ARehearsalWritesNothing) {
  RunRequest request = Request("a", 40);
  request.campaign.traces.rules = {"failures"};
  const core::Result<DryRun> told = Rehearse(request);
  ASSERT_TRUE(told.ok());
  EXPECT_EQ(told->planned.total, 40);
  EXPECT_EQ(told->pending, 40);
  EXPECT_GE(told->pilot.trials, 12);
  EXPECT_LE(told->pilot.trials, 40);
  EXPECT_GT(told->memory_B, 1'000'000);
  EXPECT_TRUE(told->traces.failures);
  EXPECT_FALSE(std::filesystem::exists(Path("a")));
}

TEST_F(SmallRuns, TracesAreToldOf) {
  RunRequest request = Request("a", 2);
  request.campaign.traces = {.rules = {"all"}, .format = "csv"};
  std::size_t written = 0;
  Outcome outcome = Outcome::kFailed;
  RunObserver observer;
  observer.traces = [&](const TraceProgress& progress, Moment) { written = progress.written; };
  observer.traced = [&](const std::filesystem::path&, Outcome ended) { outcome = ended; };
  EXPECT_EQ(campaign::Run(request, observer).outcome, Outcome::kDone);
  EXPECT_EQ(written, 2U);
  EXPECT_EQ(outcome, Outcome::kDone);
  EXPECT_TRUE(std::filesystem::exists(Path("a") / "traces" / "trial-000001.csv"));
}

TEST_F(SmallRuns, TracesStopAndGoOn) {
  RunRequest request = Request("a", 4);
  request.campaign.traces = {.rules = {"all"}, .format = "csv"};
  std::size_t written = 0;
  RunObserver observer;
  observer.traces = [&](const TraceProgress& progress, Moment) { written = progress.written; };
  const Stop stop{.wanted = [&] { return written >= 2; }};
  const WorkResult stopped = campaign::Run(request, observer, stop);
  EXPECT_EQ(stopped.outcome, Outcome::kInterrupted);
  EXPECT_EQ(stopped.trials.finished, 4);
  EXPECT_EQ(written, 2U);
  request.campaign.existing = ExistingRun::kResume;
  EXPECT_EQ(campaign::Run(request, observer).outcome, Outcome::kDone);
  EXPECT_EQ(written, 4U);
}

TEST_F(SmallRuns, ColumnsComparedInPartsAreThoseOfTheWhole) {
  RunRequest other = Request("b", 9);
  other.campaign.overrides.emplace_back("rover.drive.speed_m_s=0.1");
  ASSERT_EQ(campaign::Run(Request("a", 12)).outcome, Outcome::kDone);
  ASSERT_EQ(campaign::Run(other).outcome, Outcome::kDone);
  const StoredRun a = ReadRun(Path("a"));
  const StoredRun b = ReadRun(Path("b"));
  const std::string whole =
      report::RunComparisonCsv(report::CompareRuns(ComparedView(a), ComparedView(b)));
  // All columns, some, and one at a time.
  for (const std::size_t values : {10000, 21 * 7, 1}) {
    const report::RunComparison parts =
        CompareDrives(ReadRun(Path("a"), "", StoredValues::kNone),
                      ReadRun(Path("b"), "", StoredValues::kNone), values);
    EXPECT_EQ(report::RunComparisonCsv(parts), whole) << values;
    EXPECT_EQ(parts.pairs, 9);
    EXPECT_EQ(parts.successes.size(), 2u);
  }
}

// What only one run's navigator counts is told once, however the columns are parted.
TEST_F(SmallRuns, ColumnsOfOneRunAreToldOfEachPart) {
  RunRequest own = Request("own", 4);
  own.campaign.overrides.emplace_back(std::string(R"(plugins=[{"library": ")") +
                                      COUNTING_NAVIGATOR + R"("}])");
  own.campaign.overrides.emplace_back("navigation.navigator=counter");
  own.campaign.containment.supervisor = true;  // as a plugin needs
  ASSERT_EQ(campaign::Run(Request("plain", 4)).outcome, Outcome::kDone);
  ASSERT_EQ(campaign::Run(own).outcome, Outcome::kDone);
  const StoredRun counts = ReadRun(Path("own"), "", StoredValues::kNone);
  const StoredRun plain = ReadRun(Path("plain"), "", StoredValues::kNone);
  for (const std::size_t values : {10000, 8 * 7, 1}) {
    const report::RunComparison second = CompareDrives(plain, counts, values);
    EXPECT_THAT(second.only_first, testing::IsEmpty());
    EXPECT_THAT(second.only_second, testing::ElementsAre("counter.decisions", "counter.last_s"));
    const report::RunComparison first = CompareDrives(counts, plain, values);
    EXPECT_EQ(first.only_first, second.only_second);
    EXPECT_EQ(first.columns.size(), second.columns.size());
    EXPECT_THAT(CompareDrives(counts, counts, values).only_first, testing::IsEmpty());
  }
}

TEST_F(SmallRuns, ARunWithoutValuesHasOutcomesAlone) {
  ASSERT_EQ(campaign::Run(Request("a", 3)).outcome, Outcome::kDone);
  const StoredRun run = ReadRun(Path("a"), "", StoredValues::kNone);
  ASSERT_EQ(run.records.size(), 3u);
  EXPECT_EQ(run.records[2].outcome, truth::TrialOutcome::kTimeLimit);
  EXPECT_TRUE(run.records[2].values.empty());
  EXPECT_EQ(run.schema.size(), ReadRun(Path("a")).schema.size());
}

// Sweeps and shards without a command line.

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
