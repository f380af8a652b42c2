// rockyard run, with real trials of one simulated second; the one next command that it ends with.

#include "app/command.h"
#include "app/watched_run.h"

namespace rockyard::app {
namespace {

using testing::ElementsAre;

class CliRun : public WatchedRunTest {
 protected:
  CliRun() : WatchedRunTest(2) {}
};

TEST_F(CliRun, WritesTheWholeFolder) {
  const CommandResult result = RunTo(0, QuickRun("a", 3));
  for (const char* name : {"results.sqlite", "summary.json", "trials.csv", "distance_cdf.csv",
                           "scenario.resolved.json"}) {
    EXPECT_TRUE(fs::exists(work() / "a" / name)) << name;
  }
  EXPECT_EQ(Summary("a")["trials"]["completed"], 3);
  EXPECT_EQ(Summary("a")["outcomes"]["time_limit"], 3);
  EXPECT_THAT(result.out, HasSubstr("3 of 3 trials"));
  EXPECT_THAT(result.err, HasSubstr("3/3 done"));
  EXPECT_EQ(result.out.find('\x1b'), std::string::npos) << "no colours into a file";
}

TEST_F(CliRun, ThreadsAndResumeGiveTheSameHash) {
  Run(With(QuickRun("one", 8), {"--threads", "1"}));
  Run(With(QuickRun("two", 8), {"--threads", "2"}));
  Run(QuickRun("parts", 3));
  RunTo(0, With(QuickRun("parts", 8), {"--resume"}));
  EXPECT_EQ(Hash("two"), Hash("one"));
  EXPECT_EQ(Hash("parts"), Hash("one"));
  Run(With(QuickRun("other", 8), {"--seed", "2"}));
  EXPECT_NE(Hash("other"), Hash("one"));
}

TEST_F(CliRun, AnInterruptStoresWhatIsFinishedAndSaysHowToGoOn) {
  const pid_t process = Start(With(QuickRun("a", 100000), {"--threads", "2"}));
  ASSERT_TRUE(WaitForTrials("a", 10));
  kill(process, SIGINT);
  const CommandResult result = WaitTo(130, process);
  EXPECT_THAT(result.err, HasSubstr("--resume"));
  EXPECT_THAT(result.out, HasSubstr("\n  next: rockyard run "));
  EXPECT_TRUE(result.out.ends_with(" --resume\n")) << result.out;
  const std::int64_t stored = Summary("a")["trials"]["stored"];
  EXPECT_LT(stored, 100000);
  EXPECT_EQ(Summary("a")["trials"]["planned"], 100000);
  const std::int64_t prefix = Summary("a")["trials"]["completed"];
  EXPECT_LE(prefix, stored);
  EXPECT_GE(prefix, stored - 2) << "two threads leave no more than that open";
  EXPECT_THAT(RunTo(2, {"baseline", "a", "--reason", "first", "--out", "b.json"}).err,
              HasSubstr("is unfinished: " + std::to_string(prefix) + " of 100000 trials"));
}

TEST_F(CliRun, AFolderThatHoldsARunIsRefusedResumedOrSetAside) {
  Run(QuickRun("a", 2));
  const std::string store = ReadFile(work() / "a" / "results.sqlite");

  EXPECT_THAT(RunTo(2, QuickRun("a", 2)).err, HasSubstr("--resume"));
  EXPECT_EQ(ReadFile(work() / "a" / "results.sqlite"), store);

  RunTo(0, With(QuickRun("a", 2), {"--resume"}));

  EXPECT_THAT(RunTo(2, With(QuickRun("a", 2), {"--resume", "--seed", "7"})).err,
              HasSubstr("seed: is 1 in the stored run and 7 now"));

  EXPECT_THAT(RunTo(0, With(QuickRun("a", 1), {"--force"})).err, HasSubstr("results.old-1.sqlite"));
  EXPECT_TRUE(fs::exists(work() / "a" / "results.old-1.sqlite"));
  EXPECT_EQ(Summary("a")["trials"]["completed"], 1);

  RunTo(0, With(QuickRun("a", 2), {"--resume", "--force", "--seed", "7"}));
  EXPECT_TRUE(fs::exists(work() / "a" / "results.old-2.sqlite"));
}

// As "$ROOT/$NAME" makes it where ROOT is "/".
TEST_F(CliRun, TwoSlashesBeginAPathAsOneDoes) {
  const Words words = QuickRun("/" + (work() / "a").string(), 2);
  RunTo(0, words);
  const std::string hash = Hash("a");
  RunTo(0, With(words, {"--force"}));
  EXPECT_EQ(Hash("a"), hash);
  EXPECT_TRUE(fs::exists(work() / "a/results.old-1.sqlite"));
}

TEST_F(CliRun, AFolderWithOtherThingsIsLeftAlone) {
  WriteFile(work() / "precious.txt", "mine");
  EXPECT_THAT(RunTo(2, QuickRun(".", 1)).err, HasSubstr("not empty"));
  EXPECT_FALSE(fs::exists(work() / "results.sqlite"));
}

TEST_F(CliRun, ADamagedStoreIsRefusedAndKept) {
  Run(QuickRun("a", 2));
  WriteFile(work() / "a" / "results.sqlite", "no database at all");
  const CommandResult refused = RunTo(2, With(QuickRun("a", 2), {"--resume"}));
  EXPECT_THAT(refused.err, Says("results.sqlite", "--force"));
  EXPECT_EQ(ReadFile(work() / "a" / "results.sqlite"), "no database at all");
  RunTo(0, With(QuickRun("a", 2), {"--resume", "--force"}));
  EXPECT_EQ(ReadFile(work() / "a" / "results.old-1.sqlite"), "no database at all");
}

TEST_F(CliRun, ResumeKeepsThePlanAndNeedsNoRunToBeThere) {
  RunTo(0, With(QuickRun("a", 4), {"--resume"}));
  Words words = QuickRun("a", 0);
  words.resize(words.size() - 2);  // without --trials
  RunTo(0, With(words, {"--resume"}));
  EXPECT_EQ(Summary("a")["trials"]["completed"], 4) << "not the 300 of the scenario";
  RunTo(0, With(QuickRun("a", 2), {"--resume"}));
  EXPECT_EQ(Summary("a")["trials"]["completed"], 4) << "nothing is taken away";
}

TEST_F(CliRun, JsonAndQuiet) {
  const CommandResult as_json = Run(With(QuickRun("a", 1), {"--json"}));
  EXPECT_EQ(json::parse(as_json.out), Summary("a"));
  const CommandResult quiet = Run(With(QuickRun("b", 1), {"--quiet"}));
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(quiet.exit_code, 0);
}

TEST_F(CliRun, TheResolvedScenarioRunsToTheSameHash) {
  Run(QuickRun("a", 2));
  RunTo(0, {"run", "a/scenario.resolved.json", "--out", "b"});
  RunTo(0, {"run", "a", "--out", "c"});
  EXPECT_EQ(Hash("b"), Hash("a"));
  EXPECT_EQ(Hash("c"), Hash("a"));
}

TEST_F(CliRun, DefaultFolder) {
  Words words = QuickRun("", 1);
  words.erase(words.begin() + 2, words.begin() + 4);
  RunTo(0, With(words, {"--seed", "5"}));
  EXPECT_TRUE(fs::exists(work() / "results/runs/nominal-seed5/summary.json"));
}

using CliNext = CommandTest;

std::string LastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  const std::size_t begin = text.rfind('\n', end);
  return text.substr(begin + 1, end - begin);
}

TEST_F(CliNext, IsTheLastLineOfARun) {
  const CommandResult run = RunTo(0, QuickRun("a", 2));
  EXPECT_THAT(LastLine(run.out), StartsWith("  next: rockyard "));
  EXPECT_THAT(LastLine(run.out), HasSubstr(" a"));
}

// Also where more is told after the report, on the other stream.
TEST_F(CliNext, IsTheLastLineAfterTraces) {
  std::string line = std::string("exec 2>&1; ") + ROCKYARD_COMMAND;
  for (const std::string& word : With(QuickRun("a", 2), {"--traces", "all"})) line += " " + word;
  const CommandResult run = Wait(StartProgram({"/bin/sh", "-c", line}));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("2 traces written"));
  EXPECT_THAT(LastLine(run.out), StartsWith("  next: rockyard "));
  EXPECT_EQ(run.out.find("next:"), run.out.rfind("next:"));
}

