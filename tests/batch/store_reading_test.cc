// Who may read a store, in which state, and what reading leaves behind.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <optional>

#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "batch/trial_hash.h"
#include "core/files.h"
#include "core/test_folder.h"
#include "core/wait_until.h"
#include "fake_experiment.h"
#include "unprivileged.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr int kTrials = 40;

std::vector<std::string> NamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

std::string ReadFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string HashIn(const fs::path& folder) { return TrialHash(ResultStore::Read(folder).Load()); }

std::string PlainHash() { return FakeHash(kTrials); }

// Leaves a store as one that was killed.
template <typename Act>
void InKilledProcess(Act act) {
  const pid_t child = fork();
  if (child == 0) {
    act();
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
}

// A process of its own: a connection that a reader inherits would not be one of somebody else.
class Writer {
 public:
  explicit Writer(const std::function<void()>& work) : process_(fork()) {
    if (process_ != 0) return;
    work();
    _exit(0);
  }
  ~Writer() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

 private:
  pid_t process_;
};

class StoreReading : public testing::Test {
 protected:
  bool WaitForTrials(std::size_t count) const {
    return core::WaitUntil(
        [&] { return HoldsStore(path()) && ResultStore::Read(path()).Finished().size() >= count; });
  }

  // In two commits.
  static void Write(ResultStore& store) {
    AppendRecords(store, FakeRecords(0, kTrials / 2));
    AppendRecords(store, FakeRecords(kTrials / 2, kTrials));
  }

  void WriteCleanly() const {
    ResultStore store = ResultStore::Create(path(), FakeIdentity(), kTrials);
    Write(store);
  }

  void WriteAndDie() const {
    InKilledProcess([&] {
      ResultStore store = ResultStore::Create(path(), FakeIdentity(), kTrials);
      Write(store);
      raise(SIGKILL);  // the store is still open
    });
  }

  // As nobody, who finds the names that are there and leaves them as they are.
  void ExpectReadableByNobody() const {
    const std::vector<std::string> before = NamesIn(path());
    const WriteProtected folder(path());
    EXPECT_EQ(AsNobody([&] { return HashIn(path()); }), PlainHash());
    EXPECT_EQ(NamesIn(path()), before);
  }

  fs::path path() const { return folder_.path(); }

  core::TestFolder folder_;
};

TEST_F(StoreReading, ACleanEndLeavesOneFile) {
  WriteCleanly();
  EXPECT_THAT(NamesIn(path()), ElementsAre("results.sqlite"));
  // The format's version for readers: 1 where there is no write-ahead log.
  EXPECT_EQ(ReadFile(StorePath(path())).at(19), '\1');
  EXPECT_EQ(HashIn(path()), PlainHash());
  EXPECT_THAT(NamesIn(path()), ElementsAre("results.sqlite")) << "readers leave nothing";
  ExpectReadableByNobody();
}

TEST_F(StoreReading, ACleanEndOfAResumedRunLeavesOneFile) {
  WriteAndDie();
  EXPECT_THAT(NamesIn(path()), testing::Contains("results.sqlite-wal"));
  ResultStore::Resume(path(), FakeIdentity());
  EXPECT_THAT(NamesIn(path()), ElementsAre("results.sqlite"));
  EXPECT_EQ(HashIn(path()), PlainHash());
}

// All trials are in the log alone.
TEST_F(StoreReading, NobodyReadsAKilledRunWithItsLog) {
  WriteAndDie();
  ASSERT_TRUE(fs::exists(path() / "results.sqlite-wal"));
  ExpectReadableByNobody();
  fs::remove(path() / "results.sqlite-shm");
  ExpectReadableByNobody();
}

TEST_F(StoreReading, AKilledRunWithoutSharedMemoryGetsNone) {
  WriteAndDie();
  fs::remove(path() / "results.sqlite-shm");
  EXPECT_EQ(HashIn(path()), PlainHash());
  EXPECT_THAT(NamesIn(path()), UnorderedElementsAre("results.sqlite", "results.sqlite-wal"));
}

// As earlier versions of the program left them after a clean end.
TEST_F(StoreReading, AStoreThatNamesALogAndHasNone) {
  WriteAndDie();
  const fs::path store = StorePath(path());
  const fs::path copy = path() / "copy";
  InKilledProcess([&] {
    SqliteDatabase database(store, Access::kChange);
    database.Execute("PRAGMA wal_checkpoint(TRUNCATE)");
    fs::copy(store, copy);
    raise(SIGKILL);
  });
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(store.string() + suffix);
  fs::rename(copy, store);
  EXPECT_EQ(HashIn(path()), PlainHash());
  EXPECT_THAT(NamesIn(path()), ElementsAre("results.sqlite"));
  ExpectReadableByNobody();
}

// A rollback journal is hot after a kill while the kind of log was changed, or of another tool.
TEST_F(StoreReading, NobodyReadsWithAHotJournal) {
  constexpr int kMany = 3000;  // more pages than are kept in memory
  {
    ResultStore store = ResultStore::Create(path(), FakeIdentity(), kMany);
    AppendRecords(store, FakeRecords(0, kMany));
  }
  const std::string clean = ReadFile(StorePath(path()));
  InKilledProcess([&] {
    SqliteDatabase database(StorePath(path()), Access::kChange);
    // So that half of a change is in the file already, and the other half is not.
    database.Execute("PRAGMA cache_size=1");
    database.Execute("BEGIN");
    database.Execute("UPDATE trials SET outcome = 'jammed'");
    raise(SIGKILL);
  });
  ASSERT_TRUE(fs::exists(path() / "results.sqlite-journal"));
  ASSERT_NE(ReadFile(StorePath(path())), clean);
  const WriteProtected folder(path());
  EXPECT_EQ(AsNobody([&] { return HashIn(path()); }), TrialHash(FakeRecords(0, kMany)));
}

TEST_F(StoreReading, NobodyReadsWhileARunWrites) {
  const Writer writer([&] {
    ResultStore store = ResultStore::Create(path(), FakeIdentity(), kTrials);
    Write(store);
    pause();
  });
  ASSERT_TRUE(WaitForTrials(kTrials));
  ExpectReadableByNobody();
}

TEST_F(StoreReading, ThroughALinkWithTheLogOfTheFile) {
  WriteAndDie();
  const core::TestFolder other;
  fs::create_symlink(StorePath(path()), StorePath(other.path()));
  EXPECT_EQ(HashIn(other.path()), PlainHash());
}

// Copies taken in the middle of commits are those of one commit or of the next.
TEST_F(StoreReading, NobodyAlwaysReadsACommitOfARunThatGoesOn) {
  const Writer writer([&] {
    ResultStore store = ResultStore::Create(path(), FakeIdentity(), 30000);
    for (std::uint64_t i = 0; i < 30000; i += 3) AppendRecords(store, FakeRecords(i, i + 3));
    pause();
  });
  ASSERT_TRUE(WaitForTrials(1));
  fs::permissions(path(), static_cast<fs::perms>(0555));
  for (int reading = 0; reading < 10; ++reading) {
    const std::string told = AsNobody([&]() -> std::string {
      const std::vector<truth::Record> records = ResultStore::Read(path()).Load();
      const bool same = TrialHash(records) == TrialHash(FakeRecords(0, records.size()));
      return same && records.size() % 3 == 0 ? "a commit" : "something else";
    });
    EXPECT_EQ(told, "a commit");
  }
  fs::permissions(path(), static_cast<fs::perms>(0755));
}

TEST_F(StoreReading, LeavesNothingInTheTemporaryFolder) {
  WriteAndDie();
  fs::remove(path() / "results.sqlite-shm");
  const core::TestFolder temporary;
  setenv("TMPDIR", temporary.path().c_str(), 1);
  const ResultStore store = ResultStore::Read(path());
  unsetenv("TMPDIR");
  EXPECT_TRUE(fs::is_empty(temporary.path())) << "also while it is open";
  EXPECT_EQ(TrialHash(store.Load()), PlainHash());
}

// What a reader left that was killed while it copied; never the copy of one that lives.
TEST_F(StoreReading, RemovesTheCopyOfAKilledReader) {
  WriteAndDie();
  fs::remove(path() / "results.sqlite-shm");
  const core::TestFolder temporary;
  setenv("TMPDIR", temporary.path().c_str(), 1);
  InKilledProcess([&] {
    const core::TemporaryFolder folder(temporary.path() / "rockyard-read", 0700);
    std::ofstream(folder.path() / "store") << "half";
    raise(SIGKILL);
  });
  EXPECT_FALSE(fs::is_empty(temporary.path()));
  const core::TemporaryFolder living(temporary.path() / "rockyard-read", 0700);
  EXPECT_EQ(HashIn(path()), PlainHash());
  unsetenv("TMPDIR");
  EXPECT_THAT(NamesIn(temporary.path()), ElementsAre(living.path().filename().string()));
}

TEST_F(StoreReading, WhoHasNoRoomForACopyIsToldSo) {
  WriteAndDie();
  fs::remove(path() / "results.sqlite-shm");
  std::optional<StoreProblem> problem;
  // A limit on the size of files stands in for a full disk.
  rlimit former{};
  getrlimit(RLIMIT_FSIZE, &former);
  const rlimit small{8192, former.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  try {
    ResultStore::Read(path());
  } catch (const StoreError& error) {
    problem = error.problem();
    EXPECT_THAT(error.what(), HasSubstr("TMPDIR"));
  }
  setrlimit(RLIMIT_FSIZE, &former);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(problem, StoreProblem::kFull);
}

TEST_F(StoreReading, WhoMayNotReadIsToldSo) {
  WriteCleanly();
  fs::permissions(StorePath(path()), fs::perms::none);
  EXPECT_THAT(AsNobody([&] { return HashIn(path()); }), HasSubstr("cannot be opened"));
}

TEST_F(StoreReading, WhoMayNotEnterTheFolderIsToldSo) {
  WriteCleanly();
  const fs::perms former = fs::status(path()).permissions();
  fs::permissions(path(), fs::perms::none);
  const std::string of_reading = AsNobody([&] { return HashIn(path()); });
  const std::string of_finding = AsNobody([&] { return FindRuns(path()).front().string(); });
  fs::permissions(path(), former);
  EXPECT_THAT(of_reading, HasSubstr("cannot be opened: Permission"));
  EXPECT_THAT(of_finding, HasSubstr("cannot be read: Permission"));
}

TEST_F(StoreReading, TooManyOpenFilesHaveWordsOfTheirOwn) {
  WriteCleanly();
  rlimit former{};
  getrlimit(RLIMIT_NOFILE, &former);
  const int highest = open("/dev/null", O_RDONLY | O_CLOEXEC);
  close(highest);
  const rlimit small{static_cast<rlim_t>(highest), former.rlim_max};
  setrlimit(RLIMIT_NOFILE, &small);
  std::vector<StoreProblem> problems;
  std::string text;
  for (const std::function<void()>& use :
       {std::function<void()>([&] { ResultStore::Read(path()); }),
        std::function<void()>([&] { const FolderClaim claim(path()); })}) {
    try {
      use();
    } catch (const StoreError& error) {
      problems.push_back(error.problem());
      text += error.what();
    }
  }
  setrlimit(RLIMIT_NOFILE, &former);
  EXPECT_THAT(problems, ElementsAre(StoreProblem::kOpenFiles, StoreProblem::kOpenFiles));
  EXPECT_THAT(text, HasSubstr("ulimit -n"));
}

}  // namespace
}  // namespace rockyard::batch
