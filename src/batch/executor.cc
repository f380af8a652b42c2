#include "batch/executor.h"

#include <fmt/format.h>
#include <omp.h>

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

truth::Record Fault(std::uint64_t seed, std::uint64_t trial, const std::string& reason) {
  return {trial,
          truth::TrialOutcome::kSimulatorFault,
          fmt::format("{} (seed {}, trial {})", reason, seed, trial),
          {}};
}

truth::Record RunOne(const experiments::Experiment& experiment, std::uint64_t seed,
                     std::uint64_t trial) {
  try {
    truth::Record record = experiment.Run(seed, trial);
    if (record.outcome == truth::TrialOutcome::kSimulatorFault) {
      record.values.clear();
    } else if (record.values.size() != experiment.schema().size()) {
      return Fault(seed, trial,
                   fmt::format("the record has {} values for {} columns", record.values.size(),
                               experiment.schema().size()));
    }
    record.trial = trial;
    return record;
  } catch (const std::exception& error) {
    return Fault(seed, trial, error.what());
  } catch (...) {
    return Fault(seed, trial, "an exception without a message");
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
  Tally(std::int64_t planned, Clock::time_point start)
      : planned_(planned), start_(start), counter_(planned) {}

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

std::vector<std::int64_t> Pending(const std::vector<truth::Record>& stored,
                                  const BatchOptions& options) {
  std::vector<std::int64_t> pending;
  std::size_t next = 0;
  for (std::int64_t trial = 0; trial < options.trials; ++trial) {
    const bool done =
        next < stored.size() && stored[next].trial == static_cast<std::uint64_t>(trial);
    if (done) {
      ++next;
    } else {
      pending.push_back(trial);
    }
  }
  if (options.order == Order::kShuffled) Shuffle(pending, options.seed);
  return pending;
}

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
  const std::vector<std::int64_t> pending = Pending(stored, options);
  Tally tally(options.trials, Clock::now());
  tally.AddStored(stored);
  const auto tell = [&] {
    if (report) report(tally.Now());
  };

  RecordWriter writer(store, options.interval, tell);
  const auto count = static_cast<std::int64_t>(pending.size());
  std::atomic<std::int64_t> done = 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads(ThreadCount(options))
  for (std::int64_t i = 0; i < count; ++i) {
    if (stop || writer.failed()) continue;
    truth::Record record = RunOne(experiment, options.seed,
                                  static_cast<std::uint64_t>(pending[static_cast<std::size_t>(i)]));
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
