// Campaigns as other programs run them.
#include "api/campaign.h"

#include <gmock/gmock.h>

#include <fstream>

#include "api/scenario.h"
#include "campaign/reference_cases.h"
#include "core/test_folder.h"
#include "report/atomic_file.h"

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

  const auto baseline =
      campaign::MakeBaseline({.runs = {Path("a").string()}, .name = "b", .reason = "first"});
  ASSERT_TRUE(baseline.ok());
  report::WriteFileAtomically(Path("baseline.json"), report::BaselineJson(*baseline));
  const Finding check = Check({.runs = {Path("a").string()}, .reference = Path("baseline.json")});
  EXPECT_EQ(check.outcome, Outcome::kDone);
  EXPECT_EQ(check.json.front(), '{');
  EXPECT_THROW(Check({.runs = {Path("b").string()}, .reference = Path("baseline.json")}),
               core::UserError);
  EXPECT_THROW(Compare({.first = Path("a"), .second = Path("none")}), core::UserError);
}

}  // namespace
}  // namespace rockyard::api
