// What goes wrong around a campaign: every fault ends with a clear message, and no finished trial
// is lost. Disks that are full or lose parts of a store, and more of each, are in tests/batch.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "app/watched_run.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using batch::ResultStore;
using testing::AnyOf;
using testing::HasSubstr;

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
  ASSERT_EQ(Run(Drives("a", 5)).exit_code, 0);
  const std::string before = Hash("a");
  const CommandResult result =
      RunTo(2, Drives("a", 10, {"--resume", "--set", "terrain.rocks.k_per_m2=0.02"}));
  EXPECT_THAT(result.err, Says("terrain.rocks.k_per_m2: is ", "0.02 now"));
  EXPECT_EQ(Hash("a"), before);
}

TEST_F(CliFault, StoreLockedForAMomentIsWaitedFor) {
  ASSERT_EQ(Run(Drives("a", 5)).exit_code, 0);
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
  ASSERT_EQ(Run(Drives("a", 40)).exit_code, 0);
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

}  // namespace
}  // namespace rockyard::app
