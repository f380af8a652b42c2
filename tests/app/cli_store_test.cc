// What commands say of stores that were changed, or that could not tell.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "app/command.h"
#include "batch/older_store.h"
#include "batch/sqlite_database.h"

namespace rockyard::app {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kNoChecksums =
    "run/results.sqlite: an older program made it, without checksums: damage may pass unseen";

class CliStore : public CommandTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(Run(With(QuickRun("run", 3), {"--quiet"})).exit_code, 0);
    ASSERT_EQ(Run(With(QuickRun("other", 3), {"--quiet"})).exit_code, 0);
  }

  std::filesystem::path store() const { return work() / "run" / "results.sqlite"; }

  // Those that read the values of a run.
  std::vector<std::vector<std::string>> Readers() const {
    return {{"report", "run", "--data", "data.json", "--replays", "0"},
            {"compare", "run", "other"},
            {"compare", "other", "run"},
            {"check", "run", "--against",
             std::string(ROCKYARD_SOURCE_DIR) + "/results/reference/matthies1995.json",
             "--replicates", "100"},
            {"baseline", "run", "--reason", "test", "--out", "b.json"},
            {"replay", "run", "--trial", "1", "--list"},
            {"trace", "run", "--trial", "1"},
            With(QuickRun("run", 3), {"--resume"})};
  }
};

TEST_F(CliStore, OfAnOlderProgramIsReadWithALineThatSaysSo) {
  for (const std::vector<std::string>& command : Readers()) {
    EXPECT_THAT(Run(command).err, Not(HasSubstr("checksums"))) << command.front();
  }
  batch::MakeOlder(store());
  for (const std::vector<std::string>& command : Readers()) {
    const CommandResult result = Run(command);
    EXPECT_THAT(result.exit_code, testing::AnyOf(0, 1)) << command.front() << result.err;
    const std::size_t line = result.err.find(kNoChecksums);
    ASSERT_NE(line, std::string::npos) << command.front() << result.err;
    EXPECT_EQ(result.err.find(kNoChecksums, line + 1), std::string::npos) << command.front();
  }
}

TEST_F(CliStore, OfAShardOfAnOlderProgramIsMergedWithALineThatSaysSo) {
  ASSERT_EQ(Run(With(QuickRun("shard", 3), {"--quiet", "--shard", "1/2"})).exit_code, 0);
  batch::MakeOlder(work() / "shard" / "results.sqlite");
  const std::vector<std::string> merge = {"merge", "shard", "--partial", "--out"};
  EXPECT_THAT(Run(With(merge, {"a", "--quiet"})).err, IsEmpty());
  EXPECT_THAT(Run(With(merge, {"b"})).err, HasSubstr("shard/results.sqlite: an older program"));
}

TEST_F(CliStore, WithAChangedValueIsRefusedByEveryCommand) {
  batch::SqliteDatabase(store(), batch::Access::kChange)
      .Execute("UPDATE trials SET sim_time_s = 2.0 WHERE trial = 1");
  for (const std::vector<std::string>& command : Readers()) {
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
