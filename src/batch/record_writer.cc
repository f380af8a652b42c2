#include "batch/record_writer.h"

#include <utility>

#include "batch/store_error.h"

namespace rockyard::batch {

RecordWriter::RecordWriter(ResultStore& store, std::chrono::milliseconds interval,
                           std::function<void()> after_tick)
    : store_(store), interval_(interval), after_tick_(std::move(after_tick)) {}

void RecordWriter::Start() {
  thread_ = std::thread([this] { Loop(); });
}

RecordWriter::~RecordWriter() {
  Stop();
  WriteQueue();
}

void RecordWriter::Push(CellRecord record) {
  std::unique_lock lock(mutex_);
  taken_.wait(lock, [this] {
    return queue_.size() < kMaxWaiting || failed_ || stopping_ || !thread_.joinable();
  });
  queue_.push_back(std::move(record));
  if (queue_.size() >= kMaxWaiting) wake_.notify_one();
}

void RecordWriter::Close() {
  Stop();
  WriteQueue();
  if (error_) std::rethrow_exception(error_);
}

void RecordWriter::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  taken_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void RecordWriter::Loop() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    wake_.wait_for(lock, interval_,
                   [this] { return stopping_ || (queue_.size() >= kMaxWaiting && !failed_); });
    if (stopping_) return;
    lock.unlock();
    // After a failure the rest is tried once more, when the trials in flight have ended.
    if (!failed_) WriteQueue();
    if (after_tick_) after_tick_();
    lock.lock();
  }
}

void RecordWriter::WriteQueue() {
  std::vector<CellRecord> batch;
  {
    const std::lock_guard lock(mutex_);
    batch.swap(queue_);
  }
  taken_.notify_all();
  try {
    store_.Append(batch);
    stored_ += static_cast<std::int64_t>(batch.size());
  } catch (const std::exception&) {
    if (!error_) error_ = std::current_exception();
    const std::lock_guard lock(mutex_);
    failed_ = true;
    taken_.notify_all();
    batch.insert(batch.end(), std::make_move_iterator(queue_.begin()),
                 std::make_move_iterator(queue_.end()));
    queue_ = std::move(batch);
  }
}

}  // namespace rockyard::batch
