// A store that another program keeps locked: every statement waits for it, which takes most of a
// minute.
#include <gmock/gmock.h>

#include <set>

#include "app/watched_run.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"

namespace rockyard::app {
namespace {

using batch::ResultStore;
using testing::HasSubstr;

class CliFaultLong : public WatchedRunTest {
 protected:
  CliFaultLong() : WatchedRunTest(2) {}
};

TEST_F(CliFaultLong, StoreThatStaysLockedEndsTheRun) {
  const pid_t process = Start(Drives("a", 100000));
  ASSERT_TRUE(WaitForTrials("a", 10));
  {
    batch::SqliteDatabase other(batch::StorePath(work() / "a"), batch::Access::kChange);
    other.Execute("BEGIN IMMEDIATE");
    const CommandResult result = Wait(process);
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_THAT(result.err, HasSubstr("results.sqlite: is locked by another program"));
    EXPECT_THAT(result.err, HasSubstr("could not be stored"));
    EXPECT_THAT(result.err, HasSubstr("--resume"));
  }
  const auto trials = static_cast<int>(Stored("a")) + 20;
  EXPECT_GE(trials, 30);
  EXPECT_EQ(Run(Drives("b", trials)).exit_code, 0);
  const std::vector<truth::Record> all = ResultStore::Read(work() / "b").Load();
  std::set<std::uint64_t> seen;
  for (const truth::Record& record : ResultStore::Read(work() / "a").Load()) {
    if (record.trial >= all.size()) continue;
    EXPECT_EQ(batch::TrialHash({&record, 1}), batch::TrialHash({&all[record.trial], 1}));
    EXPECT_TRUE(seen.insert(record.trial).second);
  }
}

}  // namespace
}  // namespace rockyard::app
