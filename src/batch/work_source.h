// Where the threads of a campaign get their trials and leave their records.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

#include "batch/campaign.h"
#include "batch/record_writer.h"
#include "batch/work_plan.h"

namespace rockyard::batch {

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

}  // namespace rockyard::batch
