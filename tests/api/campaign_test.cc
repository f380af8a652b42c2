// Campaigns as other programs run them.
#include "api/campaign.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "api/scenario.h"
#include "core/test_folder.h"

namespace rockyard::api {
namespace {

using campaign::Outcome;
using testing::HasSubstr;
using testing::Not;

class PublicCampaign : public testing::Test {
 protected:
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }

  // Trials that end after a simulated second.
  RunRequest Request(const std::string& folder) const {
    std::ofstream(Path("short.json")) << R"({"rover": {"fidelity": "quasi_static"},
                                             "referee": {"time_limit_s": 1}, "trials": 3})";
    return {.source = Path("short.json"), .folder = Path(folder), .threads = 1};
  }

  static std::string Text(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  core::TestFolder folder_;
};

TEST_F(PublicCampaign, RunsWhatTheRequestSays) {
  RunRequest request = Request("run");
  std::int64_t planned = 0;
  request.progress = [&](std::int64_t, std::int64_t all) { planned = all; };
  request.trials = 4;
  request.seed = 9;
  request.overrides = {"rover.drive.speed_m_s=0.05"};
  request.traces = {"all"};
  const campaign::WorkResult result = api::Run(request);
  EXPECT_EQ(result.outcome, Outcome::kDone);
  EXPECT_EQ(result.folder, request.folder);
  EXPECT_EQ(result.trials.finished, 4);
  EXPECT_EQ(planned, 4);
  EXPECT_TRUE(std::filesystem::exists(request.folder / "traces"));
  const Scenario resolved = Scenario::Load(request.folder / "scenario.resolved.json");
  EXPECT_EQ(resolved.seed(), 9U);
  EXPECT_THAT(resolved.ResolvedJson(), HasSubstr("\"speed_m_s\": 0.05"));
}

TEST_F(PublicCampaign, RefusesARunThatIsThereUnlessTold) {
  RunRequest request = Request("run");
  ASSERT_EQ(api::Run(request).outcome, Outcome::kDone);
  EXPECT_EQ(api::Run(request).outcome, Outcome::kBadInput);
  request.existing = campaign::ExistingRun::kResume;
  EXPECT_EQ(api::Run(request).outcome, Outcome::kDone);
}

TEST_F(PublicCampaign, EndsEarlyAndTellsTheObserver) {
  RunRequest request = Request("run");
  request.stop = [] { return true; };
  EXPECT_EQ(api::Run(request).outcome, Outcome::kInterrupted);
  int told = 0;
  request.source = Path("none.json");
  request.observer.problems = [&](const std::vector<core::Problem>&) { ++told; };
  EXPECT_EQ(api::Run(request).outcome, Outcome::kBadInput);
  EXPECT_EQ(told, 1);
}

TEST_F(PublicCampaign, SweepsEveryCell) {
  std::ofstream(Path("two.json")) << R"({
    "name": "two", "trials": 2, "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 1},
    "axes": [{"path": "rover.drive.speed_m_s", "values": [0.05, 0.1]}]})";
  const campaign::WorkResult result =
      Sweep({.source = Path("two.json"), .folder = Path("sweep"), .threads = 1});
  EXPECT_EQ(result.outcome, Outcome::kDone);
  EXPECT_EQ(result.trials.finished, 4);
}

TEST_F(PublicCampaign, MergesShardsToTheWholeRun) {
  RunRequest request = Request("whole");
  ASSERT_EQ(api::Run(request).outcome, Outcome::kDone);
  for (const std::string number : {"1", "2"}) {
    request.folder = Path(number);
    request.shard = number + "/2";
    ASSERT_EQ(api::Run(request).outcome, Outcome::kDone);
  }
  MergeRequest merge{.shards = {Path("1")}, .folder = Path("merged")};
  int told = 0;
  merge.observer.problems = [&](const std::vector<core::Problem>&) { ++told; };
  EXPECT_EQ(Merge(merge).outcome, Outcome::kBadInput);
  EXPECT_EQ(told, 1);
  EXPECT_FALSE(std::filesystem::exists(merge.folder));
  merge.shards.push_back(Path("2"));
  const campaign::WorkResult merged = Merge(merge);
  EXPECT_EQ(merged.outcome, Outcome::kDone);
  EXPECT_EQ(merged.folder, merge.folder);
  EXPECT_EQ(Text(merge.folder / "trials.csv"), Text(Path("whole") / "trials.csv"));
  merge = {.shards = {Path("1")}, .folder = Path("part"), .partial = true};
  EXPECT_EQ(Merge(merge).outcome, Outcome::kDone);
  EXPECT_EQ(Text(merge.folder / "trials.csv"), Text(Path("1") / "trials.csv"));
}

TEST_F(PublicCampaign, ReportsWhatTheRequestSays) {
  ASSERT_EQ(api::Run(Request("a")).outcome, Outcome::kDone);
  const ReportRequest request{.runs = {Path("a").string()},
                              .page = Path("page.html"),
                              .data = Path("data.json"),
                              .title = "a title",
                              .replays = 1,
                              .tracks = 0};
  EXPECT_EQ(Report(request).outcome, Outcome::kDone);
  EXPECT_THAT(Text(Path("page.html")), HasSubstr("<title>a title"));
  EXPECT_THAT(Text(Path("data.json")), HasSubstr("page_replays/"));
  EXPECT_EQ(Report({.runs = {Path("none").string()}}).outcome, Outcome::kBadInput);
}

TEST_F(PublicCampaign, FindingsAreTheJsonOfTheCommand) {
  ASSERT_EQ(api::Run(Request("a")).outcome, Outcome::kDone);
  RunRequest slow = Request("b");
  slow.overrides = {"rover.drive.speed_m_s=0.05"};
  ASSERT_EQ(api::Run(slow).outcome, Outcome::kDone);
  const Finding same = Compare({.first = Path("a"), .second = Path("a")});
  const Finding other = Compare({.first = Path("a"), .second = Path("b")});
  EXPECT_EQ(same.outcome, Outcome::kDone);
  EXPECT_THAT(same.json, Not(HasSubstr("rover.drive.speed_m_s")));
  EXPECT_THAT(other.json, HasSubstr("rover.drive.speed_m_s"));

  BaselineRequest baseline{
      .runs = {Path("a").string()}, .file = Path("baseline.json"), .name = "b", .reason = " "};
  EXPECT_THROW(WriteBaseline(baseline), core::UserError);
  EXPECT_FALSE(std::filesystem::exists(baseline.file));
  baseline.reason = "first";
  WriteBaseline(baseline);
  const Finding check = Check({.runs = {Path("a").string()}, .reference = Path("baseline.json")});
  EXPECT_EQ(check.outcome, Outcome::kDone);
  EXPECT_EQ(check.json.front(), '{');
  EXPECT_THROW(Check({.runs = {Path("b").string()}, .reference = Path("baseline.json")}),
               core::UserError);
  EXPECT_THROW(Compare({.first = Path("a"), .second = Path("none")}), core::UserError);
}

}  // namespace
}  // namespace rockyard::api
