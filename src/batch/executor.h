// Runs the trials of a campaign on several threads, and stores every one.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "batch/campaign.h"
#include "batch/result_store.h"
#include "batch/work_plan.h"
#include "experiments/experiment.h"

namespace rockyard::batch {

// Brings finished records to the store while the trials go on.

// One thread of its own that commits everything pushed so far, once per interval. A record is
// durable at most one interval and the time of one commit after Push, however long the next trial
// takes.
class RecordWriter {
 public:
  // `after_tick` is called by the writing thread after each interval, never by two threads at once.
  RecordWriter(ResultStore& store, std::chrono::milliseconds interval,
               std::function<void()> after_tick);
  // From now on there is the thread. Once; without it, Close writes everything.
  void Start();
  // Writes what remains if it can, and swallows errors: call Close to know.
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  // Any thread. Blocks while kMaxWaiting records wait for a store that is slower than the trials,
  // so that memory stays bounded; not after a failure, nor without the thread.
  void Push(CellRecord record);
  static constexpr std::size_t kMaxWaiting = 20000;

  // Records that have been brought to the store.
  std::int64_t stored() const { return stored_; }

  // True once a write has failed: start no more trials.
  bool failed() const { return failed_; }

  // Ends the thread, tries to write what remains, and rethrows the first StoreError of all writes.
  void Close();

  // Records that could not be written. After Close.
  std::size_t unwritten() const { return queue_.size(); }

 private:
  void Loop();
  void WriteQueue();
  void Stop();

  ResultStore& store_;
  const std::chrono::milliseconds interval_;
  const std::function<void()> after_tick_;
  std::mutex mutex_;
  std::condition_variable wake_;   // the thread
  std::condition_variable taken_;  // the queue is empty again, or never will be
  std::vector<CellRecord> queue_;
  bool stopping_ = false;
  std::atomic<std::int64_t> stored_ = 0;
  std::atomic<bool> failed_ = false;
  std::exception_ptr error_;
  std::thread thread_;
};

// Where the threads of a campaign get their trials and leave their records.

// How soon a thread that waits for a trial or for the end of a round sees that the campaign is to
// stop.
inline constexpr std::chrono::milliseconds kStopCheck{50};

// For several threads at once.
class WorkSource {
 public:
  virtual ~WorkSource() = default;

  // The next trial. Blocks while a round ends. Nothing where all are done, or no more may start.
  virtual std::optional<TrialId> Take() = 0;

  // The record of a trial that was taken. May block until earlier ones have been stored.
  virtual void Finish(CellRecord record) = 0;

  // Nothing more is handed out; who waits for a trial gets none.
  virtual void Close() = 0;
};

// The trials of a plan, in this process; records go to a writer.
class LocalWorkSource final : public WorkSource {
 public:
  // `stop`: true ends the handing out. All must outlive this.
  LocalWorkSource(WorkPlan& plan, RecordWriter& writer, const std::atomic<bool>& stop);

  std::optional<TrialId> Take() override;
  void Finish(CellRecord record) override;
  void Close() override;

  // Take without blocking, for who serves others: kDone also when the campaign is to stop.
  WorkPlan::NextStep TryTake();

  // A trial that was taken by somebody who is gone.
  void PutBack(TrialId id);

  // Calls `read` with the plan while no thread changes it.
  template <typename Reader>
  auto Read(const Reader& read) const {
    const std::lock_guard lock(mutex_);
    return read(static_cast<const WorkPlan&>(plan_));
  }

  // Everything was handed out, and nothing ended it early.
  bool exhausted() const;

 private:
  WorkPlan::NextStep NextLocked();

  WorkPlan& plan_;
  RecordWriter& writer_;
  const std::atomic<bool>& stop_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool exhausted_ = false;
  bool closed_ = false;
};

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
// simulator fault; a failure of the machine (core::IsMachineFailure) is thrown on, as no machine is
// to decide a record.
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
