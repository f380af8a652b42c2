// Stores that were changed behind the program's back: refused, or the same result.
#include <gmock/gmock.h>

#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "batch/campaign_differences.h"
#include "batch/merge_shards.h"
#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "batch/store_tables.h"
#include "batch/supervisor.h"
#include "core/hash.h"
#include "core/says.h"
#include "core/test_folder.h"
#include "fake_experiment.h"
#include "forged_store.h"
#include "scenario/load.h"
#include "scenario/shipped.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kTrials = 20;

CampaignIdentity TwoCells(std::uint64_t seed) {
  CampaignIdentity identity = FakeIdentity();
  identity.cells = {FakeCell(seed, "a"), FakeCell(seed + 1, "b")};
  for (CellIdentity& cell : identity.cells) {
    core::JsonValue resolved = core::ParseJson(cell.resolved, "fake");
    resolved.Set("seed", core::JsonValue(cell.seed));
    cell.resolved = core::DumpJson(resolved);
    cell.fingerprint = ResolvedFingerprint(resolved);
  }
  identity.settings = {"terrain.k=0.00415"};
  return identity;
}

// `shift` is added to every distance, as another build may do.
void Fill(ResultStore& store, double shift = 0.0) {
  std::vector<CellRecord> rows;
  for (int cell = 0; cell < store.cells(); ++cell) {
    const std::uint64_t seed = store.identity().cells[static_cast<std::size_t>(cell)].seed;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
      rows.push_back({cell, FakeRecord(seed, trial)});
      rows.back().record.values[0] += shift;
    }
  }
  store.Append(rows);
  store.AddInfrastructureFault({{1, 3}, "cpu_time_limit", "took 90 s"});
  store.AddInfrastructureFault({{0, 2}, "cpu_time_limit", "took 91 s"});
}

// All that any command reads.
void ReadAll(const fs::path& folder) {
  const ResultStore store = ResultStore::Read(folder);
  StoredEnds(store);
  store.Builds();
  store.InfrastructureFaults();
  for (int cell = 0; cell < store.cells(); ++cell) store.Load(cell);
}

std::optional<StoreError> ErrorOf(const fs::path& folder) {
  try {
    ReadAll(folder);
  } catch (const StoreError& error) {
    return error;
  }
  return std::nullopt;
}

class StoreDamage : public testing::Test {
 protected:
  StoreDamage() {
    ResultStore store = ResultStore::Create(folder_.path(), TwoCells(1), kTrials);
    Fill(store);
  }

  fs::path store() const { return StorePath(folder_.path()); }

  void Change(const std::string& sql) const {
    SqliteDatabase(store(), Access::kChange).Execute(sql);
  }

  template <typename Matcher>
  void ExpectRefused(const Matcher& message) const {
    const std::optional<StoreError> error = ErrorOf(folder_.path());
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->problem(), StoreProblem::kDamaged) << error->what();
    EXPECT_THAT(error->problems().front().path, store().string());
    EXPECT_THAT(error->problems().front().reason, message);
  }

  std::vector<std::string> Texts(const std::string& sql) const {
    const SqliteDatabase database(store(), Access::kRead);
    std::vector<std::string> texts;
    SqliteStatement select = database.Prepare(sql);
    while (select.Step()) texts.push_back(select.Text(0));
    return texts;
  }

  core::TestFolder folder_;
};

TEST_F(StoreDamage, IsReadBefore) { EXPECT_FALSE(ErrorOf(folder_.path()).has_value()); }

// Every column of every table, the checksums among them, in the first and in the last row.
TEST_F(StoreDamage, AChangedValueAnywhereIsRefused) {
  const fs::path whole = folder_.path() / "whole";
  fs::copy_file(store(), whole);
  int changed = 0;
  for (const std::string& table : Texts("SELECT name FROM sqlite_master WHERE type = 'table'")) {
    for (const std::string& name : Texts("SELECT name FROM pragma_table_info('" + table + "')")) {
      for (const char* end : {"min", "max"}) {
        fs::copy_file(whole, store(), fs::copy_options::overwrite_existing);
        const std::string column = QuotedName(name);
        Change("UPDATE " + table + " SET " + column + " = CASE typeof(" + column +
               ") WHEN 'text' THEN " + column + " || '1' WHEN 'null' THEN 1.5 ELSE " + column +
               " + 100 END WHERE rowid = (SELECT " + end + "(rowid) FROM " + table + ")");
        const std::optional<StoreError> error = ErrorOf(folder_.path());
        ASSERT_TRUE(error.has_value()) << table << "." << name << ", " << end;
        EXPECT_THAT(error->what(), HasSubstr("results.sqlite")) << table << "." << name;
        ++changed;
      }
    }
  }
  EXPECT_EQ(changed, 2 * (3 + 9 + 5 + 2 + 9 + 5 + 4));
}

