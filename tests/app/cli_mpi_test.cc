// Campaigns on several ranks with the real mpirun, all on this machine.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/watched_run.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CliMpi : public WatchedRunTest {
 protected:
  CliMpi() : WatchedRunTest(1) {
    // Tests run as root in containers, with more ranks than cores.
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
    // What MPI keeps until a process ends is no leak of ours, and its libraries are gone by then.
    setenv("LSAN_OPTIONS", "detect_leaks=0", 1);
  }

  pid_t StartOn(int ranks, const std::vector<std::string>& words) const {
    return StartProgram(With({MPIRUN, "-n", std::to_string(ranks), ROCKYARD_COMMAND}, words));
  }
  CommandResult RunOn(int ranks, const std::vector<std::string>& words) const {
    return Wait(StartOn(ranks, words));
  }

  // What is stored stays when the rank of that number is killed, and others go on: on so many
  // ranks, or without mpirun (0).
  void ExpectKillLosesNothing(std::size_t rank, int ranks_of_resume) const {
    const pid_t process = StartOn(3, Drives("a", 400));
    ASSERT_TRUE(WaitForTrials("a", 30));
    const std::vector<pid_t> ranks = ChildrenOf(process);
    ASSERT_EQ(ranks.size(), 3U);
    kill(ranks[rank], SIGKILL);
    EXPECT_NE(Wait(process).exit_code, 0);
    const std::size_t stored = Stored("a");
    EXPECT_GE(stored, 30U);
    EXPECT_LT(stored, 400U);
    const std::vector<std::string> resume = Drives("a", 400, {"--resume"});
    const CommandResult resumed =
        ranks_of_resume > 0 ? RunOn(ranks_of_resume, resume) : Run(resume);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(Hash("a"), PlainHash(400));
  }
};

TEST_F(CliMpi, RanksAndThreadsGiveTheSameHash) {
  for (const int ranks : {1, 2, 3}) {
    const std::string out = "ranks" + std::to_string(ranks);
    const CommandResult result = RunOn(ranks, Drives(out, 60, {}, ranks == 3 ? 2 : 1));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(Hash(out), PlainHash(60)) << ranks << " ranks";
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

// Also when the others are sooner: mpirun ends all as soon as one has left with an error.
TEST_F(CliMpi, BadInputIsToldThoughTheFirstRankComesLast) {
  const std::string late = "test $OMPI_COMM_WORLD_RANK != 0 || sleep 1; exec \"$@\"";
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--set", "nothing.at=1"}, {"--nonsense"}}) {
    const CommandResult result = Wait(StartProgram(With(
        {MPIRUN, "-n", "3", "sh", "-c", late, "late", ROCKYARD_COMMAND}, Drives("a", 5, wrong))));
    EXPECT_EQ(result.exit_code, 2) << wrong.front();
    EXPECT_THAT(result.err, HasSubstr("error: ")) << wrong.front();
  }
}

TEST_F(CliMpi, KilledRankLosesNoStoredTrialAndOthersGoOn) { ExpectKillLosesNothing(2, 2); }

TEST_F(CliMpi, KilledRankZeroIsResumedWithoutMpi) { ExpectKillLosesNothing(0, 0); }

TEST_F(CliMpi, CtrlCEndsAllRanksPolitely) {
  const pid_t process = StartOn(3, Drives("a", 100000));
  ASSERT_TRUE(WaitForTrials("a", 20));
  const std::vector<pid_t> ranks = ChildrenOf(process);
  kill(process, SIGINT);
  const CommandResult result = Wait(process);
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("--resume"));
  EXPECT_TRUE(fs::exists(work() / "a" / "summary.json")) << "rank 0 had the time to report";
  for (const pid_t rank : ranks) EXPECT_TRUE(WaitForEnd(rank));
}

// Rank 0 writes them, while the others wait.
TEST_F(CliMpi, TracesAreThoseOfOneProcess) {
  const std::vector<std::string> traces{"--traces", "all"};
  ASSERT_EQ(Run(Drives("plain", 4, traces)).exit_code, 0);
  std::vector<std::string> words = Drives("a", 4, With(traces, {"--json"}));
  words.erase(std::find(words.begin(), words.end(), "--quiet"));
  const CommandResult result = RunOn(2, words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["trials"]["completed"], 4);
  EXPECT_THAT(result.err, HasSubstr("4 traces written, in a/traces"));
  for (int trial = 0; trial < 4; ++trial) {
    const std::string file = "traces/trial-00000" + std::to_string(trial) + ".npz";
    EXPECT_FALSE(ReadFile(work() / "a" / file).empty());
    EXPECT_EQ(ReadFile(work() / "a" / file), ReadFile(work() / "plain" / file));
  }
}

TEST_F(CliMpi, CtrlCDuringTracesLeavesTheRestToResume) {
  const std::vector<std::string> traces{"--traces", "all", "--trace-format", "csv"};
  const pid_t process = StartOn(2, Drives("a", 300, traces));
  const fs::path third = work() / "a/traces/trial-000002.csv";
  ASSERT_TRUE(WaitUntil([&] { return fs::exists(third); }));
  kill(process, SIGINT);
  EXPECT_NE(Wait(process).exit_code, 0);
  const auto files = [&] {
    const fs::directory_iterator folder(work() / "a/traces");
    return std::distance(begin(folder), end(folder));
  };
  EXPECT_LT(files(), 300);
  EXPECT_EQ(Run(Drives("a", 300, With(traces, {"--resume"}))).exit_code, 0);
  EXPECT_EQ(files(), 300);
}

// One rank told to end gives its trials back; the others finish the campaign.
TEST_F(CliMpi, OneRankMayLeave) {
  const pid_t process = StartOn(3, Drives("a", 400));
  ASSERT_TRUE(WaitForTrials("a", 30));
  const std::vector<pid_t> ranks = ChildrenOf(process);
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks.back(), SIGTERM);
  const CommandResult result = Wait(process);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Hash("a"), PlainHash(400));
}

// A rank that is frozen is named, others run its trials, and the job ends with the code of a
// campaign that is whole.
TEST_F(CliMpi, AFrozenRankIsGivenUp) {
  const pid_t process = StartOn(3, Drives("a", 400, {"--rank-silence", "8"}));
  ASSERT_TRUE(WaitForTrials("a", 30));
  const std::vector<pid_t> ranks = ChildrenOf(process);
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks.back(), SIGSTOP);
  const CommandResult result = Wait(process);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("rank 2 has said nothing for 8 s"));
  EXPECT_EQ(Hash("a"), PlainHash(400));
  EXPECT_TRUE(WaitForEnd(ranks.back()));
}

// Every trial takes too long: rank 0 and the others say so as a process alone does.
TEST_F(CliMpi, AHangingTrialIsNotedAndStaysPending) {
  const CommandResult result =
      RunOn(2, Drives("a", 2,
                      {"--trial-cpu-limit", "0.01", "--set", "rover.physics.step_s=0.0001", "--set",
                       "rover.fidelity=multibody", "--set", "referee.time_limit_s=5000", "--set",
                       "rover.drive.speed_m_s=0.01"}));
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_THAT(result.err, HasSubstr("--trial-cpu-limit"));
  EXPECT_THAT(result.err, HasSubstr("is pending"));
  const batch::ResultStore store = batch::ResultStore::Read(work() / "a");
  const std::vector<batch::InfrastructureFault> faults = store.InfrastructureFaults();
  ASSERT_FALSE(faults.empty());
  for (const batch::InfrastructureFault& fault : faults) EXPECT_EQ(fault.kind, "cpu_time_limit");
}

}  // namespace
}  // namespace rockyard::app