TEST_F(CliNext, IsForPeopleOnly) {
  EXPECT_THAT(Run(With(QuickRun("a", 1), {"--json"})).out, Not(HasSubstr("next:")));
  EXPECT_EQ(Run(With(QuickRun("b", 1), {"--quiet"})).out, "");
}

TEST_F(CliNext, ShardsAreMerged) {
  const CommandResult run = Run(With(QuickRun("a", 4), {"--shard", "1/2"}));
  EXPECT_EQ(LastLine(run.out), "  next: rockyard merge SHARD... --out FOLDER");
}

// A run with other settings than its scenario's is not taken for the published case.

constexpr const char* kRocks = "terrain.rocks.k_per_m2=0.002";

class CliSettings : public CommandTest {
 protected:
  static std::string Reference() { return Source("results/reference/matthies1995.json"); }
  CommandResult Check(const std::string& run, const Words& more = {}) const {
    return Run(With({"check", run, "--against", Reference(), "--replicates", "100"}, more));
  }
  json Changed(const std::string& run) const {
    return json::parse(Check(run, {"--json"}).out)["not_the_published_case"];
  }
  json Settings(const std::string& run, const std::string& file = "summary.json") const {
    return json::parse(ReadFile(work() / run / file))["settings"];
  }
};

TEST_F(CliSettings, OfARunAreToldAndRecorded) {
  const CommandResult run =
      RunTo(0, With(QuickRun("a", 2), {"--set", kRocks, "--ablate", "perfect_localization"}));
  EXPECT_THAT(run.out, HasSubstr("with referee.time_limit_s=1, terrain.rocks.k_per_m2=0.002"));
  const json told = {"referee.time_limit_s=1", kRocks, "--ablate perfect_localization"};
  EXPECT_EQ(Settings("a"), told);
  EXPECT_EQ(Settings("a", "scenario.resolved.json"), told);
  // What comes of it, has them too.
  json more = told;
  more.push_back("course.goal_x_m=4");
  for (const char* source : {"a", "a/scenario.resolved.json"}) {
    const CommandResult again = RunTo(
        0, {"run", source, "--out", "b", "--force", "--trials", "1", "--set", "course.goal_x_m=4"});
    EXPECT_EQ(Settings("b"), more) << source;
  }
}

