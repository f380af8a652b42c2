// What one process that owns a store keeps while its campaign runs.
#pragma once

#include <atomic>
#include <chrono>

#include "batch/executor.h"
#include "batch/record_writer.h"
#include "batch/result_store.h"
#include "batch/work_plan.h"
#include "batch/work_source.h"

namespace rockyard::batch {

// The plan of a store, the thread that writes it, and the source that hands out what is left. Make
// it, run trials from source() in any way, then Close.
class BatchSession {
 public:
  // Reads which trials are stored. All must outlive this.
  BatchSession(ResultStore& store, const BatchOptions& options, const std::atomic<bool>& stop,
               ProgressReport report);

  LocalWorkSource& source() { return source_; }

  // Writes what remains and reports once more. Throws StoreError, with the number of finished
  // trials that the store lacks, where it cannot be written.
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

}  // namespace rockyard::batch
