#include "batch/remote_work.h"

#include <algorithm>
#include <utility>

namespace rockyard::batch {

std::optional<TrialId> RemoteWorkSource::Take() {
  std::unique_lock lock(mutex_);
  ++idle_;
  while (waiting_.empty() && !closed_ && !stop_) added_.wait_for(lock, kStopCheck);
  --idle_;
  if (waiting_.empty() || closed_ || stop_) return std::nullopt;
  const TrialId id = waiting_.front();
  waiting_.pop_front();
  taken_.push_back({id, Clock::now()});
  return id;
}

void RemoteWorkSource::Finish(CellRecord record) {
  const std::lock_guard lock(mutex_);
  const TrialId id{record.cell, static_cast<std::int64_t>(record.record.trial)};
  const auto taken = std::find_if(taken_.begin(), taken_.end(),
                                  [&](const Taken& candidate) { return candidate.id == id; });
  if (taken != taken_.end()) {
    busy_s_ += std::chrono::duration<double>(Clock::now() - taken->at).count();
    ++count_;
    taken_.erase(taken);
  }
  finished_.push_back(std::move(record));
}

void RemoteWorkSource::Add(const std::vector<TrialId>& trials) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.insert(waiting_.end(), trials.begin(), trials.end());
  }
  added_.notify_all();
}

void RemoteWorkSource::Close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  added_.notify_all();
}

std::int64_t RemoteWorkSource::Wanted() const {
  const std::lock_guard lock(mutex_);
  double ahead = count_ == 0 ? 0.0 : static_cast<double>(threads_) * kBlock_s;
  if (busy_s_ > 0.0) ahead *= static_cast<double>(count_) / busy_s_;
  const auto block = static_cast<std::int64_t>(std::min<double>(ahead, kLargestBlock));
  const auto held = static_cast<std::int64_t>(waiting_.size());
  if (held < idle_) return std::max<std::int64_t>(block, idle_) - held;
  return 2 * held < block ? block - held : 0;
}

std::vector<CellRecord> RemoteWorkSource::Collect() {
  const std::lock_guard lock(mutex_);
  return std::exchange(finished_, {});
}

std::vector<TrialId> RemoteWorkSource::Untaken() {
  const std::lock_guard lock(mutex_);
  const std::deque<TrialId> untaken = std::exchange(waiting_, {});
  return {untaken.begin(), untaken.end()};
}

}  // namespace rockyard::batch
