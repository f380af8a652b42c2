#include "batch/executor.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "batch/record_writer.h"
#include "batch/store_error.h"
#include "core/check.h"
#include "core/random.h"

namespace rockyard::batch {
namespace {

using Clock = std::chrono::steady_clock;

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
    record.trial = trial;
    return record;
  } catch (const std::exception& error) {
    return truth::MakeFault(seed, trial, error.what());
  } catch (...) {
    return truth::MakeFault(seed, trial, "an exception without a message");
  }
}

// A permutation of no importance (Fisher and Yates), the same for the same seed.
void Shuffle(std::vector<std::int64_t>& trials, std::uint64_t seed) {
  core::RandomStream stream({seed, 0}, core::Purpose::kTest);
  for (std::size_t left = trials.size(); left > 1; --left) {
    std::swap(trials[left - 1], trials[stream.NextU64() % left]);
  }
}

// Counts shared by the threads.
class Tally {
 public:
  Tally(std::int64_t planned, Clock::time_point start) : planned_(planned), start_(start) {}

  void AddStored(const std::vector<truth::Record>& records) {
    for (const truth::Record& record : records) {
      counter_.Add(static_cast<std::int64_t>(record.trial), record.outcome);
    }
    finished_before_ = counter_.finished();
  }

  void Add(const truth::Record& record) {
    const std::lock_guard lock(mutex_);
    counter_.Add(static_cast<std::int64_t>(record.trial), record.outcome);
  }

  Progress Now() const {
    const std::lock_guard lock(mutex_);
    return {.planned = planned_,
            .finished = counter_.finished(),
            .finished_before = finished_before_,
            .faults = counter_.faults(),
            .prefix = counter_.prefix(),
            .elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count()};
  }

 private:
  const std::int64_t planned_;
  const Clock::time_point start_;
  mutable std::mutex mutex_;
  PrefixCounter counter_;
  std::int64_t finished_before_ = 0;
};

// The trials that the store lacks: those missing among its own, then everything after them.
class PendingTrials {
 public:
  PendingTrials(const std::vector<truth::Record>& stored, const BatchOptions& options) {
    std::int64_t next = 0;
    for (const truth::Record& record : stored) {
      const auto trial = std::min(static_cast<std::int64_t>(record.trial), options.trials);
      for (; next < trial; ++next) listed_.push_back(next);
      next = static_cast<std::int64_t>(record.trial) + 1;
    }
    rest_ = next;
    count_ = Listed() + std::max<std::int64_t>(options.trials - rest_, 0);
    if (options.order == Order::kShuffled) {
      for (; next < options.trials; ++next) listed_.push_back(next);
      Shuffle(listed_, options.seed);
    }
  }

  std::int64_t count() const { return count_; }
  std::int64_t operator[](std::int64_t i) const {
    return i < Listed() ? listed_[static_cast<std::size_t>(i)] : rest_ + (i - Listed());
  }

 private:
  std::int64_t Listed() const { return static_cast<std::int64_t>(listed_.size()); }

  std::vector<std::int64_t> listed_;
  std::int64_t rest_ = 0;
  std::int64_t count_ = 0;
};

// The first error of the writer with what it means for the finished trials.
[[noreturn]] void ReportLoss(const StoreError& error, std::size_t unwritten) {
  std::vector<core::Problem> problems = error.problems();
  problems.front().reason += fmt::format(
      "; {} finished trials could not be stored, those stored before are safe", unwritten);
  throw StoreError(error.problem(), std::move(problems));
}

void CloseWriter(RecordWriter& writer) {
  try {
    writer.Close();
  } catch (const StoreError& error) {
    ReportLoss(error, writer.unwritten());
  }
}

}  // namespace

int ThreadCount(const BatchOptions& options) {
  return options.threads > 0 ? options.threads : omp_get_num_procs();
}

BatchResult RunBatch(const experiments::Experiment& experiment, ResultStore& store,
                     const BatchOptions& options, const std::atomic<bool>& stop,
                     const ProgressReport& report) {
  EXPECT(options.trials >= 0);
  const std::vector<truth::Record> stored = store.Load();
  const PendingTrials pending(stored, options);
  Tally tally(options.trials, Clock::now());
  tally.AddStored(stored);
  const auto tell = [&] {
    if (report) report(tally.Now());
  };

  RecordWriter writer(store, options.interval, tell);
  const std::int64_t count = pending.count();
  std::atomic<std::int64_t> done = 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads(ThreadCount(options))
  for (std::int64_t i = 0; i < count; ++i) {
    if (stop || writer.failed()) continue;
    truth::Record record = RunOne(experiment, options.seed, static_cast<std::uint64_t>(pending[i]));
    tally.Add(record);
    writer.Push(std::move(record));
    ++done;
  }
  CloseWriter(writer);
  tell();

  BatchResult result;
  result.progress = tally.Now();
  result.end = done == count ? BatchEnd::kFinished : BatchEnd::kStopped;
  result.too_many_faults =
      static_cast<double>(result.progress.faults) >
      options.max_fault_fraction * static_cast<double>(result.progress.finished);
  return result;
}

}  // namespace rockyard::batch
