// rockyard run, with real trials of one simulated second.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class CliRun : public CommandTest {
 protected:
  json Summary(const std::string& folder) const {
    return json::parse(ReadFile(work() / folder / "summary.json"));
  }
  std::string Hash(const std::string& folder) const { return Summary(folder)["trial_hash"]; }
};

TEST_F(CliRun, WritesTheWholeFolder) {
  const CommandResult result = Run(QuickRun("a", 3));
  EXPECT_EQ(result.exit_code, 0) << result.err;
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
  const CommandResult extended = Run(With(QuickRun("parts", 8), {"--resume"}));
  EXPECT_EQ(extended.exit_code, 0) << extended.err;
  EXPECT_EQ(Hash("two"), Hash("one"));
  EXPECT_EQ(Hash("parts"), Hash("one"));
  Run(With(QuickRun("other", 8), {"--seed", "2"}));
  EXPECT_NE(Hash("other"), Hash("one"));
}

TEST_F(CliRun, AnInterruptStoresWhatIsFinishedAndSaysHowToGoOn) {
  const pid_t process = Start(With(QuickRun("a", 100000), {"--threads", "2"}));
  ASSERT_TRUE(core::WaitForHandler(process, SIGINT));
  ASSERT_TRUE(WaitUntil([&] { return fs::exists(work() / "a" / "results.sqlite"); }));
  usleep(300000);
  kill(process, SIGINT);
  const CommandResult result = Wait(process);
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("--resume"));
  EXPECT_THAT(result.out, HasSubstr("\n  next: rockyard run "));
  EXPECT_TRUE(result.out.ends_with(" --resume\n")) << result.out;
  const std::int64_t stored = Summary("a")["trials"]["stored"];
  EXPECT_LT(stored, 100000);
  EXPECT_EQ(Summary("a")["trials"]["planned"], 100000);
  const std::int64_t prefix = Summary("a")["trials"]["completed"];
  EXPECT_LE(prefix, stored);
  EXPECT_GE(prefix, stored - 2) << "two threads leave no more than that open";
}

TEST_F(CliRun, AFolderThatHoldsARunIsRefusedResumedOrSetAside) {
  Run(QuickRun("a", 2));
  const std::string store = ReadFile(work() / "a" / "results.sqlite");

  const CommandResult refused = Run(QuickRun("a", 2));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--resume"));
  EXPECT_EQ(ReadFile(work() / "a" / "results.sqlite"), store);

  const CommandResult again = Run(With(QuickRun("a", 2), {"--resume"}));
  EXPECT_EQ(again.exit_code, 0) << again.err;

  const CommandResult other = Run(With(QuickRun("a", 2), {"--resume", "--seed", "7"}));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("seed: is 1 in the stored run and 7 now"));

  const CommandResult forced = Run(With(QuickRun("a", 1), {"--force"}));
  EXPECT_EQ(forced.exit_code, 0) << forced.err;
  EXPECT_THAT(forced.err, HasSubstr("results.old-1.sqlite"));
  EXPECT_TRUE(fs::exists(work() / "a" / "results.old-1.sqlite"));
  EXPECT_EQ(Summary("a")["trials"]["completed"], 1);

  const CommandResult either = Run(With(QuickRun("a", 2), {"--resume", "--force", "--seed", "7"}));
  EXPECT_EQ(either.exit_code, 0) << either.err;
  EXPECT_TRUE(fs::exists(work() / "a" / "results.old-2.sqlite"));
}

TEST_F(CliRun, AFolderWithOtherThingsIsLeftAlone) {
  WriteFile(work() / "precious.txt", "mine");
  const CommandResult result = Run(QuickRun(".", 1));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("not empty"));
  EXPECT_FALSE(fs::exists(work() / "results.sqlite"));
}

TEST_F(CliRun, ADamagedStoreIsRefusedAndKept) {
  Run(QuickRun("a", 2));
  WriteFile(work() / "a" / "results.sqlite", "no database at all");
  const CommandResult refused = Run(With(QuickRun("a", 2), {"--resume"}));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("results.sqlite"));
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(ReadFile(work() / "a" / "results.sqlite"), "no database at all");
  EXPECT_EQ(Run(With(QuickRun("a", 2), {"--resume", "--force"})).exit_code, 0);
  EXPECT_EQ(ReadFile(work() / "a" / "results.old-1.sqlite"), "no database at all");
}

TEST_F(CliRun, ResumeKeepsThePlanAndNeedsNoRunToBeThere) {
  EXPECT_EQ(Run(With(QuickRun("a", 4), {"--resume"})).exit_code, 0);
  std::vector<std::string> words = QuickRun("a", 0);
  words.resize(words.size() - 2);  // without --trials
  EXPECT_EQ(Run(With(words, {"--resume"})).exit_code, 0);
  EXPECT_EQ(Summary("a")["trials"]["completed"], 4) << "not the 300 of the scenario";
  EXPECT_EQ(Run(With(QuickRun("a", 2), {"--resume"})).exit_code, 0);
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
  EXPECT_EQ(Run({"run", "a/scenario.resolved.json", "--out", "b"}).exit_code, 0);
  EXPECT_EQ(Run({"run", "a", "--out", "c"}).exit_code, 0);
  EXPECT_EQ(Hash("b"), Hash("a"));
  EXPECT_EQ(Hash("c"), Hash("a"));
}

TEST_F(CliRun, DefaultFolder) {
  std::vector<std::string> words = QuickRun("", 1);
  words.erase(words.begin() + 2, words.begin() + 4);
  EXPECT_EQ(Run(With(words, {"--seed", "5"})).exit_code, 0);
  EXPECT_TRUE(fs::exists(work() / "results/runs/nominal-seed5/summary.json"));
}

}  // namespace
}  // namespace rockyard::app
