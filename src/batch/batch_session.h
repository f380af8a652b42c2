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
};

// Runs trials 0 .. trials-1 on this thread and keeps nothing of them but their cost and their hash.
// The costs are measured times, which differ from run to run. A trial that throws ends there, as a
// simulator fault, but for failures of the machine, which go on to the caller (RunTrial).
PilotCost RunPilots(const experiments::Experiment& experiment, std::uint64_t seed, int trials);

}  // namespace rockyard::batch
