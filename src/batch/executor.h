// Runs the trials of a campaign on several threads, and stores every one. Processes and ranks of a
// campaign (campaign/campaign_process.h) use its parts; RunBatch puts them together for one
// process, as tests do.
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

// Brings finished records to the store while the trials go on: one thread of its own commits
// everything pushed so far, once per interval. A record is durable at most one interval and the
// time of one commit after Push, however long the next trial takes.
class RecordWriter {
 public:
  // `after_tick` is called by the writing thread after each interval, never by two threads at once.
  RecordWriter(ResultStore& store, std::chrono::milliseconds interval,
               std::function<void()> after_tick);
  // Starts the thread. Call it once, when all that `after_tick` reads is there; without it, Close
  // writes everything.
  void Start();
  // Writes what remains if it can, and swallows errors: call Close to know.
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  // Hands over a record; any thread may call it. Blocks while kMaxWaiting records wait for a store
  // that is slower than the trials, so that memory stays bounded. It does not block after a
  // failure, nor without the thread.
  void Push(CellRecord record);
  static constexpr std::size_t kMaxWaiting = 20000;

  // How many records have been brought to the store.
  std::int64_t stored() const { return stored_; }

  // Returns whether a write has failed: then start no more trials.
  bool failed() const { return failed_; }

  // Ends the thread, tries to write what remains, and rethrows the first StoreError of all writes.
  void Close();

  // Returns how many records could not be written. Valid after Close.
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

// How soon a thread that waits for a trial or for the end of a round sees that the campaign is to
// stop.
inline constexpr std::chrono::milliseconds kStopCheck{50};

// Where the threads of a campaign get their trials and leave their records. Several threads may
// call it at once.
class WorkSource {
 public:
  virtual ~WorkSource() = default;

  // Returns the next trial; blocks while a round ends. Returns nothing where all trials are done,
  // or no more may start.
  virtual std::optional<TrialId> Take() = 0;

  // Leaves the record of a trial that was taken. May block until earlier records have been stored.
  virtual void Finish(CellRecord record) = 0;

  // Ends the handing out: a thread that waits for a trial gets none.
  virtual void Close() = 0;
};

// The trials of a plan, in this process; records go to a writer.
class LocalWorkSource final : public WorkSource {
 public:
  // `stop`: true ends the handing out. All arguments must outlive the source.
  LocalWorkSource(WorkPlan& plan, RecordWriter& writer, const std::atomic<bool>& stop);

  std::optional<TrialId> Take() override;
  void Finish(CellRecord record) override;
  void Close() override;

  // Takes without blocking, for a caller that serves others. Returns kDone also when the campaign
  // is to stop.
  WorkPlan::NextStep TryTake();

  // Puts back a trial that was taken by somebody who is gone.
  void PutBack(TrialId id);

  // Calls `read` with the plan while no thread changes it.
  template <typename Reader>
  auto Read(const Reader& read) const {
    const std::lock_guard lock(mutex_);
    return read(static_cast<const WorkPlan&>(plan_));
  }

  // Returns whether everything was handed out, and nothing ended it early.
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

// What a cell runs, and with which seed.
struct CellWork {
  const experiments::Experiment* experiment = nullptr;
  std::uint64_t seed = 1;
  bool foreign = false;  // a plugin or a process decides: crashes and hangs are its faults
};

struct BatchOptions {
  int threads = 0;  // 0: as many as the machine runs at once
  Order order = Order::kNatural;
  double max_fault_fraction = 0.01;  // of the finished trials, of all and of each cell; above it
                                     // the exit code is 3
  // The time between two commits and between two reports; with the time of a commit below one
  // second. WatchdogOptions::grace must be longer.
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

// Runs one trial. An exception out of it, a record that does not fit the schema, or an infinite
// value comes back as a simulator fault. A failure of the machine (core::IsMachineFailure) is
// thrown on, as no machine is to decide a record.
CellRecord RunTrial(std::span<const CellWork> work, TrialId id);

// Takes trials from the source on that many threads until it has none left. Where a trial throws,
// no other is begun, those in flight are finished, and the exception is thrown on.
void RunTrials(std::span<const CellWork> work, WorkSource& source, int threads);

// Runs the trials that the store lacks of those planned, and stores them. `work`: one for each cell
// of the store. `report` is called about twice per second and once at the end, by one thread at a
// time. When `stop` becomes true no further trial starts; those in flight finish and are stored.
// Where the rule ends a cell early, the planned trials of that cell become those that the rule
// asked for. The records do not depend on threads, order or interruptions.
//
// Throws what RunTrials throws; finished trials are stored then, and the trial that threw is
// pending. Throws StoreError when the store cannot be written: the message says how many finished
// trials it lacks (a later session runs them again, to the same bits). Memory: one byte per trial
// besides the records that wait to be written.
BatchResult RunBatch(std::span<const CellWork> work, ResultStore& store,
                     const BatchOptions& options, const std::atomic<bool>& stop,
                     const ProgressReport& report = {});

// RunBatch for a store of one cell, with the seed that the store names.
BatchResult RunBatch(const experiments::Experiment& experiment, ResultStore& store,
                     const BatchOptions& options, const std::atomic<bool>& stop,
                     const ProgressReport& report = {});

}  // namespace rockyard::batch
