#include "batch/result_store.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

#include "batch/executor.h"
#include "batch/sqlite_database.h"
#include "batch/store_rows.h"
#include "batch/trial_hash.h"
#include "core/test_folder.h"
#include "fake_experiment.h"

namespace rockyard::batch {
namespace {

using truth::Record;
using truth::TrialOutcome;

std::uint64_t Bits(double value) { return std::bit_cast<std::uint64_t>(value); }

TEST(ResultStore, KeepsEveryBitOfDoubles) {
  const core::TestFolder folder;
  const double values[] = {0.1,
                           -0.0,
                           0.0,
                           3.0,
                           -7.0,
                           1e300,
                           std::numeric_limits<double>::denorm_min(),
                           std::numeric_limits<double>::max(),
                           -std::numeric_limits<double>::max(),
                           std::nextafter(-1.0, 0.0),
                           9007199254740993.0,
                           std::nextafter(1.0, 2.0)};
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 12);
  std::vector<Record> records;
  for (const double value : values) {
    records.push_back({records.size(), TrialOutcome::kJammed, "", {value, value, value}});
  }
  AppendRecords(store, records);
  const std::vector<Record> loaded = ResultStore::Read(folder.path()).Load();
  ASSERT_EQ(loaded.size(), records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (const double value : loaded[i].values) EXPECT_EQ(Bits(value), Bits(values[i])) << i;
  }
  EXPECT_EQ(TrialHash(loaded), TrialHash(records));
}

TEST(ResultStore, KeepsNanTextsFaultsAndOrder) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 5);
  const std::string detail = "quote ' and \" and\nline, \xc3\xa4, DROP TABLE trials;--";
  AppendRecords(store, {
                           {4, TrialOutcome::kTipOver, detail, {1.0, std::nan(""), 2.0}},
                           {0, TrialOutcome::kSimulatorFault, "blew up", {}},
                       });
  const std::vector<Record> loaded = store.Load();
  ASSERT_EQ(loaded.size(), 2U);
  EXPECT_EQ(loaded[0].trial, 0U);
  EXPECT_EQ(loaded[0].outcome, TrialOutcome::kSimulatorFault);
  EXPECT_TRUE(loaded[0].values.empty());
  EXPECT_EQ(loaded[1].trial, 4U);
  EXPECT_EQ(loaded[1].detail, detail);
  EXPECT_TRUE(std::isnan(loaded[1].values[1]));
  EXPECT_EQ(loaded[1].values[2], 2.0);
}

TEST(ResultStore, SetsFaultsAsideAndNothingElse) {
  const core::TestFolder folder;
  {
    ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 5);
    AppendRecords(store, {{0, TrialOutcome::kSimulatorFault, "blew up", {}},
                          FakeRecord(1, 1),
                          {3, TrialOutcome::kSimulatorFault, "", {}}});
  }
  ResultStore store = ResultStore::Resume(folder.path(), FakeIdentity());
  EXPECT_EQ(store.RetryFaults(), 2);
  EXPECT_EQ(store.RetryFaults(), 0);
  const ResultStore read = ResultStore::Resume(folder.path(), FakeIdentity());  // checks all of it
  ASSERT_EQ(read.Finished().size(), 1U);
  EXPECT_EQ(TrialHash(read.Load()), TrialHash(std::vector{FakeRecord(1, 1)}));
  const std::vector<InfrastructureFault> faults = read.InfrastructureFaults();
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].id, (TrialId{0, 0}));
  EXPECT_EQ(faults[0].kind, "simulator_fault");
  EXPECT_EQ(faults[0].detail, "blew up");
  EXPECT_EQ(faults[1].id, (TrialId{0, 3}));
}

TEST(ResultStore, KeepsIdentityAndPlan) {
  const core::TestFolder folder;
  const CampaignIdentity identity = FakeIdentity(18446744073709551615ULL);
  ResultStore store = ResultStore::Create(folder.path(), identity, 7);
  store.SetPlanned(0, 9);
  const ResultStore read = ResultStore::Read(folder.path());
  EXPECT_EQ(read.planned(), 9);
  EXPECT_EQ(read.identity().name, identity.name);
  ASSERT_EQ(read.cells(), 1);
  const CellIdentity& cell = read.identity().cells[0];
  EXPECT_EQ(cell.scenario, identity.cells[0].scenario);
  EXPECT_EQ(cell.fingerprint, identity.cells[0].fingerprint);
  EXPECT_EQ(cell.resolved, identity.cells[0].resolved);
  EXPECT_EQ(cell.seed, identity.cells[0].seed);
  EXPECT_EQ(read.identity().build, identity.build);
  ASSERT_EQ(read.identity().schema.size(), identity.schema.size());
  EXPECT_EQ(read.identity().schema[2].name, "odd \"name\"");
  EXPECT_TRUE(read.Finished().empty());
}

