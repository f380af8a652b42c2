#include "batch/record_writer.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/test_folder.h"
#include "fake_experiment.h"

namespace rockyard::batch {
namespace {

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
