#include "batch/leaving_out.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace rockyard::batch {
namespace {

constexpr std::chrono::milliseconds kAskAgain{5};

}  // namespace

LeavingOutSource::LeavingOutSource(LocalWorkSource& source, std::vector<TrialId> left_out)
    : source_(source), left_out_(std::move(left_out)) {}

std::optional<TrialId> LeavingOutSource::Take() {
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      const WorkPlan::NextStep next = source_.TryTake();
      const bool hangs = std::find(left_out_.begin(), left_out_.end(), next.id) != left_out_.end();
      switch (next.step) {
        case WorkPlan::Step::kDone:
          return std::nullopt;
        case WorkPlan::Step::kWait:
          if (running_ == 0) return std::nullopt;  // all that is missing has been left out
          break;
        case WorkPlan::Step::kTrial:
          if (hangs) continue;
          ++running_;
          return next.id;
      }
    }
    std::this_thread::sleep_for(kAskAgain);
  }
}

void LeavingOutSource::Finish(CellRecord record) {
  const std::lock_guard lock(mutex_);
  source_.Finish(std::move(record));
  --running_;
}

}  // namespace rockyard::batch
