// Brings finished records to the store while the trials go on.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "batch/result_store.h"

namespace rockyard::batch {

// One thread of its own that commits everything pushed so far, once per interval. A record is
// durable at most one interval and the time of one commit after Push, however long the next trial
// takes.
class RecordWriter {
 public:
  // `after_tick` is called by the writing thread after each interval, never by two threads at once.
  RecordWriter(ResultStore& store, std::chrono::milliseconds interval,
               std::function<void()> after_tick);
  // From now on there is the thread. Once; without it, Close writes everything.
  void Start();
  // Writes what remains if it can, and swallows errors: call Close to know.
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  // Any thread. Blocks while kMaxWaiting records wait for a store that is slower than the trials,
  // so that memory stays bounded; not after a failure, nor without the thread.
  void Push(CellRecord record);
  static constexpr std::size_t kMaxWaiting = 20000;

  // Records that have been brought to the store.
  std::int64_t stored() const { return stored_; }

  // True once a write has failed: start no more trials.
  bool failed() const { return failed_; }

  // Ends the thread, tries to write what remains, and rethrows the first StoreError of all writes.
  void Close();

  // Records that could not be written. After Close.
  std::size_t unwritten() const { return queue_.size(); }

 private:
  void Loop();
  void WriteQueue();
  void Stop();

  ResultStore& store_;
  const std::chrono::milliseconds interval_;
  const std::function<void()> after_tick_;
  std::mutex mutex_;
  std::condition_variable wake_;   // the thread
  std::condition_variable taken_;  // the queue is empty again, or never will be
  std::vector<CellRecord> queue_;
  bool stopping_ = false;
  std::atomic<std::int64_t> stored_ = 0;
  std::atomic<bool> failed_ = false;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace rockyard::batch