TEST(ResultStore, KeepsWhatTheScenarioWasChangedBy) {
  const core::TestFolder folder;
  CampaignIdentity identity = FakeIdentity();
  identity.settings = {"name=\"two\nlines\"", "--ablate sight"};
  { const ResultStore store = ResultStore::Create(folder.path(), identity, 3); }
  EXPECT_EQ(ResultStore::Read(folder.path()).identity().settings, identity.settings);
  // They decide no record: the same scenario by another way goes on.
  EXPECT_NO_THROW(ResultStore::RequireSame(folder.path(), FakeIdentity(), BuildPolicy::kSame));
  const core::TestFolder older;
  { const ResultStore store = ResultStore::Create(older.path(), FakeIdentity(), 3); }
  EXPECT_EQ(ResultStore::Read(older.path()).identity().settings, std::nullopt);
}

TEST(ResultStore, KeepsTheFirstRecordOfATrial) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 3);
  AppendRecords(store, {{1, TrialOutcome::kJammed, "first", {1.0, 1.0, 1.0}}});
  AppendRecords(store, {{1, TrialOutcome::kNoPath, "second", {2.0, 2.0, 2.0}}});
  ASSERT_EQ(store.Load().size(), 1U);
  EXPECT_EQ(store.Load()[0].detail, "first");
  EXPECT_EQ(store.Finished().back().id.trial, 1);
}

TEST(ResultStore, CanBeReadWhileItIsWritten) {
  const core::TestFolder folder;
  ResultStore writer = ResultStore::Create(folder.path(), FakeIdentity(), 3);
  const ResultStore reader = ResultStore::Read(folder.path());
  EXPECT_TRUE(reader.Load().empty());
  AppendRecords(writer, std::vector<Record>{FakeRecord(1, 0)});
  EXPECT_EQ(reader.Load().size(), 1U);
}

TEST(ResultStore, TakesOddFolderNames) {
  const core::TestFolder folder;
  const auto odd = folder.path() / "a b?c#d%20'e";
  std::filesystem::create_directories(odd);
  ResultStore store = ResultStore::Create(odd, FakeIdentity(), 1);
  AppendRecords(store, {FakeRecord(1, 0)});
  EXPECT_TRUE(std::filesystem::exists(odd / "results.sqlite"));
  EXPECT_EQ(ResultStore::Read(odd).Load().size(), 1U);
}

TEST(ContiguousPrefix, EndsAtTheFirstMissingTrial) {
  const std::vector<Record> records = {FakeRecord(1, 0), FakeRecord(1, 1), FakeRecord(1, 3)};
  EXPECT_EQ(ContiguousPrefix(records).size(), 2U);
  EXPECT_TRUE(ContiguousPrefix(std::span(records).subspan(2)).empty());
}

TEST(TrialHash, SeesEveryNumberAndNoSentence) {
  std::vector<Record> records = {FakeRecord(1, 0), FakeRecord(1, 1)};
  const std::string hash = TrialHash(records);
  records[0].detail = "told otherwise";
  EXPECT_EQ(TrialHash(records), hash);
  records[1].values[2] = 0.0;  // was -0.0
  EXPECT_NE(TrialHash(records), hash);
  records[1].values[2] = -0.0;
  EXPECT_EQ(TrialHash(records), hash);
  records[0].outcome = TrialOutcome::kJammed;
  EXPECT_NE(TrialHash(records), hash);
  EXPECT_NE(TrialHash(std::span(records).first(1)), hash);
}

// Of zlib.crc32(b"I" + pack("<q", 7) + b"R" + pack("<d", -0.0) + b"N" + b"T" + pack("<Q", 6) +
// "rock ä".encode()) in Python.
TEST(RowChecksum, IsTheCrc32OfTypesAndBytes) {
  RowChecksum checksum;
  checksum.Integer(7).Real(-0.0).Null().Text("rock \xc3\xa4");
  EXPECT_EQ(checksum.value(), 3763823285);
}

TEST(RowChecksum, GoesOnFromWhatCameBefore) {
  RowChecksum whole;
  whole.Integer(1).Text("a").Real(2.5);
  RowChecksum piecewise;
  piecewise.Integer(1);
  const std::int64_t first = piecewise.value();
  EXPECT_EQ(piecewise.Text("a").Real(2.5).value(), whole.value());
  piecewise.Restart(first);
  EXPECT_EQ(piecewise.Text("a").Real(2.5).value(), whole.value());
  piecewise.Restart();
  EXPECT_NE(piecewise.Text("a").Real(2.5).value(), whole.value());
}

