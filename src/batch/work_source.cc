#include "batch/work_source.h"

#include <utility>

namespace rockyard::batch {

LocalWorkSource::LocalWorkSource(WorkPlan& plan, RecordWriter& writer,
                                 const std::atomic<bool>& stop)
    : plan_(plan), writer_(writer), stop_(stop) {}

std::optional<TrialId> LocalWorkSource::Take() {
  std::unique_lock lock(mutex_);
  while (true) {
    const WorkPlan::NextStep next = NextLocked();
    if (next.step == WorkPlan::Step::kTrial) return next.id;
    if (next.step == WorkPlan::Step::kDone) return std::nullopt;
    changed_.wait_for(lock, kStopCheck);
  }
}

void LocalWorkSource::Finish(CellRecord record) {
  {
    const std::lock_guard lock(mutex_);
    const TrialId id{record.cell, static_cast<std::int64_t>(record.record.trial)};
    if (!plan_.Finish(id, record.record.outcome)) return;
  }
  changed_.notify_all();
  writer_.Push(std::move(record));
}

void LocalWorkSource::Close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

WorkPlan::NextStep LocalWorkSource::TryTake() {
  const std::lock_guard lock(mutex_);
  return NextLocked();
}

void LocalWorkSource::PutBack(TrialId id) {
  {
    const std::lock_guard lock(mutex_);
    plan_.PutBack(id);
  }
  changed_.notify_all();
}

bool LocalWorkSource::exhausted() const {
  const std::lock_guard lock(mutex_);
  return exhausted_;
}

WorkPlan::NextStep LocalWorkSource::NextLocked() {
  if (closed_ || stop_ || writer_.failed()) return {WorkPlan::Step::kDone};
  const WorkPlan::NextStep next = plan_.Next();
  if (next.step == WorkPlan::Step::kDone) exhausted_ = true;
  return next;
}

}  // namespace rockyard::batch
