// rockyard report: which folders it takes, what it refuses, and what its page holds.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// What a page was given: PAGE DATA. Fails where it is another JSON than that of the file.
constexpr const char* kSamePayload = R"(
import base64, gzip, json, re, sys
page = open(sys.argv[1], encoding="utf-8").read()
found = re.search(r'id="payload"[^>]*>([^<]*)<', page)
held = json.loads(gzip.decompress(base64.b64decode(found.group(1))))
sys.exit(0 if held == json.load(open(sys.argv[2], encoding="utf-8")) else 1)
)";

class CliReport : public CommandTest {
 protected:
  // Long enough that something happens, and fast.
  CommandResult Drive(const std::string& out, int trials,
                      const std::vector<std::string>& more = {}) const {
    return Run(With(
        QuickRun(out, trials),
        With({"--set", "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=300"}, more)));
  }
  CommandResult Sweep(const std::string& out) const {
    WriteFile(work() / "two.json", R"({
      "name": "two", "trials": 4, "common_random_numbers": true,
      "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 100},
      "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]})");
    return Run({"sweep", "two.json", "--out", out});
  }
  CommandResult Report(const std::vector<std::string>& words) const {
    return Run(With({"report", "--replays", "0", "--data", "data.json"}, words));
  }
  json Data() const { return json::parse(ReadFile(work() / "data.json")); }
  json Summary(const std::string& run) const {
    return json::parse(ReadFile(work() / run / "summary.json"));
  }
  void ExpectRefused(const CommandResult& result, const std::string& why) const {
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(work() / "data.json"));
  }
  static std::string Reference(const char* name) {
    return std::string(ROCKYARD_SOURCE_DIR) + "/results/reference/" + name + ".json";
  }
  // Without npm there is no page: the numbers alone.
  bool HasPages() const { return Report({"none"}).err.find("built without") == std::string::npos; }
};

