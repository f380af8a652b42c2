// What one process that owns a store keeps while its campaign runs, and what a trial costs, from a
// few pilots. RunBatch and rank 0 or the worker of a campaign (campaign/campaign_process.h) run
// trials through a session; dry runs ask for pilots.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include "batch/executor.h"
#include "batch/result_store.h"
#include "batch/work_plan.h"
#include "experiments/experiment.h"

namespace rockyard::batch {

// Holds the plan of a store, the thread that writes the store, and the source that hands out the
// trials that are left. Make a session, run trials from source() in any way, then Close.
class BatchSession {
 public:
  // Reads which trials are stored. `store` and `stop` must outlive the session.
  BatchSession(ResultStore& store, const BatchOptions& options, const std::atomic<bool>& stop,
               ProgressReport report);

  LocalWorkSource& source() { return source_; }

  // Writes what remains and reports once more. Throws StoreError, with the number of finished
  // trials that the store lacks, where the store cannot be written.
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
  RecordWriter writer_;  // after the source, which its thread reads
};

// What a trial costs. `trials` is 0 where no pilot was run.
struct PilotCost {
  std::int64_t trials = 0;
  double mean_s = 0.0;       // CPU time of a trial
  double variance_s2 = 0.0;  // unbiased; 0 below two trials
  double slowest_s = 0.0;
  std::string hash;  // of the records
};

// Runs trials 0 .. trials-1 on this thread and keeps nothing of them but their cost and their hash.
// The costs are measured times, which differ from run to run. A trial that throws ends there, as a
// simulator fault, but for failures of the machine, which go on to the caller (RunTrial).
PilotCost RunPilots(const experiments::Experiment& experiment, std::uint64_t seed, int trials);

}  // namespace rockyard::batch
