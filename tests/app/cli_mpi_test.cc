// Campaigns on several ranks with the real mpirun, all on this machine.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "batch/result_store.h"
#include "batch/store_error.h"
#include "batch/trial_hash.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using batch::ResultStore;
using testing::HasSubstr;

class CliMpi : public CommandTest {
 protected:
  CliMpi() {
    // Tests run as root in containers, with more ranks than cores.
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
  }

  pid_t StartOn(int ranks, const std::vector<std::string>& words) const {
    return StartProgram(With({MPIRUN, "-n", std::to_string(ranks), ROCKYARD_COMMAND}, words));
  }
  CommandResult RunOn(int ranks, const std::vector<std::string>& words) const {
    return Wait(StartOn(ranks, words));
  }

  static std::vector<std::string> Drives(const std::string& out, int trials,
                                         const std::vector<std::string>& more = {},
                                         int threads = 1) {
    return With(
        {"run", Scenario("nominal"), "--out", out, "--set", "referee.time_limit_s=300", "--threads",
         std::to_string(threads), "--quiet", "--trials", std::to_string(trials)},
        more);
  }

  std::size_t Stored(const std::string& out) const {
    try {
      return ResultStore::Read(work() / out).Finished().size();
    } catch (const batch::StoreError&) {
      return 0;
    }
  }
  bool WaitForTrials(const std::string& out, std::size_t count) const {
    for (int i = 0; i < 2000 && Stored(out) < count; ++i) usleep(10000);
    return Stored(out) >= count;
  }
  std::string Hash(const std::string& out) const {
    return batch::TrialHash(ResultStore::Read(work() / out).Load());
  }

  // Processes of the command that mpirun has started.
  static std::vector<pid_t> RanksOf(pid_t mpirun) {
    const std::string id = std::to_string(mpirun);
    std::ifstream file("/proc/" + id + "/task/" + id + "/children");
    return {std::istream_iterator<pid_t>(file), {}};
  }
};

TEST_F(CliMpi, RanksAndThreadsGiveTheSameHash) {
  ASSERT_EQ(Run(Drives("plain", 200)).exit_code, 0);
  for (const int ranks : {1, 2, 3}) {
    const std::string out = "ranks" + std::to_string(ranks);
    const CommandResult result = RunOn(ranks, Drives(out, 200, {}, ranks == 3 ? 2 : 1));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(Hash(out), Hash("plain")) << ranks << " ranks";
    EXPECT_TRUE(fs::exists(work() / out / "summary.json"));
  }
}

TEST_F(CliMpi, OneSummaryOnTheTerminal) {
  std::vector<std::string> words = Drives("a", 30, {"--json"});
  words.erase(std::find(words.begin(), words.end(), "--quiet"));
  const CommandResult result = RunOn(3, words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["trials"]["completed"], 30);
}

// One message, the exit code of bad input, nothing written, no hang.
TEST_F(CliMpi, BadInputIsToldOnce) {
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--set", "nothing.at=1"}, {"--nonsense"}, {"--shard", "5/4"}}) {
    const CommandResult result = RunOn(3, Drives("a", 5, wrong));
    EXPECT_EQ(result.exit_code, 2) << wrong.front();
    const std::size_t first = result.err.find("error: ");
    EXPECT_NE(first, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("error: ", first + 1), std::string::npos) << result.err;
    EXPECT_TRUE(NothingWritten());
  }
}

TEST_F(CliMpi, KilledRankLosesNoStoredTrialAndOthersGoOn) {
  ASSERT_EQ(Run(Drives("plain", 600)).exit_code, 0);
  const pid_t process = StartOn(3, Drives("a", 600));
  ASSERT_TRUE(WaitForTrials("a", 30));
  const std::vector<pid_t> ranks = RanksOf(process);
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks.back(), SIGKILL);
  EXPECT_NE(Wait(process).exit_code, 0);
  const std::size_t stored = Stored("a");
  EXPECT_GE(stored, 30U);
  EXPECT_LT(stored, 600U);
  const CommandResult resumed = RunOn(2, Drives("a", 600, {"--resume"}));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(Hash("a"), Hash("plain"));
}

TEST_F(CliMpi, KilledRankZeroIsResumedWithoutMpi) {
  ASSERT_EQ(Run(Drives("plain", 600)).exit_code, 0);
  const pid_t process = StartOn(3, Drives("a", 600));
  ASSERT_TRUE(WaitForTrials("a", 30));
  const std::vector<pid_t> ranks = RanksOf(process);
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks.front(), SIGKILL);
  EXPECT_NE(Wait(process).exit_code, 0);
  EXPECT_GE(Stored("a"), 30U);
  EXPECT_EQ(Run(Drives("a", 600, {"--resume"})).exit_code, 0);
  EXPECT_EQ(Hash("a"), Hash("plain"));
}

TEST_F(CliMpi, CtrlCEndsAllRanksPolitely) {
  const pid_t process = StartOn(3, Drives("a", 100000));
  ASSERT_TRUE(WaitForTrials("a", 20));
  const std::vector<pid_t> ranks = RanksOf(process);
  kill(process, SIGINT);
  const CommandResult result = Wait(process);
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("--resume"));
  EXPECT_TRUE(fs::exists(work() / "a" / "summary.json")) << "rank 0 had the time to report";
  for (const pid_t rank : ranks) EXPECT_TRUE(WaitForEnd(rank));
}

// One rank told to end gives its trials back; the others finish the campaign.
TEST_F(CliMpi, OneRankMayLeave) {
  ASSERT_EQ(Run(Drives("plain", 400)).exit_code, 0);
  const pid_t process = StartOn(3, Drives("a", 400));
  ASSERT_TRUE(WaitForTrials("a", 30));
  const std::vector<pid_t> ranks = RanksOf(process);
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks.back(), SIGTERM);
  const CommandResult result = Wait(process);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Hash("a"), Hash("plain"));
}

}  // namespace
}  // namespace rockyard::app
