// rockyard run with shards, stopping rules and dry runs, and rockyard merge.

#include <algorithm>

#include "app/command.h"
#include "batch/sqlite_database.h"

namespace rockyard::app {
namespace {

using testing::IsEmpty;

class CliCampaign : public CommandTest {
 protected:
  CommandResult RunShard(const std::string& folder, const std::string& shard, int trials = 7) {
    return Run(With(QuickRun(folder, trials), {"--shard", shard}));
  }
};

TEST_F(CliCampaign, MergedShardsAreTheRunOfOneMachine) {
  Run(QuickRun("whole", 7));
  RunShard("s1", "1/3");
  const CommandResult second = RunShard("s2", "2/3");
  RunShard("s3", "3/3");
  EXPECT_THAT(second.out, Says("shard 2 of 3", "rockyard merge"));
  EXPECT_FALSE(Summary("s2").contains("declared_success")) << "no rates from a shard";
  EXPECT_EQ(Summary("s2")["accounting"]["planned"], 2);

  const CommandResult merged = RunTo(0, {"merge", "s2", "s3", "s1", "--out", "merged"});
  EXPECT_EQ(Summary("merged")["trial_hash"], Summary("whole")["trial_hash"]);
  EXPECT_EQ(Summary("merged")["accounting"], Summary("whole")["accounting"]);
  EXPECT_EQ(ReadFile(work() / "merged" / "trials.csv"), ReadFile(work() / "whole" / "trials.csv"));

  // As by a job that is started again, although its files were lost.
  fs::remove(work() / "merged" / "trials.csv");
  EXPECT_THAT(RunTo(0, {"merge", "s1", "s2", "s3", "--out", "merged"}).err,
              HasSubstr("merged holds these shards already"));
  EXPECT_EQ(ReadFile(work() / "merged" / "trials.csv"), ReadFile(work() / "whole" / "trials.csv"));
  RunTo(2, {"merge", "s1", "s2", "--out", "merged", "--partial"});
}

TEST_F(CliCampaign, ShardsThatAreNotAllThereAreRefused) {
  RunShard("s1", "1/2");
  const CommandResult missing = RunTo(2, {"merge", "s1", "--out", "merged"});
  EXPECT_THAT(missing.err, HasSubstr("are missing: 2/2"));
  EXPECT_FALSE(fs::exists(work() / "merged"));
  RunTo(0, {"merge", "s1", "--out", "merged", "--partial"});
  EXPECT_EQ(Summary("merged")["accounting"]["pending"], 3);

  EXPECT_THAT(RunTo(2, {"compare", "s1", "merged"}).err, HasSubstr("rockyard merge"));
  EXPECT_THAT(RunTo(2, With(QuickRun("s1", 7), {"--shard", "2/2", "--resume"})).err,
              HasSubstr("shard: is 1/2 in the stored run and 2/2 now"));
  for (const char* wrong : {"0/2", "3/2", "1", "a/b", "1/", "-1/2", "1/99999999999"}) {
    EXPECT_EQ(RunShard("bad", wrong).exit_code, 2) << wrong;
    EXPECT_FALSE(fs::exists(work() / "bad")) << wrong;
  }
}

// Trials of one second all fail, which is soon known well enough.
TEST_F(CliCampaign, StopsByPrecisionAndGoesOnWithTheSameRule) {
  Words words = QuickRun("a", 7);
  const auto trials = std::find(words.begin(), words.end(), "--trials");
  ASSERT_NE(trials, words.end());
  words.erase(trials, trials + 2);
  EXPECT_THAT(
      RunTo(0, With(words, {"--until-half-width", "0.1", "--block", "10", "--max-trials", "200"}))
          .out,
      HasSubstr("precise enough after"));
  const json stopping = Summary("a")["stopping"];
  EXPECT_EQ(stopping["end"], "precise");
  EXPECT_EQ(stopping["trials"], Summary("a")["accounting"]["planned"]);
  EXPECT_EQ(stopping["interval"][0], 0.0);
  EXPECT_LE(stopping["interval"][1], 0.2);
  // One interval for one rate.
  EXPECT_EQ(Summary("a")["declared_success"]["ci95"], stopping["interval"]);
  EXPECT_EQ(Summary("a")["declared_success"]["ci_method"], "clopper_pearson_stopped");
  EXPECT_EQ(Summary("a")["true_success"]["ci_method"], "clopper_pearson_stopped");
  const std::string hash = Summary("a")["trial_hash"];
  RunTo(0, With(words, {"--resume"}));
  EXPECT_EQ(Summary("a")["trial_hash"], hash) << "the rule of the store still holds";

  RunTo(2, With(words, {"--until-half-width", "0.1", "--shard", "1/2", "--out", "b"}));
  EXPECT_EQ(Run(With(words, {"--block", "10"})).exit_code, 2) << "of what?";
}

// A half-width of 0.5 is met without any trial.
TEST_F(CliCampaign, HalfWidthsThatSayNothingAreRefused) {
  Words words = QuickRun("a", 7);
  const auto trials = std::find(words.begin(), words.end(), "--trials");
  words.erase(trials, trials + 2);
  for (const char* wrong : {"0.5", "0.491", "1", "0", "-0.1", "0.0004", "nan", "inf", "x"}) {
    const CommandResult result = Run(With(words, {"--until-half-width", wrong}));
    EXPECT_EQ(result.exit_code, 2) << wrong;
    EXPECT_THAT(result.err, HasSubstr("--until-half-width")) << wrong;
    EXPECT_FALSE(fs::exists(work() / "a")) << wrong;
  }
  RunTo(0, With(words, {"--until-half-width", "0.49", "--block", "1"}));
  EXPECT_GE(Summary("a")["accounting"]["completed"], 1);
}

// What a longer run had stored is no part of a campaign that is content with less.
TEST_F(CliCampaign, RuleOnALongerRunIsTheRunOfTheRule) {
  Words words = QuickRun("a", 30);
  RunTo(0, words);
  const auto trials = std::find(words.begin(), words.end(), "--trials");
  words.erase(trials, trials + 2);
  const Words rule = {"--until-half-width", "0.2", "--block", "10"};
  RunTo(0, With(With(words, rule), {"--resume"}));
  Words fresh = With(words, rule);
  *std::find(fresh.begin(), fresh.end(), "a") = "b";
  RunTo(0, fresh);
  EXPECT_LT(Summary("b")["accounting"]["planned"], 30);
  EXPECT_EQ(Summary("a")["accounting"], Summary("b")["accounting"]);
  EXPECT_EQ(Summary("a")["trial_hash"], Summary("b")["trial_hash"]);
  EXPECT_EQ(ReadFile(work() / "a/trials.csv"), ReadFile(work() / "b/trials.csv"));
}

TEST_F(CliCampaign, RuleNeedsIndependentTrials) {
  Words words = QuickRun("a", 7);
  const auto trials = std::find(words.begin(), words.end(), "--trials");
  words.erase(trials, trials + 2);
  EXPECT_THAT(
      RunTo(2, With(words, {"--until-half-width", "0.1", "--set", "course.trials_per_layout=5"}))
          .err,
      HasSubstr("share a layout"));
  EXPECT_FALSE(fs::exists(work() / "a"));
}

TEST_F(CliCampaign, DryRunWritesNothing) {
  EXPECT_THAT(RunTo(0, With(QuickRun("a", 50), {"--dry-run"})).out,
              HasSubstr("50 trials planned, 0 stored, 50 to run"));
  EXPECT_FALSE(fs::exists(work() / "a"));
  Run(QuickRun("a", 3));
  EXPECT_EQ(Run(With(QuickRun("a", 50), {"--dry-run"})).exit_code, 2) << "as without --dry-run";
  EXPECT_THAT(Run(With(QuickRun("a", 50), {"--dry-run", "--resume"})).out,
              HasSubstr("3 stored, 47 to run"));
}

TEST_F(CliCampaign, EveryTrialIsAccountedFor) {
  const CommandResult result = Run(QuickRun("a", 3));
  EXPECT_THAT(result.out, HasSubstr("3 planned = 3 completed + 0 faulted + 0 pending"));
  EXPECT_EQ(Summary("a")["accounting"]["infrastructure_faults"], 0);
  const CommandResult cell = RunTo(2, {"replay", "a", "--cell", "wrong", "--trial", "0"});
  EXPECT_THAT(cell.err, HasSubstr("is no cell of"));
}

// What commands say of stores that were changed, or that another version made.

class CliStore : public CommandTest {
 protected:
  void SetUp() override {
    RunTo(0, With(QuickRun("run", 3), {"--quiet"}));
    RunTo(0, With(QuickRun("other", 3), {"--quiet"}));
  }

