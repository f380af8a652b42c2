// rockyard report: what it refuses, and what it says of runs that are not as they should be.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/cli_report.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

using CliReportErrors = CliReportTest;

TEST_F(CliReportErrors, ForceSetsTheOldReportAside) {
  ASSERT_EQ(Drive("a", 3).exit_code, 0);
  WriteFile(work() / "a/report.html", "old");
  fs::create_directories(work() / "a/report_replays");
  ASSERT_EQ(Drive("a", 2, {"--force", "--seed", "9"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(work() / "a/report.html"));
  EXPECT_FALSE(fs::exists(work() / "a/report_replays"));
  EXPECT_EQ(ReadFile(work() / "a/report.old-1.html"), "old");
  EXPECT_TRUE(fs::exists(work() / "a/report_replays.old-1"));
}

TEST_F(CliReportErrors, PendingTrialsAreTold) {
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

TEST_F(CliReportErrors, WhatIsNoWholeRunIsRefused) {
  fs::create_directories(work() / "empty");
  ExpectRefused(Report({"empty"}), "holds no results.sqlite");
  ExpectRefused(Report({"missing"}), "missing");
  EXPECT_THAT(Report({"missing"}).err, Not(HasSubstr("--out")));  // which nobody has named
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

TEST_F(CliReportErrors, FilesThatCannotBeMeantAreRefusedBeforeTheWork) {
  ASSERT_EQ(Drive("a", 2).exit_code, 0);
  const auto refused = [&](const std::vector<std::string>& words, const char* why) {
    EXPECT_THAT(RunTo(2, With({"report", "a"}, words)).err, HasSubstr(why));
  };
  refused({"--data", "a/summary.json"}, "is a file of the run itself");
  refused({"--data", "no/where/data.json"}, "--data");
  refused({"--data", "data.txt"}, "does not end in .json");
  refused({"--data", "data.json", "--replays", "-1"}, "--replays");
}

}  // namespace
}  // namespace rockyard::app