TEST_F(CliReport, HoldsTheNumbersOfSummaryJson) {
  ASSERT_EQ(Drive("a", 5).exit_code, 0);
  const CommandResult result = Report({"a"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json data = Data();
  ASSERT_EQ(data["runs"].size(), 1u);
  const json& run = data["runs"][0];
  json held = run["summary"];
  json stored = Summary("a");
  EXPECT_EQ(held, stored);
  EXPECT_EQ(run["label"], "a");
  EXPECT_EQ(data["title"], "a");
  EXPECT_EQ(run["folder"], "a");
  EXPECT_EQ(run["kind"], "drive");
  EXPECT_EQ(run["replay_command"], "rockyard replay a --trial {trial}");
  EXPECT_EQ(run["trials"]["trial"].size(), 5u);
  EXPECT_GT(run["parameters"].size(), 100u);
  EXPECT_TRUE(run["published"].is_null());
  EXPECT_THAT(data["command"].get<std::string>(), HasSubstr("rockyard report a"));
  EXPECT_TRUE(data["comparisons"].empty());
}

TEST_F(CliReport, ThePageHoldsWhatDataSays) {
  if (!HasPages()) GTEST_SKIP() << "built without npm";
  ASSERT_EQ(Drive("a", 3).exit_code, 0);
  const CommandResult result = Report({"a", "--title", "</title><img src=x onerror=alert(1)>"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("a/report.html"));
  EXPECT_THAT(result.out, HasSubstr("1 run, 3 trials"));
  EXPECT_THAT(result.out, HasSubstr("next: "));
  EXPECT_THAT(ReadFile(work() / "a/report.html"), Not(HasSubstr("<img src=x")));
  EXPECT_EQ(Data()["title"], "</title><img src=x onerror=alert(1)>");
  const pid_t python =
      StartProgram({ROCKYARD_PYTHON, "-c", kSamePayload, "a/report.html", "data.json"});
  EXPECT_EQ(Wait(python).exit_code, 0);
  ASSERT_EQ(Report({"a", "--out", "page.html"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(work() / "page.html"));
}

TEST_F(CliReport, RunsAndSweepsMayBeMixed) {
  ASSERT_EQ(Drive("a", 4).exit_code, 0);
  ASSERT_EQ(Sweep("s").exit_code, 0);
  ASSERT_EQ(Report({"a", "s"}).exit_code, 0);
  const json data = Data();
  ASSERT_EQ(data["runs"].size(), 3u);
  ASSERT_EQ(data["sweeps"].size(), 1u);
  json stored = Summary("s");
  EXPECT_EQ(data["sweeps"][0]["summary"], stored);
  EXPECT_EQ(data["sweeps"][0]["curves"][0]["points"].size(), 2u);
  EXPECT_TRUE(data["runs"][0]["sweep"].is_null());
  EXPECT_EQ(data["runs"][2]["sweep"], 0);
  EXPECT_EQ(data["runs"][2]["label"], "k_per_m2=0.004");
  EXPECT_EQ(data["runs"][2]["replay_command"],
            "rockyard replay s --cell k_per_m2=0.004 --trial {trial}");
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
  const std::string scenario =
      std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/hazard_detection/approach.json";
  ASSERT_EQ(Run({"run", scenario, "--trials", "40", "--out", "m"}).exit_code, 0);
  ASSERT_EQ(Report({"m"}).exit_code, 0);
  const json run = Data()["runs"][0];
  EXPECT_EQ(run["kind"], "measurement");
  EXPECT_TRUE(run["cdf"].is_null());
  json stored = Summary("m");
  EXPECT_EQ(run["summary"]["cells"], stored["cells"]);
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
}

TEST_F(CliReport, PendingTrialsAreTold) {
  ASSERT_EQ(Drive("a", 3).exit_code, 0);
  ASSERT_EQ(Run({"run", Scenario("nominal"), "--out", "b", "--set", "referee.time_limit_s=1",
                 "--trials", "6", "--shard", "1/2"})
                .exit_code,
            0);
  ASSERT_EQ(Run({"merge", "b", "--out", "half", "--partial"}).exit_code, 0);
  ASSERT_EQ(Report({"half"}).exit_code, 0);
  const json run = Data()["runs"][0];
  EXPECT_EQ(run["summary"]["accounting"]["pending"], 3);
  EXPECT_EQ(run["trials"]["trial"], json({0, 2, 4}));
  fs::remove(work() / "data.json");
  ExpectRefused(Report({"b"}), "holds shard 1/2 of a campaign");
}

TEST_F(CliReport, WhatIsNoWholeRunIsRefused) {
  fs::create_directories(work() / "empty");
  ExpectRefused(Report({"empty"}), "holds no results.sqlite");
  ExpectRefused(Report({"missing"}), "missing");
  ASSERT_EQ(Drive("a", 3).exit_code, 0);
  ExpectRefused(Report({"a", "a/"}), "is named twice");
  fs::create_directories(work() / "cut");
  const std::string store = ReadFile(work() / "a/results.sqlite");
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, store.size() / 2}) {
    WriteFile(work() / "cut/results.sqlite", store.substr(0, size));
    ExpectRefused(Report({"a", "cut"}), "cut/results.sqlite");
  }
  WriteFile(work() / "cut/results.sqlite", "this is no database, whatever its name may say");
  const CommandResult both = Report({"cut", "missing"});
  ExpectRefused(both, "cut/results.sqlite");
  EXPECT_THAT(both.err, HasSubstr("missing"));  // all that is wrong, at once
}

TEST_F(CliReport, FilesThatCannotBeMeantAreRefusedBeforeTheWork) {
  ASSERT_EQ(Drive("a", 2).exit_code, 0);
  const auto refused = [&](const std::vector<std::string>& words, const char* why) {
    const CommandResult result = Run(With({"report", "a", "--replays", "0"}, words));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(why));
  };
  refused({"--data", "a/summary.json"}, "is a file of the run itself");
  refused({"--data", "no/where/data.json"}, "--data");
  refused({"--data", "data.txt"}, "does not end in .json");
  refused({"--data", "data.json", "--replays", "-1"}, "--replays");
  if (!HasPages()) return;
  refused({"--out", "a/results.sqlite"}, "does not end in .html");
  refused({"--out", "no/where/page.html"}, "--out");
  fs::create_directories(work() / "folder.html");
  refused({"--out", "folder.html"}, "is a folder");
}

}  // namespace
}  // namespace rockyard::app