  fs::path store() const { return work() / "run" / "results.sqlite"; }

  // Those that read the values of a run.
  std::vector<Words> Readers() const {
    return {{"report", "run", "--data", "data.json", "--replays", "0"},
            {"compare", "run", "other"},
            {"compare", "other", "run"},
            {"check", "run", "--against", Source("results/reference/matthies1995.json"),
             "--replicates", "100"},
            {"baseline", "run", "--reason", "test", "--out", "b.json"},
            {"replay", "run", "--trial", "1", "--list"},
            {"trace", "run", "--trial", "1"},
            With(QuickRun("run", 3), {"--resume"})};
  }
};

TEST_F(CliStore, OfAnotherVersionIsRefusedByEveryCommand) {
  batch::SqliteDatabase(store(), batch::Access::kChange)
      .Execute("UPDATE meta SET value = '2' WHERE key = 'schema_version'");
  for (const Words& command : Readers()) {
    const CommandResult result = Run(command);
    EXPECT_EQ(result.exit_code, 2) << command.front();
    EXPECT_THAT(result.err, Says("run/results.sqlite", "has version 2, not 3")) << command.front();
  }
}

TEST_F(CliStore, WithAChangedValueIsRefusedByEveryCommand) {
  batch::SqliteDatabase(store(), batch::Access::kChange)
      .Execute("UPDATE trials SET sim_time_s = 2.0 WHERE trial = 1");
  for (const Words& command : Readers()) {
    const CommandResult result = Run(command);
    EXPECT_EQ(result.exit_code, 2) << command.front();
    EXPECT_THAT(result.out, IsEmpty()) << command.front();
    EXPECT_THAT(result.err,
                Says("run/results.sqlite", "table trials, cell 0, trial 1", "row_checksum"))
        << command.front();
  }
}

}  // namespace
}  // namespace rockyard::app
