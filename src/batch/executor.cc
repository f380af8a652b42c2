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

}  // namespace rockyard::batch
