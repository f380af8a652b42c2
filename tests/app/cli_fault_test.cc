// What goes wrong around a campaign: every fault ends with a clear message, and no finished trial
// is lost. Disks that are full or lose parts of a store, and more of each, are in tests/batch.
#include <sys/resource.h>

#include <new>
#include <stdexcept>

#include "app/console.h"
#include "app/run_display.h"
#include "app/watched_run.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "campaign/campaign_process.h"
#include "campaign/campaign_traces.h"

namespace rockyard::app {
namespace {

using batch::ResultStore;
using testing::AnyOf;

class CliFault : public WatchedRunTest {
 protected:
  CliFault() : WatchedRunTest(2) {}
};

TEST_F(CliFault, KilledWorkerIsReplaced) {
  ExpectReplaced(SIGKILL, "SIGKILL");
  EXPECT_LE(ResultStore::Read(work() / "a").InfrastructureFaults().size(), 2U) << "two threads";
}

TEST_F(CliFault, SignalsReachTheWorker) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string out = "run" + std::to_string(signal);
    const pid_t process = Start(Drives(out, 100000));
    ASSERT_TRUE(WaitForTrials(out, 10));
    const pid_t worker = WorkerOf(process);
    kill(process, signal);
    EXPECT_THAT(WaitTo(130, process).err, HasSubstr("--resume"));
    EXPECT_FALSE(Alive(worker));
    EXPECT_GE(Stored(out), 10U);
  }
}

TEST_F(CliFault, TwoRunsOnOneFolder) {
  const pid_t first = Start(Drives("a", 300));
  ASSERT_TRUE(WaitForTrials("a", 5));
  // The second one writes elsewhere than the first what it says.
  fs::create_directories(work() / "elsewhere");
  const std::string command = std::string(ROCKYARD_COMMAND) + " run '" + Scenario("nominal") +
                              "' --out '" + (work() / "a").string() +
                              "' --set referee.time_limit_s=300 --resume 2> '" +
                              (work() / "elsewhere/err").string() + "'";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  EXPECT_THAT(ReadFile(work() / "elsewhere/err"), HasSubstr("in use by another run"));
  EXPECT_EQ(Wait(first).exit_code, 0);
  EXPECT_EQ(Hash("a"), PlainHash(300));
}

TEST_F(CliFault, ScenarioChangedBetweenRuns) {
  RunTo(0, Drives("a", 5));
  const std::string before = Hash("a");
  const CommandResult result =
      RunTo(2, Drives("a", 10, {"--resume", "--set", "terrain.rocks.k_per_m2=0.02"}));
  EXPECT_THAT(result.err, Says("terrain.rocks.k_per_m2: is ", "0.02 now"));
  EXPECT_EQ(Hash("a"), before);
}

TEST_F(CliFault, StoreLockedForAMomentIsWaitedFor) {
  RunTo(0, Drives("a", 5));
  batch::SqliteDatabase other(batch::StorePath(work() / "a"), batch::Access::kChange);
  other.Execute("BEGIN IMMEDIATE");
  // A program of its own: a forked process would have the lock as well.
  const pid_t process = StartProgram(With({ROCKYARD_COMMAND}, Drives("a", 50, {"--resume"})));
  usleep(700000);
  other.Execute("ROLLBACK");
  WaitTo(0, process);
  EXPECT_EQ(Hash("a"), PlainHash(50));
}

TEST_F(CliFault, StoreCutOffIsRefusedAndKept) {
  RunTo(0, Drives("a", 40));
  const fs::path store = batch::StorePath(work() / "a");
  fs::resize_file(store, fs::file_size(store) / 2);
  const std::string half = ReadFile(store);
  const CommandResult result = RunTo(2, Drives("a", 40, {"--resume"}));
  EXPECT_THAT(result.err, Says("results.sqlite", "--force"));
  EXPECT_EQ(ReadFile(store), half);
}

TEST_F(CliFault, FolderThatCannotBeWritten) {
  WriteFile(work() / "file", "mine");
  for (const std::string out : {"file", "file/below", "/proc/rockyard", "/sys/rockyard"}) {
    const CommandResult result = Run(Drives(out, 5));
    EXPECT_EQ(result.exit_code, 2) << out;
    EXPECT_THAT(result.err, AnyOf(HasSubstr("cannot be"), HasSubstr("is a file"))) << out;
    EXPECT_THAT(result.err, AnyOf(HasSubstr("--out"), HasSubstr("use another one"))) << out;
  }
  EXPECT_EQ(ReadFile(work() / "file"), "mine");
}

