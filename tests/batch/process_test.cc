// What a run in a process of its own leaves behind when it is killed or has no space.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "batch/executor.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "batch/trial_hash.h"
#include "core/test_folder.h"
#include "core/wait_until.h"
#include "fake_experiment.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Job {
  fs::path folder;
  int trials = 300;
  int threads = 2;
  int milliseconds = 0;
  int hang_at = -1;
  long file_limit = 0;
};

class Child {
 public:
  explicit Child(const Job& job) : output_(job.folder.string() + ".out") {
    const std::string words[] = {BATCH_CHILD,
                                 job.folder.string(),
                                 std::to_string(job.trials),
                                 std::to_string(job.threads),
                                 std::to_string(job.milliseconds),
                                 std::to_string(job.hang_at),
                                 std::to_string(job.file_limit)};
    process_ = fork();
    if (process_ == 0) Execute(words);
  }
  ~Child() {
    if (process_ > 0) Kill();
    std::error_code ignored;
    fs::remove(output_, ignored);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void Kill() {
    kill(process_, SIGKILL);
    Wait();
  }

  int Wait() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string Output() const {
    std::ifstream file(output_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  template <typename Words>
  [[noreturn]] void Execute(const Words& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int file = open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDOUT_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }

  fs::path output_;
  pid_t process_ = 0;
};

std::size_t StoredTrials(const fs::path& folder) {
  try {
    return ResultStore::Read(folder).Load().size();
  } catch (const StoreError&) {
    return 0;  // not there yet
  }
}

// Waits until the store holds that many trials; false when it never does.
bool WaitForTrials(const fs::path& folder, std::size_t count) {
  return core::WaitUntil([&] { return StoredTrials(folder) >= count; });
}

std::string HashAfterResume(const fs::path& folder, std::int64_t trials) {
  const FolderClaim claim(folder);
  ResultStore store = ResultStore::Resume(folder, FakeIdentity());
  const std::atomic<bool> never_stop = false;
  store.SetPlanned(0, trials);
  RunBatch(FakeExperiment(), store, {.threads = 2}, never_stop);
  return TrialHash(store.Load());
}

TEST(KilledRun, GoesOnToTheSameHash) {
  const core::TestFolder folder;
  Child child({.folder = folder.path(), .milliseconds = 10});
  ASSERT_TRUE(WaitForTrials(folder.path(), 20));
  child.Kill();
  const std::size_t stored = StoredTrials(folder.path());
  EXPECT_GE(stored, 20U);
  EXPECT_LT(stored, 300U);
  EXPECT_EQ(HashAfterResume(folder.path(), 300), FakeHash(300));
}

TEST(KilledRun, FinishedTrialsAreDurableWhileAnotherHangs) {
  const core::TestFolder folder;
  Child child({.folder = folder.path(), .trials = 50, .hang_at = 7});
  ASSERT_TRUE(WaitForTrials(folder.path(), 49)) << "all but the one that hangs";
  child.Kill();
  EXPECT_EQ(StoredTrials(folder.path()), 49U);
  EXPECT_EQ(HashAfterResume(folder.path(), 50), FakeHash(50));
}

TEST(KilledRun, KilledAgainAndAgain) {
  const core::TestFolder folder;
  std::size_t stored = 0;
  while (stored < 60) {
    Child child({.folder = folder.path(), .trials = 60, .milliseconds = 5});
    ASSERT_TRUE(WaitForTrials(folder.path(), std::min<std::size_t>(stored + 15, 60)));
    child.Kill();
    const std::size_t now = StoredTrials(folder.path());
    EXPECT_GE(now, stored) << "no stored trial is lost";
    stored = now;
  }
  EXPECT_EQ(HashAfterResume(folder.path(), 60), FakeHash(60));
}

TEST(TwoRuns, TheSecondIsRefusedAndTheFirstUnharmed) {
  const core::TestFolder folder;
  Child first({.folder = folder.path(), .trials = 20, .hang_at = 3});
  ASSERT_TRUE(WaitForTrials(folder.path(), 19));
  Child second({.folder = folder.path(), .trials = 20});
  EXPECT_EQ(second.Wait(), 3);
  EXPECT_THAT(second.Output(), HasSubstr("in use by another run"));
  first.Kill();
  EXPECT_EQ(StoredTrials(folder.path()), 19U);
  // The claim ended with the process.
  EXPECT_EQ(HashAfterResume(folder.path(), 20), FakeHash(20));
}

void ExpectGracefulFailure(const fs::path& folder, Child& child) {
  EXPECT_EQ(child.Wait(), 3);
  EXPECT_THAT(child.Output(), HasSubstr("results.sqlite"));
  EXPECT_THAT(child.Output(), HasSubstr("could not be stored"));
  EXPECT_THAT(child.Output(), HasSubstr("--resume"));
  const std::vector<truth::Record> stored = ResultStore::Read(folder).Load();
  EXPECT_GT(stored.size(), 0U);
  for (const truth::Record& record : stored) {
    const truth::Record plain = FakeRecord(1, record.trial);
    EXPECT_EQ(TrialHash(std::span(&record, 1)), TrialHash(std::span(&plain, 1)));
  }
}

TEST(FullDisk, FileSizeLimitLosesNoStoredTrial) {
  const core::TestFolder folder;
  Child child({.folder = folder.path(), .trials = 20000, .milliseconds = 1, .file_limit = 120000});
  ExpectGracefulFailure(folder.path(), child);
  EXPECT_EQ(HashAfterResume(folder.path(), 400),
            FakeHash(std::max<std::uint64_t>(400, StoredTrials(folder.path()))));
}

// A small file system of its own, where the test may mount one.
TEST(FullDisk, RealOneLosesNoStoredTrial) {
  const core::TestFolder disk;
  if (mount("tmpfs", disk.path().c_str(), "tmpfs", 0, "size=256k") != 0) {
    GTEST_SKIP() << "mounting needs root; FileSizeLimitLosesNoStoredTrial covers the rest";
  }
  const fs::path folder = disk.path() / "run";
  {
    Child child({.folder = folder, .trials = 20000, .milliseconds = 1});
    EXPECT_EQ(child.Wait(), 3);  // what it says has no room either
    const std::vector<truth::Record> stored = ResultStore::Read(folder).Load();
    EXPECT_GT(stored.size(), 0U);
    const std::size_t count = stored.size();
    EXPECT_EQ(mount("tmpfs", disk.path().c_str(), "tmpfs", MS_REMOUNT, "size=16m"), 0);
    const auto trials = static_cast<std::int64_t>(std::max<std::size_t>(count, 500));
    EXPECT_EQ(HashAfterResume(folder, trials), FakeHash(static_cast<std::uint64_t>(trials)));
  }
  EXPECT_EQ(umount2(disk.path().c_str(), MNT_DETACH), 0);
}

}  // namespace
}  // namespace rockyard::batch