TEST_F(StoreDamage, ARowTooFewIsRefused) {
  const fs::path whole = folder_.path() / "whole";
  fs::copy_file(store(), whole);
  for (const char* table :
       {"meta", "cells", "columns", "builds", "trials", "infrastructure_faults", "inventory"}) {
    fs::copy_file(whole, store(), fs::copy_options::overwrite_existing);
    const std::string rows = std::string(" FROM ") + table;
    Change("DELETE" + rows + " WHERE rowid = (SELECT max(rowid)" + rows + ")");
    SCOPED_TRACE(table);
    ExpectRefused(HasSubstr(table));
  }
}

// A trigger changes what --resume writes; a view computes what a report reads.
TEST_F(StoreDamage, WhatRunsInsideOfAStoreIsRefused) {
  const fs::path whole = folder_.path() / "whole";
  fs::copy_file(store(), whole);
  Change("CREATE TRIGGER t AFTER INSERT ON builds BEGIN DELETE FROM builds; END");
  ExpectRefused(HasSubstr("trigger t"));
  fs::copy_file(whole, store(), fs::copy_options::overwrite_existing);
  Change("ALTER TABLE trials RENAME TO others");
  Change("CREATE VIEW trials AS SELECT * FROM others");
  ExpectRefused(HasSubstr("view trials"));
  fs::copy_file(whole, store(), fs::copy_options::overwrite_existing);
  Change("CREATE VIRTUAL TABLE words USING fts5(word)");
  ExpectRefused(HasSubstr("table words"));
}

TEST_F(StoreDamage, NamesTableRowAndColumn) {
  Change("UPDATE trials SET sim_time_s = sim_time_s + 1 WHERE campaign_cell = 1 AND trial = 17");
  ExpectRefused(core::Says("table trials", "cell 1, trial 17", "column row_checksum"));
}

TEST_F(StoreDamage, NamesTheRowOfOtherTables) {
  Change("UPDATE cells SET name = 'c' WHERE cell = 1");
  ExpectRefused(core::Says("table cells, row 1", "column row_checksum"));
}

// Outcomes decide where a stopping rule ends: they are checked before anything runs.
TEST_F(StoreDamage, FinishedChecksOutcomes) {
  Change("UPDATE trials SET outcome = 'tip_over' WHERE campaign_cell = 0 AND trial = 3");
  const ResultStore store = ResultStore::Read(folder_.path());
  EXPECT_THROW(static_cast<void>(store.Finished()), StoreError);
  EXPECT_THROW(static_cast<void>(store.Load(0, truth::RecordSchema())), StoreError);
  EXPECT_NO_THROW(static_cast<void>(store.Load(1)));
}

// Load with some columns does not see them all.
TEST_F(StoreDamage, CheckSeesEveryValue) {
  Change("UPDATE trials SET sim_time_s = 1.0 WHERE campaign_cell = 0 AND trial = 3");
  const ResultStore store = ResultStore::Read(folder_.path());
  EXPECT_NO_THROW(static_cast<void>(store.Load(0, {FakeSchema()[0]})));
  EXPECT_THROW(store.Check(0), StoreError);
  EXPECT_NO_THROW(store.Check(1));
}

class ForeignRows : public StoreDamage {
 protected:
  // Puts trial 7 of another store into the place of this one's.
  void Swap(const CampaignIdentity& identity, double shift) {
    const fs::path other = folder_.path() / "other";
    fs::create_directories(other);
    {
      ResultStore store = ResultStore::Create(other, identity, kTrials);
      Fill(store, shift);
    }
    Change("ATTACH '" + StorePath(other).string() +
           "' AS other; DELETE FROM trials WHERE trial = 7; "
           "INSERT INTO trials SELECT * FROM other.trials WHERE trial = 7");
  }
};

