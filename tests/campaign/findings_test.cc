// What stored runs say beside each other, and one of their trials again, without a command line.
#include <gmock/gmock.h>

#include <variant>

#include "campaign/check.h"
#include "campaign/compare.h"
#include "campaign/reference_cases.h"
#include "campaign/replay.h"
#include "campaign/replay_moments.h"
#include "campaign/report.h"
#include "campaign/run.h"
#include "campaign/small_runs.h"
#include "report/atomic_file.h"

namespace rockyard::campaign {
namespace {

using testing::Contains;
using testing::Field;
using testing::IsEmpty;
using testing::Not;

class Findings : public SmallRuns {
 protected:
  void RunTwo() const {
    ASSERT_EQ(campaign::Run(Request("a", 4)).outcome, Outcome::kDone);
    RunRequest slow = Request("b", 4);
    slow.campaign.overrides.push_back("rover.drive.speed_m_s=0.05");
    ASSERT_EQ(campaign::Run(slow).outcome, Outcome::kDone);
  }

  core::Result<report::Baseline> BaselineOf(const std::string& folder) const {
    return MakeBaseline({.runs = {Path(folder).string()}, .name = "b", .reason = "first"});
  }

  CheckRequest CheckOf(const std::string& folder) const {
    return {.runs = {Path(folder).string()}, .reference = Path("baseline.json")};
  }
};

TEST_F(Findings, DrivesAreComparedInPairs) {
  RunTwo();
  const core::Result<Comparison> told = Compare({.first = Path("a"), .second = Path("b")});
  ASSERT_TRUE(told.ok());
  EXPECT_EQ(told->outcome, Outcome::kDone);
  EXPECT_EQ(std::get<report::RunComparison>(told->found).pairs, 4);
  EXPECT_THAT(told->settings,
              Contains(Field(&batch::ScenarioDifference::path, "rover.drive.speed_m_s")));
  EXPECT_FALSE(Compare({.first = Path("a"), .second = Path("none")}).ok());
}

TEST_F(Findings, ARunAgreesWithItsOwnBaselineAndNotWithAnotherScenario) {
  RunTwo();
  const core::Result<report::Baseline> baseline = BaselineOf("a");
  ASSERT_TRUE(baseline.ok());
  report::WriteFileAtomically(Path("baseline.json"), report::BaselineJson(*baseline));
  const core::Result<CheckResult> same = Check(CheckOf("a"));
  ASSERT_TRUE(same.ok());
  const auto& check = std::get<BaselineCheck>(*same);
  EXPECT_EQ(check.outcome, Outcome::kDone);
  EXPECT_TRUE(check.report.cells.front().identical);

  const core::Result<CheckResult> other = Check(CheckOf("b"));
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.problems(), Contains(Field(&core::Problem::suggestion, Not(IsEmpty()))));
  EXPECT_FALSE(BaselineOf("none").ok());
}

TEST_F(Findings, AReportHasTheNumbersOfTheRuns) {
  RunTwo();
  const ReportResult result = WriteReport({.runs = {Path("a").string(), Path("b").string()},
                                           .page = Path("report.html").string(),
                                           .data = Path("report.json").string(),
                                           .replays = 0});
  // A build without pages refuses the page.
  if (result.outcome == Outcome::kBadInput) {
    const ReportResult data = WriteReport(
        {.runs = {Path("a").string()}, .data = Path("report.json").string(), .replays = 0});
    EXPECT_EQ(data.outcome, Outcome::kDone);
    EXPECT_EQ(data.trials, 4U);
    EXPECT_EQ(data.data_bytes, std::filesystem::file_size(Path("report.json")));
    return;
  }
  EXPECT_EQ(result.outcome, Outcome::kDone);
  EXPECT_EQ(result.runs, 2U);
  EXPECT_EQ(result.trials, 8U);
  EXPECT_EQ(result.page_bytes, std::filesystem::file_size(Path("report.html")));
}

TEST_F(Findings, ATrialIsReplayedAsItIsStored) {
  ASSERT_EQ(campaign::Run(Request("a", 2)).outcome, Outcome::kDone);
  const TrialRequest trial{.source = Path("a").string(), .trial = 1};
  const ReplayResult replay = Replay(
      {.trial = trial, .page = Path("replay.html").string(), .data = Path("replay.json").string()});
  EXPECT_EQ(replay.outcome, Outcome::kDone);
  EXPECT_EQ(replay.repeats_stored, true);
  EXPECT_THAT(replay.files, Contains(Field(&ReplayFile::path, Path("replay.svg"))));
  EXPECT_TRUE(std::filesystem::exists(Path("replay.json")));

  std::int64_t scans = 0;
  MomentsObserver observer;
  observer.scan = [&](const ScanMoment& scan) { EXPECT_EQ(scan.number, scans++); };
  const MomentsResult listed = ReplayMoments({.trial = trial}, observer);
  EXPECT_EQ(listed.outcome, Outcome::kDone);
  EXPECT_GT(scans, 0);
  EXPECT_EQ(listed.scans, scans);
  const MomentsResult missing =
      ReplayMoments({.trial = trial, .scan = scans, .folder = Path("scan")});
  EXPECT_EQ(missing.outcome, Outcome::kBadInput);
  EXPECT_FALSE(std::filesystem::exists(Path("scan")));
}

TEST_F(Findings, TheLibraryPrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  RunRequest supervised = Request("supervised", 2);
  supervised.campaign.containment.supervisor = true;
  supervised.campaign.traces.rules = {"all"};
  campaign::Run(supervised);
  campaign::Run(supervised);  // is refused
  campaign::Run(Request("a", 2));
  RunSweep(SweepOfTwo("sweep"));
  Merge({.shards = {Path("a")}, .folder = Path("merged")});
  Compare({.first = Path("a"), .second = Path("supervised")});
  Check(CheckOf("a"));
  WriteReport({.runs = {Path("a").string()}, .data = Path("report.json").string()});
  Replay({.trial = {.source = Path("a").string()}, .page = Path("replay.html").string()});
  ReplayMoments({.trial = {.source = Path("a").string()}});
  std::fflush(nullptr);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace rockyard::campaign