TEST_F(CliSettings, OfAnotherCaseStandBesideItsVerdicts) {
  RunTo(0, With(QuickRun("a", 2), {"--set", kRocks}));
  EXPECT_THAT(Check("a").out,
              Says("NOT the published case", "terrain.rocks.k_per_m2 is 0.002, 0.00415 in"));
  const json changed = Changed("a");
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0]["scenario"], "nominal");
  EXPECT_EQ(changed[0]["settings"].size(), 2U);
}

TEST_F(CliSettings, OfThePublishedCaseAreNot) {
  RunTo(0, {"run", Scenario("nominal"), "--trials", "1", "--seed", "7", "--out", "a"});
  EXPECT_EQ(Settings("a"), json::array());
  EXPECT_THAT(Check("a").out, Not(HasSubstr("NOT the published case")));
  EXPECT_EQ(Changed("a"), json::array());
}

// Nothing is recorded of a file that was edited under its name.
TEST_F(CliSettings, OfAnEditedFileAreFound) {
  json scenario = json::parse(ReadFile(Scenario("nominal")), nullptr, true, true);
  scenario["referee"]["time_limit_s"] = 1;
  WriteFile(work() / "mine.json", scenario.dump());
  RunTo(0, {"run", "mine.json", "--trials", "1", "--out", "a"});
  EXPECT_EQ(Settings("a"), json::array());
  const json changed = Changed("a");
  ASSERT_EQ(changed.size(), 1U);
  ASSERT_EQ(changed[0]["settings"].size(), 1U);
  EXPECT_THAT(changed[0]["settings"][0].get<std::string>(), HasSubstr("referee.time_limit_s is 1"));
}

// A reference away from its scenarios: what the run itself has recorded.
TEST_F(CliSettings, AreThoseRecordedWhereTheFileIsNotThere) {
  RunTo(0, With(QuickRun("a", 1), {"--set", kRocks}));
  WriteFile(work() / "reference.json", ReadFile(Reference()));
  const CommandResult result =
      Run({"check", "a", "--against", "reference.json", "--replicates", "100", "--json"});
  EXPECT_THAT(result.err, HasSubstr("is not known"));
  const json changed = json::parse(result.out)["not_the_published_case"];
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_THAT(changed[0]["settings"], ElementsAre("referee.time_limit_s=1", kRocks));
}

}  // namespace
}  // namespace rockyard::app
