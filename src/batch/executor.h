// Runs the trials of an experiment on several threads, and stores every one.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

#include "batch/prefix_counter.h"
#include "batch/result_store.h"
#include "experiments/experiment.h"

namespace rockyard::batch {

// In which order pending trials are started. No result depends on it; kShuffled exists to test
// that.
enum class Order { kNatural, kShuffled };

struct BatchOptions {
  std::int64_t trials = 300;  // indices 0 .. trials-1, those in the store included
  std::uint64_t seed = 1;
  int threads = 0;  // 0: as many as the machine runs at once
  Order order = Order::kNatural;
  double max_fault_fraction = 0.01;  // of all finished trials
  // Between two commits and two reports. With the time of a commit below one second.
  std::chrono::milliseconds interval{500};
};

struct Progress {
  std::int64_t planned = 0;
  std::int64_t finished = 0;         // all that are finished, in any order
  std::int64_t finished_before = 0;  // of these, in earlier sessions
  std::int64_t faults = 0;           // of all finished
  PrefixCounts prefix{};             // what rates may be shown of
  double elapsed_s = 0.0;            // of this session, wall clock
};
using ProgressReport = std::function<void(const Progress&)>;

enum class BatchEnd {
  kFinished,  // every planned trial is stored
  kStopped,   // by the stop flag; what was in flight is stored
};

struct BatchResult {
  BatchEnd end = BatchEnd::kFinished;
  Progress progress;
  bool too_many_faults = false;  // more than max_fault_fraction of the finished trials
};

int ThreadCount(const BatchOptions& options);

// Runs the trials that the store lacks and stores them. `report` is called about twice per second
// and once at the end, by one thread at a time. When `stop` becomes true no further trial starts,
// those in flight finish and are stored. An exception out of a trial, or a record that does not fit
// the schema, is stored as a simulator fault. Throws StoreError when the store cannot be written:
// the message says how many finished trials it lacks (they are run again, to the same bits, by a
// later session). The records do not depend on threads, order or interruptions.
BatchResult RunBatch(const experiments::Experiment& experiment, ResultStore& store,
                     const BatchOptions& options, const std::atomic<bool>& stop,
                     const ProgressReport& report = {});

}  // namespace rockyard::batch