TEST(RowChecksum, TellsTypesSignsAndLimitsOfTextsApart) {
  const auto sum = [](auto fill) {
    RowChecksum checksum;
    fill(checksum);
    return checksum.value();
  };
  EXPECT_NE(sum([](auto& c) { c.Integer(0); }), sum([](auto& c) { c.Real(0.0); }));
  EXPECT_NE(sum([](auto& c) { c.Real(0.0); }), sum([](auto& c) { c.Real(-0.0); }));
  EXPECT_NE(sum([](auto& c) { c.Real(1.0); }),
            sum([](auto& c) { c.Real(std::nextafter(1.0, 2.0)); }));
  EXPECT_NE(sum([](auto& c) { c.Text("ab").Text("c"); }),
            sum([](auto& c) { c.Text("a").Text("bc"); }));
  EXPECT_NE(sum([](auto& c) { c.Text(""); }), sum([](auto& c) { c.Null(); }));
  // SQLite keeps NaN as NULL.
  EXPECT_EQ(sum([](auto& c) { c.Real(std::numeric_limits<double>::quiet_NaN()); }),
            sum([](auto& c) { c.Null(); }));
}

TEST(RowChecksum, OfARowIsThatOfItsValues) {
  const core::TestFolder folder;
  const SqliteDatabase database(folder.path() / "a.sqlite", Access::kCreate);
  SqliteStatement row = database.Prepare("SELECT 7, -0.5, NULL, 'rock', 'not counted'");
  ASSERT_TRUE(row.Step());
  RowChecksum values;
  values.Integer(7).Real(-0.5).Null().Text("rock");
  RowChecksum columns;
  EXPECT_EQ(columns.Columns(row, 4).value(), values.value());
}

// Holds the writing thread after its next tick.
class Gate {
 public:
  void Wait() {
    std::unique_lock lock(mutex_);
    held_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
  }
  void WaitUntilHeld() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return held_; });
  }
  void Open() {
    {
      const std::lock_guard lock(mutex_);
      open_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool held_ = false;
  bool open_ = false;
};

class RecordWriterTest : public testing::Test {
 protected:
  static constexpr auto kMax = static_cast<std::int64_t>(RecordWriter::kMaxWaiting);

  core::TestFolder folder_;
  ResultStore store_ = ResultStore::Create(folder_.path(), FakeIdentity(), 4 * kMax);
  Gate gate_;
};

// Trials that are faster than the store wait for it, so that memory stays bounded.
TEST_F(RecordWriterTest, FullQueueHoldsThoseWhoPush) {
  RecordWriter writer(store_, std::chrono::milliseconds(1), [this] { gate_.Wait(); });
  writer.Start();
  gate_.WaitUntilHeld();
  std::atomic<std::int64_t> pushed = 0;
  std::thread pusher([&] {
    for (std::int64_t trial = 0; trial < kMax + 50; ++trial) {
      writer.Push({0, FakeRecord(1, static_cast<std::uint64_t>(trial))});
      ++pushed;
    }
  });
  while (pushed < kMax) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(pushed, kMax);
  gate_.Open();
  pusher.join();
  writer.Close();
  EXPECT_EQ(writer.stored(), kMax + 50);
  EXPECT_EQ(store_.Finished().size(), static_cast<std::size_t>(kMax) + 50);
}

// A full queue is written at once, not when the interval is over.
TEST_F(RecordWriterTest, FullQueueIsWrittenAtOnce) {
  RecordWriter writer(store_, std::chrono::hours(1), {});
  writer.Start();
  for (std::int64_t trial = 0; trial < 2 * kMax + 1; ++trial) {
    writer.Push({0, FakeRecord(1, static_cast<std::uint64_t>(trial))});
  }
  writer.Close();
  EXPECT_EQ(store_.Finished().size(), 2U * RecordWriter::kMaxWaiting + 1);
}

TEST_F(RecordWriterTest, WithoutAThreadNobodyWaits) {
  RecordWriter writer(store_, std::chrono::hours(1), {});
  for (std::int64_t trial = 0; trial < kMax + 1; ++trial) {
    writer.Push({0, FakeRecord(1, static_cast<std::uint64_t>(trial))});
  }
  writer.Close();
  EXPECT_EQ(writer.stored(), kMax + 1);
}

}  // namespace
}  // namespace rockyard::batch