TEST_F(ForeignRows, OfAnotherSeedAreRefused) {
  Swap(TwoCells(5), 0.0);
  ExpectRefused(core::Says("cell 0, trial 7", "outcome_checksum"));
}

TEST_F(ForeignRows, OfAnotherBuildAreRefused) {
  Swap(TwoCells(1), 1e-9);
  ExpectRefused(HasSubstr("table trials has other rows than those that were written"));
}

TEST_F(ForeignRows, ThatAreTheSameGiveTheSameResult) {
  Swap(TwoCells(1), 0.0);
  EXPECT_FALSE(ErrorOf(folder_.path()).has_value());
}

// Before trials are run that would be lost.
TEST_F(StoreDamage, ResumingChecksEveryValue) {
  const CampaignIdentity identity = TwoCells(1);
  ResultStore::Resume(folder_.path(), identity).SetPlanned(1, 30);
  ResultStore::Resume(folder_.path(), identity)
      .Append(std::vector<CellRecord>{{1, FakeRecord(2, 25)}});
  ResultStore::Resume(folder_.path(), identity).SetPlanned(1, kTrials);
  Change("UPDATE trials SET sim_time_s = 1.0 WHERE campaign_cell = 1 AND trial = 25");
  EXPECT_NO_THROW(ReadAll(folder_.path()));
  EXPECT_THROW(static_cast<void>(ResultStore::Resume(folder_.path(), identity)), StoreError);
}

