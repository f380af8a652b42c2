// What one process that owns a store keeps while its campaign runs, and what a trial costs, from a
// few pilots. RunBatch and rank 0 or the worker of a campaign (campaign/campaign_process.h) run
// trials through a session; dry runs ask for pilots.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "batch/executor.h"
#include "batch/result_store.h"
#include "batch/work_plan.h"
#include "experiments/experiment.h"
#include "statistics/sample_statistics.h"
#include "truth/record.h"

namespace rockyard::batch {

// Holds the plan of a store, the thread that writes the store, and the source that hands out the
// trials that are left. Make a session, run trials from source() in any way, then Close.
//
// Must stay: which trials run follows from store and rule alone (StoredPlan, supervisor.h), never
// from threads, times or who finishes first, so that every session decides as the first did.
class BatchSession {
 public:
  // Reads which trials are stored. `store` and `stop` must outlive the session.
  BatchSession(ResultStore& store, const BatchOptions& options, const std::atomic<bool>& stop,
               ProgressReport report);

  LocalWorkSource& source() { return source_; }

  // Ends the writing thread, which has the store until then, writes what remains and reports once
  // more. Throws StoreError, with the number of finished trials that the store lacks, where the
  // store cannot be written. Without Close such an error is lost.
  BatchResult Close();

 private:
  Progress Now() const;
  void Tell() const;
  void StoreEnds();

  ResultStore& store_;
  const BatchOptions options_;
  const ProgressReport report_;
  const std::chrono::steady_clock::time_point start_;
  WorkPlan plan_;
  std::int64_t finished_before_;
  LocalWorkSource source_;
  RecordWriter writer_;  // last: its thread, joined first, reads all members above
};

// What a trial costs. `trials` is 0 where no pilot was run.
struct PilotCost {
  std::int64_t trials = 0;
  double mean_s = 0.0;       // CPU time of a trial
  double variance_s2 = 0.0;  // unbiased; 0 below two trials
  double slowest_s = 0.0;
  std::string hash;  // of the records; by it dry runs find cells that do not differ
  // By how much the largest resident memory of the process grew: what one thread takes.
  std::int64_t memory_B = 0;

  // Returns the variance of the CPU time of that many trials as told by these, s^2.
  double VarianceOf(double count) const {
    return trials == 0 ? 0.0 : variance_s2 * count * (1.0 + count / static_cast<double>(trials));
  }
};

// First trials of a cell, run on this thread; nothing is kept of them but their cost and their
// hash. The costs are measured, and differ from run to run. A trial that throws ends there, as a
// simulator fault, but for failures of the machine, which go on to the caller (RunTrial).
class Pilots {
 public:
  Pilots(const experiments::Experiment& experiment, std::uint64_t seed)
      : work_{&experiment, seed} {}
  // Runs the next trials; returns the CPU time that they took, s.
  double Run(int trials);
  PilotCost cost() const;

 private:
  CellWork work_;
  statistics::Moments cost_s_;
  std::vector<truth::Record> records_;
  std::int64_t memory_B_ = 0;
};

// Returns the largest resident memory of the process so far, bytes.
std::int64_t PeakMemory_B();

}  // namespace rockyard::batch
