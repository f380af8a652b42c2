// rockyard report: what it refuses, and what it says of runs that are not as they should be.

#include "app/cli_report.h"
#include "batch/forged_store.h"

namespace rockyard::app {
namespace {

using CliReportErrors = CliReportTest;
using CliReportPages = CliReportTest;

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
  RunTo(0, {"run", Scenario("nominal"), "--out", "b", "--set", "referee.time_limit_s=1", "--trials",
            "6", "--shard", "1/2"});
  RunTo(0, {"merge", "b", "--out", "half", "--partial"});
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
  const auto refused = [&](const Words& words, const char* why) {
    EXPECT_THAT(RunTo(2, With({"report", "a"}, words)).err, HasSubstr(why));
  };
  refused({"--data", "a/summary.json"}, "is a file of the run itself");
  refused({"--data", "no/where/data.json"}, "--data");
  refused({"--data", "data.txt"}, "does not end in .json");
  refused({"--data", "data.json", "--replays", "-1"}, "--replays");
}

// What the pages of a report hold.

// What a page was given: PAGE DATA. Fails where it is another JSON than that of the file.
constexpr const char* kSamePayload = R"(
import base64, gzip, json, re, sys
page = open(sys.argv[1], encoding="utf-8").read()
found = re.search(r'id="payload"[^>]*>([^<]*)<', page)
held = json.loads(gzip.decompress(base64.b64decode(found.group(1))))
sys.exit(0 if held == json.load(open(sys.argv[2], encoding="utf-8")) else 1)
)";

TEST_F(CliReportPages, ThePageHoldsWhatDataSays) {
  ASSERT_EQ(Drive("a", 3).exit_code, 0);
  const CommandResult result = Report({"a", "--title", "</title><img src=x onerror=alert(1)>"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Says("a/report.html", "1 run, 3 trials", "next: "));
  EXPECT_THAT(ReadFile(work() / "a/report.html"), Not(HasSubstr("<img src=x")));
  EXPECT_EQ(Data()["title"], "</title><img src=x onerror=alert(1)>");
  const pid_t python =
      StartProgram({ROCKYARD_PYTHON, "-c", kSamePayload, "a/report.html", "data.json"});
  EXPECT_EQ(Wait(python).exit_code, 0);
  ASSERT_EQ(Report({"a", "--out", "page.html"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(work() / "page.html"));
}

TEST_F(CliReportPages, TheWorstTrialsGetReplays) {
  // Every trial runs out of time: of two, the one of median distance is among the two worst.
  ASSERT_EQ(Drive("a <b>", 2, {"--set", "referee.time_limit_s=20"}).exit_code, 0);
  const CommandResult result = Report({"a <b>", "--out", "my page.html"}, 2);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 replays in my page_replays"));
  EXPECT_THAT(result.err, HasSubstr("replay 2 of 2: trial"));
  const json run = Data()["runs"][0];
  EXPECT_EQ(run["replay_command"], "rockyard replay 'a <b>' --trial {trial}");
  const json& links = run["replays"];
  ASSERT_EQ(links.size(), 2u);
  for (const auto& [trial, link] : links.items()) {
    EXPECT_EQ(link, "my%20page_replays/1-a__b_-trial" + trial + ".html");
    EXPECT_TRUE(fs::exists(work() / "my page_replays" / ("1-a__b_-trial" + trial + ".html")));
  }
}

TEST_F(CliReportPages, TheFirstTrialsGetTracks) {
  ASSERT_EQ(Drive("a", 5, {"--set", "referee.time_limit_s=20"}).exit_code, 0);
  const CommandResult result = Report({"a", "--tracks", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr(" of a\n"));
  const json run = Data()["runs"][0];
  EXPECT_GE(run["first_tracks"], 1);
  EXPECT_FALSE(run["tracks"][0]["pieces_cm"].empty());
  EXPECT_EQ(run["examples"].size(), 1u);
  ASSERT_EQ(Report({"a", "--tracks", "0"}).exit_code, 0);
  EXPECT_TRUE(Data()["runs"][0]["tracks"].empty());
  EXPECT_EQ(Report({"a", "--tracks", "1001"}).exit_code, 2);
}

TEST_F(CliReportPages, ATrackThatDiffersIsToldAndLeftOut) {
  ASSERT_EQ(Drive("a", 2, {"--set", "referee.time_limit_s=20"}).exit_code, 0);
  batch::Forge(work() / "a/results.sqlite",
               "UPDATE trials SET energy_wh = energy_wh + 1 WHERE trial = 0");
  const CommandResult result = Report({"a"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("a: 1 of the trials that were driven again for the map"));
  const json run = Data()["runs"][0];
  ASSERT_EQ(run["tracks"].size(), 1u);
  EXPECT_EQ(run["tracks"][0]["trial"], 1);
}

TEST_F(CliReportPages, AReplayThatDiffersIsReportedAndNotLinked) {
  ASSERT_EQ(Drive("a", 1, {"--set", "referee.time_limit_s=20"}).exit_code, 0);
  batch::Forge(work() / "a/results.sqlite", "UPDATE trials SET energy_wh = energy_wh + 1");
  const CommandResult result = Report({"a"}, 1);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("is not the stored one"));
  EXPECT_TRUE(fs::exists(work() / "a/report.html"));
  EXPECT_TRUE(Data()["runs"][0]["replays"].empty());
  EXPECT_FALSE(fs::exists(work() / "a/report_replays/1-a-trial0.html"));
}

TEST_F(CliReportPages, PagesOfEarlierReportsAreTold) {
  ASSERT_EQ(Drive("a", 3, {"--set", "referee.time_limit_s=20"}).exit_code, 0);
  ASSERT_EQ(Report({"a", "--out", "page.html"}, 3).exit_code, 0);
  EXPECT_THAT(Report({"a", "--out", "page.html"}, 3).err, Not(HasSubstr("older page")));
  // The worst of the three, and the one of median distance.
  EXPECT_THAT(Report({"a", "--out", "page.html"}, 1).err,
              HasSubstr("1 older page in page_replays is not of this report"));
  EXPECT_TRUE(fs::exists(work() / "page_replays"));
}

TEST_F(CliReportPages, OutThatCannotBeMeantIsRefused) {
  ASSERT_EQ(Drive("a", 2).exit_code, 0);
  const auto refused = [&](const Words& words, const char* why) {
    EXPECT_THAT(RunTo(2, With({"report", "a"}, words)).err, HasSubstr(why));
  };
  refused({"--out", "a/results.sqlite"}, "is a file of the run itself");
  refused({"--out", "a/page.svg"}, "does not end in .html");
  refused({"--out", "no/where/page.html"}, "--out");
  fs::create_directories(work() / "folder.html");
  refused({"--out", "folder.html"}, "is a folder");
}

}  // namespace
}  // namespace rockyard::app
