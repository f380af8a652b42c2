// rockyard report: which folders it takes, and what its page holds.
#include "app/cli_report.h"

#include "batch/forged_store.h"

namespace rockyard::app {
namespace {

using CliReport = CliReportTest;

TEST_F(CliReport, HoldsTheNumbersOfSummaryJson) {
  ASSERT_EQ(Drive("a", 5).exit_code, 0);
  const CommandResult result = Report({"a"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json data = Data();
  ASSERT_EQ(data["runs"].size(), 1u);
  const json& run = data["runs"][0];
  EXPECT_EQ(run["summary"], Summary("a"));
  EXPECT_EQ(run["label"], "a");
  EXPECT_EQ(data["title"], "nominal");
  EXPECT_EQ(run["folder"], "a");
  EXPECT_EQ(run["kind"], "drive");
  EXPECT_EQ(run["replay_command"], "rockyard replay a --trial {trial}");
  EXPECT_EQ(run["trials"]["trial"].size(), 5u);
  EXPECT_GT(run["parameters"].size(), 100u);
  EXPECT_EQ(run["published"]["reference"], "Matthies 1995");
  EXPECT_THAT(data["command"].get<std::string>(), HasSubstr("rockyard report a"));
  EXPECT_TRUE(data["comparisons"].empty());
}

TEST_F(CliReport, OfAScenarioWithoutANameIsTitledByItsFolder) {
  ASSERT_EQ(Drive("a", 1, {"--set", "name="}).exit_code, 0);
  ASSERT_EQ(Report({"a"}).exit_code, 0);
  EXPECT_EQ(Data()["title"], "a");
}

// As after an interrupted run, or where a trial was left out: what lies behind the gap is biased to
// trials that end early.
TEST_F(CliReport, TellsWhichTrialsAreInTheRates) {
  ASSERT_EQ(Drive("a", 6, {"--set", "course.trials_per_layout=2"}).exit_code, 0);
  batch::Forge(work() / "a/results.sqlite", "DELETE FROM trials WHERE trial = 3");
  const CommandResult result = Report({"a"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json run = Data()["runs"][0];
  EXPECT_EQ(run["prefix_trials"], 3);
  EXPECT_EQ(run["trials"]["trial"], json({0, 1, 2, 4, 5}));
  EXPECT_EQ(run["summary"]["trials"]["completed"], 3);
  EXPECT_EQ(run["shared_layouts"], true);
}

TEST_F(CliReport, RunsAndSweepsMayBeMixed) {
  ASSERT_EQ(Drive("a", 4).exit_code, 0);
  ASSERT_EQ(Sweep("s").exit_code, 0);
  ASSERT_EQ(Report({"a", "s"}).exit_code, 0);
  const json data = Data();
  ASSERT_EQ(data["runs"].size(), 3u);
  ASSERT_EQ(data["sweeps"].size(), 1u);
  EXPECT_EQ(data["sweeps"][0]["summary"], Summary("s"));
  EXPECT_EQ(data["title"], "nominal, two");
  EXPECT_EQ(data["sweeps"][0]["curves"][0]["points"].size(), 2u);
  EXPECT_TRUE(data["runs"][0]["sweep"].is_null());
  EXPECT_EQ(data["runs"][2]["sweep"], 0);
  EXPECT_EQ(data["runs"][2]["label"], "k_per_m2=0.004");
  EXPECT_EQ(data["runs"][2]["replay_command"],
            "rockyard replay s --cell k_per_m2=0.004 --trial {trial}");
  // What cells have in common stands in the first of them.
  EXPECT_TRUE(data["runs"][1]["parameters_as"].is_null());
  EXPECT_EQ(data["runs"][2]["parameters_as"], 1);
  ASSERT_EQ(data["runs"][2]["parameters"].size(), 2u);
  EXPECT_EQ(data["runs"][2]["parameters"][0]["path"], "name");
  EXPECT_EQ(data["runs"][2]["parameters"][1]["path"], "terrain.rocks.k_per_m2");
  // Cells of a sweep are compared along its axes, not here.
  EXPECT_TRUE(data["comparisons"].empty());
}

TEST_F(CliReport, OneCellAlone) {
  ASSERT_EQ(Sweep("s").exit_code, 0);
  ASSERT_EQ(Report({"s", "--cell", "1"}).exit_code, 0);
  const json data = Data();
  ASSERT_EQ(data["runs"].size(), 1u);
  EXPECT_EQ(data["runs"][0]["cell"], "k_per_m2=0.004");
  EXPECT_EQ(data["runs"][0]["label"], "s: k_per_m2=0.004");
  EXPECT_TRUE(data["sweeps"].empty());
  fs::remove(work() / "data.json");
  ExpectRefused(Report({"s", "--cell", "nine"}), "is no cell of s");
}

TEST_F(CliReport, RunsAreComparedWithTheFirst) {
  ASSERT_EQ(Drive("a", 6).exit_code, 0);
  ASSERT_EQ(Drive("b", 6, {"--set", "referee.time_limit_s=200"}).exit_code, 0);
  ASSERT_EQ(Drive("c", 6, {"--seed", "9"}).exit_code, 0);
  ASSERT_EQ(Report({"a", "b", "c"}).exit_code, 0);
  EXPECT_EQ(Data()["title"], "nominal (a), nominal (b), nominal (c)");
  const json comparisons = Data()["comparisons"];
  ASSERT_EQ(comparisons.size(), 2u);
  EXPECT_EQ(comparisons[0]["first"], "a");
  EXPECT_EQ(comparisons[0]["second"], "b");
  EXPECT_EQ(comparisons[0]["paired"], true);
  EXPECT_EQ(comparisons[0]["pairs"], 6);
  EXPECT_EQ(comparisons[0]["settings"][0]["path"], "referee.time_limit_s");
  EXPECT_EQ(comparisons[1]["paired"], false);
  EXPECT_THAT(comparisons[1]["notes"].dump(), HasSubstr("Holm"));
}

TEST_F(CliReport, LabelsOfEqualFolderNamesDiffer) {
  for (const char* folder : {"x/run", "y/run"}) {
    fs::create_directories(work() / fs::path(folder).parent_path());
    ASSERT_EQ(Drive(folder, 2).exit_code, 0);
  }
  ASSERT_EQ(Report({"x/run", "y/run"}).exit_code, 0);
  EXPECT_EQ(Data()["runs"][0]["label"], "x/run");
  EXPECT_EQ(Data()["runs"][1]["label"], "y/run");
}

TEST_F(CliReport, AMeasurementHasItsCells) {
  const std::string scenario = Source("scenarios/hazard_detection/approach.json");
  RunTo(0, {"run", scenario, "--trials", "40", "--out", "m"});
  ASSERT_EQ(Report({"m"}).exit_code, 0);
  const json run = Data()["runs"][0];
  EXPECT_EQ(run["kind"], "measurement");
  EXPECT_TRUE(run["cdf"].is_null());
  EXPECT_EQ(run["summary"]["cells"], Summary("m")["cells"]);
}

TEST_F(CliReport, PublishedValuesStandBesideTheRun) {
  ASSERT_EQ(Drive("a", 5).exit_code, 0);
  ASSERT_EQ(Report({"a", "--against", Reference("matthies1995")}).exit_code, 0);
  const json table = Data()["runs"][0]["published"];
  EXPECT_EQ(table["reference"], "Matthies 1995");
  ASSERT_FALSE(table["rows"].empty());
  for (const json& row : table["rows"]) {
    EXPECT_THAT(row["id"].get<std::string>(), testing::StartsWith("nominal."));
  }
  fs::remove(work() / "data.json");
  ExpectRefused(Report({"a", "--against", Reference("goldberg2002")}),
                "names the scenario of none of the runs");
}

TEST_F(CliReport, ReferencesOfTheWorkingFolderAreFound) {
  ASSERT_EQ(Drive("a", 5).exit_code, 0);
  fs::create_directories(work() / "results/reference");
  fs::copy_file(Reference("matthies1995"), work() / "results/reference/m.json");
  WriteFile(work() / "results/reference/broken.json", "{");
  const CommandResult result = Report({"a"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("broken.json is left out"));
  EXPECT_EQ(Data()["runs"][0]["published"]["reference"], "Matthies 1995");
  EXPECT_EQ(Data()["why_none_published"], "");
}

TEST_F(CliReport, SaysWhereNoReferenceWasFound) {
  ASSERT_EQ(Drive("a", 3).exit_code, 0);
  setenv("ROCKYARD_SCENARIOS", "/nowhere", 1);
  EXPECT_THAT(Report({"a"}).err, HasSubstr("results/reference holds no reference"));
  unsetenv("ROCKYARD_SCENARIOS");
  EXPECT_THAT(Data()["why_none_published"].get<std::string>(), HasSubstr("--against"));
}

TEST_F(CliReport, OtherRunsDoNotChangeWhatIsPublished) {
  ASSERT_EQ(Drive("a", 5).exit_code, 0);
  RunTo(0, {"run", Scenario("obstacles_0.57"), "--out", "b", "--trials", "5", "--set",
            "referee.time_limit_s=1"});
  const auto table = [&](const Words& runs, std::size_t which) {
    EXPECT_EQ(Report(With(runs, {"--against", Reference("matthies1995")})).exit_code, 0);
    return Data()["runs"][which]["published"];
  };
  const json alone = table({"b"}, 0);
  EXPECT_FALSE(alone.is_null());
  EXPECT_EQ(table({"a", "b"}, 1), alone);
  EXPECT_EQ(table({"b", "a"}, 0), alone);
}

}  // namespace
}  // namespace rockyard::app
