#include "batch/executor.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <string>
#include <utility>

#include "batch/batch_session.h"
#include "batch/sqlite_database.h"
#include "core/check.h"
#include "core/error.h"

namespace rockyard::batch {
namespace {

truth::Record RunOne(const experiments::Experiment& experiment, std::uint64_t seed,
                     std::uint64_t trial) {
  try {
    truth::Record record = experiment.Run(seed, trial);
    if (truth::IsFault(record)) {
      record.values.clear();
    } else if (record.values.size() != experiment.schema().size()) {
      return truth::MakeFault(seed, trial,
                              fmt::format("the record has {} values for {} columns",
                                          record.values.size(), experiment.schema().size()));
    }
    // Records depend on this: stores take infinite values for damage.
    const auto infinite = std::find_if(record.values.begin(), record.values.end(),
                                       [](double value) { return std::isinf(value); });
    if (infinite != record.values.end()) {
      const auto column = std::distance(record.values.begin(), infinite);
      return truth::MakeFault(
          seed, trial,
          fmt::format("{} is infinite",
                      experiment.schema()[static_cast<std::size_t>(column)].name));
    }
    record.trial = trial;
    return record;
  } catch (const std::exception& error) {
    if (core::IsMachineFailure(error)) throw;
    return truth::MakeFault(seed, trial, error.what());
  } catch (...) {
    return truth::MakeFault(seed, trial, "an exception without a message");
  }
}

}  // namespace

int ThreadCount(const BatchOptions& options) {
  return options.threads > 0 ? options.threads : omp_get_num_procs();
}

CellRecord RunTrial(std::span<const CellWork> work, TrialId id) {
  const CellWork& cell = work[static_cast<std::size_t>(id.cell)];
  return {id.cell, RunOne(*cell.experiment, cell.seed, static_cast<std::uint64_t>(id.trial))};
}

void RunTrials(std::span<const CellWork> work, WorkSource& source, int threads) {
  std::exception_ptr failure;
#pragma omp parallel num_threads(threads)
  try {
    while (const std::optional<TrialId> id = source.Take()) source.Finish(RunTrial(work, *id));
  } catch (...) {
#pragma omp critical(rockyard_failure_of_a_trial)
    failure = std::current_exception();
    source.Close();
  }
  if (failure) std::rethrow_exception(failure);
}

BatchResult RunBatch(std::span<const CellWork> work, ResultStore& store,
                     const BatchOptions& options, const std::atomic<bool>& stop,
                     const ProgressReport& report) {
  EXPECT(static_cast<int>(work.size()) == store.cells());
  BatchSession session(store, options, stop, report);
  RunTrials(work, session.source(), ThreadCount(options));
  return session.Close();
}

BatchResult RunBatch(const experiments::Experiment& experiment, ResultStore& store,
                     const BatchOptions& options, const std::atomic<bool>& stop,
                     const ProgressReport& report) {
  const CellWork work{&experiment, store.identity().cells.front().seed};
  return RunBatch(std::span(&work, 1), store, options, stop, report);
}

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
    // After a failure the rest is tried once more by Close, when the trials in flight have ended.
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

LocalWorkSource::LocalWorkSource(WorkPlan& plan, RecordWriter& writer,
                                 const std::atomic<bool>& stop)
    : plan_(plan), writer_(writer), stop_(stop) {}

std::optional<TrialId> LocalWorkSource::Take() {
  std::unique_lock lock(mutex_);
  while (true) {
    const WorkPlan::NextStep next = NextLocked();
    if (next.step == WorkPlan::Step::kTrial) return next.id;
    if (next.step == WorkPlan::Step::kDone) return std::nullopt;
    changed_.wait_for(lock, kStopCheck);
  }
}

void LocalWorkSource::Finish(CellRecord record) {
  {
    const std::lock_guard lock(mutex_);
    const TrialId id{record.cell, static_cast<std::int64_t>(record.record.trial)};
    // The plan does not wait for the disk: a record that is lost is run again, to the same bits.
    if (!plan_.Finish(id, record.record.outcome)) return;
  }
  changed_.notify_all();
  writer_.Push(std::move(record));
}

void LocalWorkSource::Close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

WorkPlan::NextStep LocalWorkSource::TryTake() {
  const std::lock_guard lock(mutex_);
  return NextLocked();
}

void LocalWorkSource::PutBack(TrialId id) {
  {
    const std::lock_guard lock(mutex_);
    plan_.PutBack(id);
  }
  changed_.notify_all();
}

bool LocalWorkSource::exhausted() const {
  const std::lock_guard lock(mutex_);
  return exhausted_;
}

WorkPlan::NextStep LocalWorkSource::NextLocked() {
  if (closed_ || stop_ || writer_.failed()) return {WorkPlan::Step::kDone};
  const WorkPlan::NextStep next = plan_.Next();
  if (next.step == WorkPlan::Step::kDone) exhausted_ = true;
  return next;
}

}  // namespace rockyard::batch
