// Signals, traces, and trials that hang, on several ranks.
#include "app/mpi_runs.h"

namespace rockyard::app {
namespace {

using CliMpiLong = MpiRuns;

// Also when the others are sooner: mpirun ends all as soon as one has left with an error.
TEST_F(CliMpiLong, BadInputIsToldThoughTheFirstRankComesLast) {
  const std::string late = "test $OMPI_COMM_WORLD_RANK != 0 || sleep 1; exec \"$@\"";
  for (const Words& wrong : {Words{"--set", "nothing.at=1"}, {"--nonsense"}}) {
    const CommandResult result = Wait(StartProgram(With(
        {MPIRUN, "-n", "3", "sh", "-c", late, "late", ROCKYARD_COMMAND}, Drives("a", 5, wrong))));
    EXPECT_EQ(result.exit_code, 2) << wrong.front();
    EXPECT_THAT(result.err, HasSubstr("error: ")) << wrong.front();
  }
}

TEST_F(CliMpiLong, KilledRankZeroIsResumedWithoutMpi) { ExpectKillLosesNothing(0, 0); }

TEST_F(CliMpiLong, CtrlCEndsAllRanksPolitely) {
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
TEST_F(CliMpiLong, TracesAreThoseOfOneProcess) {
  const Words traces{"--traces", "all"};
  RunTo(0, Drives("plain", 4, traces));
  Words words = Drives("a", 4, With(traces, {"--json"}));
  words.erase(std::find(words.begin(), words.end(), "--quiet"));
  const CommandResult result = RunOn(2, words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["trials"]["completed"], 4);
  EXPECT_THAT(result.err, HasSubstr("4 traces written, in a/traces"));
  for (int trial = 0; trial < 4; ++trial) {
    const std::string file = "traces/trial-00000" + std::to_string(trial) + ".npz";
    EXPECT_FALSE(ReadFile(work() / "a" / file).empty());
    EXPECT_EQ(ReadFile(work() / "a" / file), ReadFile(work() / "plain" / file));
  }
}

TEST_F(CliMpiLong, CtrlCDuringTracesLeavesTheRestToResume) {
  const Words traces{"--traces", "all", "--trace-format", "csv"};
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
  RunTo(0, Drives("a", 300, With(traces, {"--resume"})));
  EXPECT_EQ(files(), 300);
}

// One rank told to end gives its trials back; the others finish the campaign.
TEST_F(CliMpiLong, OneRankMayLeave) {
  const pid_t process = StartOn(3, Drives("a", 400));
  ASSERT_TRUE(WaitForTrials("a", 30));
  const std::vector<pid_t> ranks = ChildrenOf(process);
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks.back(), SIGTERM);
  WaitTo(0, process);
  EXPECT_EQ(Hash("a"), PlainHash(400));
}

// A rank that is frozen is named, others run its trials, and the job ends with the code of a
// campaign that is whole.
TEST_F(CliMpiLong, AFrozenRankIsGivenUp) {
  const pid_t process = StartOn(3, Drives("a", 400, {"--rank-silence", "8"}));
  ASSERT_TRUE(WaitForTrials("a", 30));
  const std::vector<pid_t> ranks = ChildrenOf(process);
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks.back(), SIGSTOP);
  EXPECT_THAT(WaitTo(0, process).err, HasSubstr("rank 2 has said nothing for 8 s"));
  EXPECT_EQ(Hash("a"), PlainHash(400));
  EXPECT_TRUE(WaitForEnd(ranks.back()));
}

// Every trial takes too long: rank 0 and the others say so as a process alone does.
TEST_F(CliMpiLong, AHangingTrialIsNotedAndStaysPending) {
  const CommandResult result =
      RunOn(2, Drives("a", 2,
                      {"--trial-cpu-limit", "0.01", "--set", "rover.physics.step_s=0.0001", "--set",
                       "rover.fidelity=multibody", "--set", "referee.time_limit_s=5000", "--set",
                       "rover.drive.speed_m_s=0.01"}));
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_THAT(result.err, Says("--trial-cpu-limit", "is pending"));
  const batch::ResultStore store = batch::ResultStore::Read(work() / "a");
  const std::vector<batch::InfrastructureFault> faults = store.InfrastructureFaults();
  ASSERT_FALSE(faults.empty());
  for (const batch::InfrastructureFault& fault : faults) EXPECT_EQ(fault.kind, "cpu_time_limit");
}

}  // namespace
}  // namespace rockyard::app
