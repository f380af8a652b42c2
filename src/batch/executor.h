// Runs the trials of a campaign on several threads, and stores every one.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "batch/prefix_counter.h"
#include "batch/result_store.h"
#include "batch/work_plan.h"
#include "batch/work_source.h"
#include "experiments/experiment.h"

namespace rockyard::batch {

// What a cell runs.
struct CellWork {
  const experiments::Experiment* experiment = nullptr;
  std::uint64_t seed = 1;
};

struct BatchOptions {
  int threads = 0;  // 0: as many as the machine runs at once
  Order order = Order::kNatural;
  double max_fault_fraction = 0.01;  // of the finished trials, of all and of each cell
  // Between two commits and two reports. With the time of a commit below one second.
  std::chrono::milliseconds interval{500};
  std::optional<StoppingRule> rule{};  // none: every planned trial
};

struct Progress {
  std::int64_t planned = 0;          // by all cells; less once a rule has ended cells
  std::int64_t finished = 0;         // of those planned, in any order
  std::int64_t finished_before = 0;  // of these, in earlier sessions
  std::int64_t stored = 0;           // of this session, brought to the store
  std::int64_t faults = 0;           // of all finished
  PrefixCounts prefix{};             // of the only cell: what rates may be shown of
  double elapsed_s = 0.0;            // of this session, wall clock
  int cells = 1;
  int cells_ended = 0;             // all their planned trials are finished
  double widest_half_width = 0.0;  // of the cells, with a rule: at their last decisions
  double target_half_width = 0.0;  // 0: no rule
};
using ProgressReport = std::function<void(const Progress&)>;

enum class BatchEnd {
  kFinished,  // every planned trial is stored
  kStopped,   // by the stop flag; what was in flight is stored
};

struct BatchResult {
  BatchEnd end = BatchEnd::kFinished;
  Progress progress;
  bool too_many_faults = false;  // more than max_fault_fraction of all trials, or of a cell's
  std::vector<int> faulty_cells;
  std::vector<CellState> cells;
};

int ThreadCount(const BatchOptions& options);

// Runs one trial. An exception out of it, or a record that does not fit the schema, comes back as a
// simulator fault; a failure of the machine (core::IsMachineFailure) is thrown on.
CellRecord RunTrial(std::span<const CellWork> work, TrialId id);

// Takes trials from the source on that many threads until it has none left. Where one throws, none
// is begun any more, those in flight are finished, and it is thrown on.
void RunTrials(std::span<const CellWork> work, WorkSource& source, int threads);

// Runs the trials that the store lacks of those planned, and stores them. `work`: one for each cell
// of the store. `report` is called about twice per second and once at the end, by one thread at a
// time. When `stop` becomes true no further trial starts, those in flight finish and are stored.
// Where the rule ends a cell early its planned trials become those that it asked for. Throws
// what RunTrials throws, with the finished trials stored and that one pending;
// StoreError when the store cannot be written: the message says how many finished trials it lacks
// (they are run again, to the same bits, by a later session). The records do not depend on threads,
// order or interruptions. Memory: one byte per trial besides the records that wait to be written.
BatchResult RunBatch(std::span<const CellWork> work, ResultStore& store,
                     const BatchOptions& options, const std::atomic<bool>& stop,
                     const ProgressReport& report = {});

// The same for a store of one cell, with the seed that it names.
BatchResult RunBatch(const experiments::Experiment& experiment, ResultStore& store,
                     const BatchOptions& options, const std::atomic<bool>& stop,
                     const ProgressReport& report = {});

}  // namespace rockyard::batch
