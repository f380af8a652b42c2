// Campaigns on several ranks; what else may happen to them in cli_mpi_long_test.cc.
#include "app/mpi_runs.h"

namespace rockyard::app {
namespace {

using CliMpi = MpiRuns;

TEST_F(CliMpi, RanksAndThreadsGiveTheSameHash) {
  for (const int ranks : {1, 3}) {
    const std::string out = "ranks" + std::to_string(ranks);
    const CommandResult result = RunOn(ranks, Drives(out, 30, {}, ranks == 3 ? 2 : 1));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(Hash(out), PlainHash(30)) << ranks << " ranks";
    EXPECT_TRUE(fs::exists(work() / out / "summary.json"));
  }
}

TEST_F(CliMpi, OneSummaryOnTheTerminal) {
  Words words = Drives("a", 30, {"--json"});
  words.erase(std::find(words.begin(), words.end(), "--quiet"));
  const CommandResult result = RunOn(3, words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["trials"]["completed"], 30);
}

// One message, the exit code of bad input, nothing written, no hang.
TEST_F(CliMpi, BadInputIsToldOnce) {
  for (const Words& wrong : {Words{"--set", "nothing.at=1"}, {"--nonsense"}, {"--shard", "5/4"}}) {
    const CommandResult result = RunOn(3, Drives("a", 5, wrong));
    EXPECT_EQ(result.exit_code, 2) << wrong.front();
    const std::size_t first = result.err.find("error: ");
    EXPECT_NE(first, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("error: ", first + 1), std::string::npos) << result.err;
    EXPECT_TRUE(NothingWritten());
  }
}

TEST_F(CliMpi, KilledRankLosesNoStoredTrialAndOthersGoOn) { ExpectKillLosesNothing(2, 2); }

}  // namespace
}  // namespace rockyard::app