// A limit on the size of files stands in for a full disk, in worker and supervisor alike.
TEST_F(CliFault, DiskFull) {
  rlimit former{};
  getrlimit(RLIMIT_FSIZE, &former);
  const rlimit small{200000, former.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const pid_t process = Start(Drives("a", 100000));
  setrlimit(RLIMIT_FSIZE, &former);
  const CommandResult result = WaitTo(5, process);
  EXPECT_THAT(result.err, Says("results.sqlite: cannot be written", "could not be stored"));
  const std::size_t stored = Stored("a");
  EXPECT_GT(stored, 0U);
  const auto trials = static_cast<int>(stored) + 50;
  RunTo(0, Drives("a", trials, {"--resume"}));
  EXPECT_EQ(Hash("a"), PlainHash(trials));
}

// What the machine lacks is told as such, whether a run has begun or not.
TEST_F(CliFault, NoRoomAtAll) {
  rlimit former{};
  getrlimit(RLIMIT_FSIZE, &former);
  const rlimit small{8192, former.rlim_max};
  const auto former_action = std::signal(SIGXFSZ, SIG_IGN);  // as a disk that is full: no signal
  setrlimit(RLIMIT_FSIZE, &small);
  const pid_t process = Start(Drives("deep/er/a", 5));
  setrlimit(RLIMIT_FSIZE, &former);
  std::signal(SIGXFSZ, former_action);
  EXPECT_THAT(WaitTo(5, process).err, HasSubstr("deep/er/a/results.sqlite: cannot be written"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliFault, NoMoreOpenFiles) {
  // Enough to read the scenario and to claim the folder, and too few to make the store.
  for (const std::string limit : {"6", "7"}) {
    std::string line =
        "exec 3>&- 4>&- 5>&- 6>&- 7>&- 8>&- 9>&-; ulimit -n " + limit + "; exec " ROCKYARD_COMMAND;
    for (const std::string& word : Drives("a", 5)) line += " '" + word + "'";
    const CommandResult result = Wait(StartProgram({"/bin/sh", "-c", line}));
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_THAT(result.err, HasSubstr("ulimit -n"));
    EXPECT_TRUE(NothingWritten());
  }
}

// As earlier versions of the program left it when they were killed early.
TEST_F(CliFault, AStoreWithoutAHeadHasNotBegun) {
  fs::create_directories(work() / "a");
  WriteFile(work() / "a" / "results.sqlite", "");
  EXPECT_EQ(Run(Drives("a", 5)).exit_code, 2) << "something is there";
  RunTo(0, Drives("a", 5, {"--resume", "--dry-run"}));
  RunTo(0, Drives("a", 5, {"--resume"}));
  EXPECT_EQ(Hash("a"), PlainHash(5));
  EXPECT_TRUE(fs::exists(work() / "a" / "results.old-1.sqlite"));
}

// What goes wrong while traces are written: one document on standard output, whole files alone, the
// trial named that is to blame, and the others there all the same.

class CliTraceFaults : public WatchedRunTest {
 protected:
  CliTraceFaults() : WatchedRunTest(1) {}

  // Trials of some tenths of a second each, so that there is time to meddle between two of them.
  Words SlowRun(const Words& more) const {
    return With({"run", Scenario("nominal"), "--out", "run", "--trials", "6", "--traces", "all",
                 "--threads", "1"},
                more);
  }

  std::size_t Files() const {
    std::size_t count = 0;
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator(work() / "run/traces", none)) {
      count += entry.is_regular_file() ? 1 : 0;
    }
    return count;
  }

  bool WaitForTraces(std::size_t count) const {
    return WaitUntil([&] { return Files() >= count; });
  }

  // The exit code of writing all traces of `run` with drives that do `hook` first.
  ExitCode Trace(const std::function<void(std::uint64_t trial)>& hook, int threads) {
    campaign::TraceRequest request{.retention = {.all = true}, .threads = threads};
    request.drive = [&](const scenario::Scenario& scenario, std::uint64_t seed,
                        std::uint64_t trial) {
      hook(trial);
      return campaign::RecordDrive(scenario, seed, trial);
    };
    testing::internal::CaptureStderr();
    const campaign::Observer console = MessagesToConsole(Output::kText);
    const campaign::WorkResult result =
        campaign::Recorded(console, [&](campaign::Journal& journal) {
          return campaign::RunContained(
              {.threads = threads}, {journal, campaign::Stop()},
              [](campaign::CampaignProcess&) { return ExitCode::kDone; },
              [&](campaign::CampaignProcess& process) {
                return process.Afterwards(
                    [&](const batch::Mission& mission, batch::FlightLog& log) {
                      return campaign::WriteTraces(work() / "run", request, mission, log, journal);
                    });
              });
        });
    said_ = testing::internal::GetCapturedStderr();
    return result.outcome;
  }

  std::string said_;
};

TEST_F(CliTraceFaults, AKilledWorkerLeavesOneDocument) {
  const pid_t process = Start(SlowRun({"--json"}));
  ASSERT_TRUE(WaitForTraces(2));
  const std::vector<pid_t> workers = ChildrenOf(process);
  ASSERT_EQ(workers.size(), 1U);
  kill(workers.front(), SIGKILL);
  const CommandResult result = WaitTo(0, process);
  EXPECT_EQ(json::parse(result.out)["trials"]["completed"], 6);
  EXPECT_THAT(result.err, HasSubstr("6 traces are in run/traces"));
  EXPECT_EQ(Files(), 6U);
}

TEST_F(CliTraceFaults, CtrlCLeavesWholeFilesAndGoesOn) {
  for (const Words& more : {Words{}, {"--no-supervisor", "--force"}}) {
    const pid_t process = Start(SlowRun(more));
    fs::remove_all(work() / "run/traces");
    ASSERT_TRUE(WaitForTraces(2));
    kill(process, SIGINT);
    EXPECT_THAT(WaitTo(130, process).err, Says("interrupted: ", " of 6 traces", "--resume"));
    EXPECT_LT(Files(), 6U);
    RunTo(0, SlowRun({"--resume"}));
    EXPECT_EQ(Files(), 6U);
  }
}

// Of all cells, not of those that it has come to.
TEST_F(CliTraceFaults, InterruptedInTheFirstCellItCountsAll) {
  WriteFile(work() / "sweep.json",
            "{\"name\": \"s\", \"scenario\": \"" + Scenario("nominal") +
                "\", \"trials\": 6, \"axes\": [{\"path\": \"course.goal_radius_m\", "
                "\"values\": [1, 2]}]}");
  const pid_t process =
      Start({"sweep", "sweep.json", "--out", "run", "--traces", "all", "--threads", "1"});
  ASSERT_TRUE(WaitForTraces(2));
  kill(process, SIGTERM);
  EXPECT_THAT(WaitTo(130, process).err, HasSubstr(" of 12 traces are written"));
}

TEST_F(CliTraceFaults, ADriveThatCrashesIsNamedAndTheOthersGoOn) {
  RunTo(0, With(QuickRun("run", 7), {"--quiet"}));
  const auto crash = [](std::uint64_t trial) {
    if (trial != 3) return;
    std::signal(SIGSEGV, SIG_DFL);
    raise(SIGSEGV);
  };
  for (const int threads : {1, 3}) {
    fs::remove_all(work() / "run/traces");
    EXPECT_EQ(Trace(crash, threads), ExitCode::kFailed);
    EXPECT_THAT(said_, AllOf(HasSubstr("SIGSEGV"), HasSubstr("trial 3: has no trace"),
                             HasSubstr("rockyard replay "), HasSubstr("--trial 3"),
                             Not(HasSubstr("trial 4"))));
    EXPECT_EQ(Files(), 6U);
  }
}

TEST_F(CliTraceFaults, ADriveThatThrowsIsNamedAndTheOthersGoOn) {
  RunTo(0, With(QuickRun("run", 5), {"--quiet"}));
  const auto fail = [](std::uint64_t trial) {
    if (trial == 1) throw std::bad_alloc();
    if (trial == 2) throw std::runtime_error("has no terrain");
  };
  EXPECT_EQ(Trace(fail, 1), ExitCode::kFailed);
  EXPECT_THAT(said_, Says("trial-000001.npz: is not written: std::bad_alloc",
                          "trial-000002.npz: is not written: has no terrain"));
  EXPECT_EQ(Files(), 3U);
}

TEST_F(CliTraceFaults, TheWorstOfAShardAreRefused) {
  EXPECT_THAT(RunTo(2, With(QuickRun("run", 4), {"--shard", "1/2", "--traces", "worst:1"})).err,
              HasSubstr("--traces: worst:N is asked of all trials"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliTraceFaults, MergeSaysThatTracesStayAndTheWholeMakesThem) {
  for (const std::string shard : {"1/2", "2/2"}) {
    RunTo(0, With(QuickRun("shard" + shard.substr(0, 1), 4),
                  {"--shard", shard, "--traces", "all", "--quiet"}));
  }
  const CommandResult merged = RunTo(0, {"merge", "shard1", "shard2", "--out", "run"});
  EXPECT_THAT(merged.err, HasSubstr("traces of shards are not merged"));
  EXPECT_FALSE(fs::exists(work() / "run/traces"));
  RunTo(0, With(QuickRun("run", 4), {"--resume", "--traces", "worst:1", "--quiet"}));
  EXPECT_EQ(Files(), 1U);
}

}  // namespace
}  // namespace rockyard::app