// A run may be killed and resumed every other moment: it must not wait for the disk each time.
TEST_F(StoreDamage, ResumingTheSameBuildWritesNothing) {
  const auto content = [this] {
    std::ifstream file(store(), std::ios::binary);
    file.seekg(100);  // behind SQLite's own header, which counts openings
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string before = content();
  { const ResultStore store = ResultStore::Resume(folder_.path(), TwoCells(1)); }
  EXPECT_TRUE(content() == before);
}

TEST_F(StoreDamage, ResumingChecksWhatReportsNeedLater) {
  Change("UPDATE infrastructure_faults SET detail = 'another'");
  EXPECT_NO_THROW(ResultStore::RequireSame(folder_.path(), TwoCells(1), BuildPolicy::kSame));
  EXPECT_THROW(static_cast<void>(ResultStore::Resume(folder_.path(), TwoCells(1))), StoreError);
}

// By an index rows are found: those that a report reads, and those that a resumed run must not
// write once more.
TEST_F(StoreDamage, AnIndexThatDoesNotFindItsRowsIsRefused) {
  const fs::path whole = folder_.path() / "whole";
  fs::copy_file(store(), whole);
  struct Change {
    std::string table;
    int from_end;  // bytes of the first key that was written, at the end of its page
    char byte;
  };
  const std::vector<Change> changes = {
      {"meta", 4, '!'},      {"builds", 4, '!'},
      {"inventory", 4, '!'}, {"trials", 2, 9},  // SQLite's sign of 1, where 8 stands for trial 0
      {"trials", 3, 12},                        // and of no bytes, where 8 stands for cell 0
  };
  for (const Change& change : changes) {
    fs::copy_file(whole, store(), fs::copy_options::overwrite_existing);
    const std::string page = Texts(
                                 "SELECT rootpage FROM sqlite_master WHERE name = "
                                 "'sqlite_autoindex_" +
                                 change.table + "_1'")
                                 .front();
    {
      std::fstream file(store(), std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(std::stoll(page) * 4096 - change.from_end);
      file.put(change.byte);
    }
    const std::optional<StoreError> error = ErrorOf(folder_.path());
    ASSERT_TRUE(error.has_value()) << change.table;
    EXPECT_THAT(std::string(error->what()), HasSubstr("sqlite_autoindex_" + change.table + "_1"));
  }
}

TEST_F(StoreDamage, AStoreCannotPassForAnOlderOne) {
  Change("UPDATE meta SET value = '2' WHERE key = 'schema_version'");
  ASSERT_TRUE(ErrorOf(folder_.path()).has_value());
  EXPECT_EQ(ErrorOf(folder_.path())->problem(), StoreProblem::kMismatch);
  EXPECT_THAT(ErrorOf(folder_.path())->what(), HasSubstr("has version 2, not 3"));
}

// A stopping rule may end a cell before what an earlier one stored.
TEST_F(StoreDamage, TrialsThatWerePlannedOnceAreNoDamage) {
  {
    ResultStore store = ResultStore::Resume(folder_.path(), TwoCells(1));
    store.SetRule(StoppingRule{.half_width = 0.2, .max_trials = 5, .block = 5});
    store.SetPlanned(0, 5);
  }
  const ResultStore store = ResultStore::Read(folder_.path());
  EXPECT_EQ(store.Finished().size(), 2U * kTrials);
  EXPECT_EQ(store.Load(0).size(), 5U);
  EXPECT_EQ(StoredEnds(store)[0].asked, 5);
}

TEST_F(StoreDamage, EverythingThatWritesKeepsTheStoreWhole) {
  {
    CampaignIdentity other = TwoCells(1);
    other.build = "0.2.0 def";
    ResultStore store = ResultStore::Resume(folder_.path(), other, BuildPolicy::kAny);
    store.SetPlanned(1, 30);
    store.SetPlanned(0, 10);
    store.SetRule(StoppingRule{.half_width = 0.2, .max_trials = 30, .block = 5});
    store.SetRule(std::nullopt);
    // One that is there, and one that is not.
    store.Append(std::vector<CellRecord>{{1, FakeRecord(9, 4)}, {1, FakeRecord(2, 29)}});
    store.AddBuild("0.2.0 def");
  }
  EXPECT_FALSE(ErrorOf(folder_.path()).has_value());
  const ResultStore store = ResultStore::Read(folder_.path());
  EXPECT_EQ(store.Builds().size(), 2U);
  EXPECT_EQ(store.Finished().size(), 2U * kTrials + 1);
}

// What a run writes meanwhile is no damage.
TEST_F(StoreDamage, AStoreThatIsWrittenIsReadWhole) {
  ResultStore writer = ResultStore::Resume(folder_.path(), TwoCells(1));
  writer.SetPlanned(0, 400);
  std::thread thread([&] {
    for (std::uint64_t trial = kTrials; trial < 400; ++trial) {
      writer.Append(std::vector<CellRecord>{{0, FakeRecord(1, trial)}});
      writer.AddInfrastructureFault({{0, 1}, "kind", "detail"});
    }
  });
  const ResultStore reader = ResultStore::Read(folder_.path());
  std::size_t finished = 0;
  EXPECT_NO_THROW(while (finished < 400 + kTrials) {
    finished = reader.Finished().size();
    reader.InfrastructureFaults();
  });
  thread.join();
}

// What no checksum speaks against.
class ForgedStore : public StoreDamage {};

TEST_F(ForgedStore, WhatNoTrialGivesIsRefused) {
  const fs::path whole = folder_.path() / "whole";
  fs::copy_file(store(), whole);
  const auto refused = [&](const char* sql, const auto& message) {
    fs::copy_file(whole, store(), fs::copy_options::overwrite_existing);
    Forge(store(), sql);
    SCOPED_TRACE(sql);
    ExpectRefused(message);
  };
  refused("UPDATE trials SET sim_time_s = 9e999 WHERE trial = 17",
          core::Says("trial 17", "sim_time_s", "infinite"));
  refused("UPDATE trials SET sim_time_s = -9e999 WHERE trial = 17", HasSubstr("infinite"));
  refused("UPDATE trials SET trial = 4000000000 WHERE trial = 17 AND campaign_cell = 1",
          core::Says("cell 1, trial 4000000000", "at most 20"));
  refused("UPDATE trials SET trial = 9000000000000000000 WHERE trial = 17 AND campaign_cell = 1",
          HasSubstr("trial 9000000000000000000"));
  refused("UPDATE trials SET trial = 20 WHERE trial = 17", HasSubstr("trial 20"));
  refused("UPDATE trials SET campaign_cell = 2 WHERE trial = 17 AND campaign_cell = 1",
          HasSubstr("cell 2, trial 17"));
  refused("UPDATE infrastructure_faults SET cell = 2", HasSubstr("trial 3 of cell 2"));
  refused("UPDATE infrastructure_faults SET trial = -1", HasSubstr("infrastructure_faults"));
  refused("UPDATE cells SET planned = 4000000000", HasSubstr("planned"));
  refused("UPDATE cells SET seed = '7' WHERE cell = 1",
          core::Says("table cells, row 1", "column seed"));
  refused("UPDATE cells SET scenario = 'other'", HasSubstr("column scenario"));
  refused("UPDATE cells SET resolved = replace(resolved, '0.00415', '0.013')",
          core::Says("table cells, row 0", "column fingerprint"));
  refused("UPDATE cells SET resolved = 'none'", HasSubstr("column fingerprint"));
  refused("UPDATE cells SET name = 'a'", core::Says("table cells", "\"a\" twice"));
  refused("DELETE FROM columns WHERE position = 2", HasSubstr("table columns"));
  refused("UPDATE meta SET value = 'sudden' WHERE key = 'rule'", HasSubstr("rule_half_width"));
  refused("UPDATE meta SET value = '7' WHERE key = 'design'", HasSubstr("design"));
  refused("UPDATE meta SET value = '{' WHERE key = 'design'", HasSubstr("design"));
  refused("UPDATE meta SET value = '0' WHERE key = 'shard_index'", HasSubstr("shard 0 of 1"));
  refused("UPDATE meta SET value = '2' WHERE key = 'shard_index'", HasSubstr("shard 2 of 1"));
}

TEST_F(ForgedStore, AnImpossibleStoppingRuleIsRefused) {
  {
    ResultStore store = ResultStore::Resume(folder_.path(), TwoCells(1));
    store.SetRule(StoppingRule{.half_width = 0.2, .max_trials = 30, .block = 5});
  }
  EXPECT_FALSE(ErrorOf(folder_.path()).has_value());
  const fs::path whole = folder_.path() / "whole";
  fs::copy_file(store(), whole);
  for (const char* change :
       {"'0.5' WHERE key = 'rule_half_width'", "'4000000000' WHERE key = 'rule_max_trials'",
        "'0' WHERE key = 'rule_block'", "'1' WHERE key = 'rule_confidence'",
        "'sudden' WHERE key = 'rule'", "'2' WHERE key = 'shard_count'"}) {
    fs::copy_file(whole, store(), fs::copy_options::overwrite_existing);
    Forge(store(), std::string("UPDATE meta SET value = ") + change);
    SCOPED_TRACE(change);
    ExpectRefused(HasSubstr("rule"));
  }
}

TEST_F(StoreDamage, AShardHoldsItsOwnTrialsAlone) {
  const fs::path shard = folder_.path() / "shard";
  fs::create_directories(shard);
  CampaignIdentity identity = TwoCells(1);
  identity.shard = {1, 2};
  {
    ResultStore store = ResultStore::Create(shard, identity, kTrials);
    store.Append(std::vector<CellRecord>{{0, FakeRecord(1, 4)}});
  }
  Forge(StorePath(shard), "UPDATE trials SET trial = 5");
  const std::optional<StoreError> error = ErrorOf(shard);
  ASSERT_TRUE(error.has_value());
  EXPECT_THAT(error->what(), HasSubstr("none of shard 1/2"));
}

// Also where shards may be missing.
TEST_F(StoreDamage, AMergeRefusesAShardThatIsNotWhole) {
  const fs::path shard = folder_.path() / "shard";
  fs::create_directories(shard);
  CampaignIdentity identity = TwoCells(1);
  identity.shard = {1, 2};
  {
    ResultStore store = ResultStore::Create(shard, identity, kTrials);
    store.Append(std::vector<CellRecord>{{0, FakeRecord(1, 4)}, {0, FakeRecord(1, 6)}});
  }
  SqliteDatabase(StorePath(shard), Access::kChange).Execute("DELETE FROM trials WHERE trial = 6");
  const fs::path out = folder_.path() / "out";
  EXPECT_THROW(MergeShards(std::vector{shard}, out, {.partial = true}), StoreError);
  EXPECT_FALSE(fs::exists(out));
}

TEST(ResolvedFingerprint, IsThatOfTheScenario) {
  for (const char* name :
       {"pathfinder/nominal", "hazard_detection/detection", "mars/mfex_vl2", "gestalt/waypoints"}) {
    const scenario::Scenario scenario = scenario::Shipped(name);
    EXPECT_EQ(ResolvedFingerprint(core::ParseJson(scenario::ResolvedJson(scenario), name)),
              core::Hex(scenario::Fingerprint(scenario)))
        << name;
  }
}

}  // namespace
}  // namespace rockyard::batch
