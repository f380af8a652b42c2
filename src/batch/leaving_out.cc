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

WorkPlan StoredPlan(const ResultStore& store, const std::optional<StoppingRule>& rule,
                    Order order) {
  std::vector<std::int64_t> planned;
  planned.reserve(static_cast<std::size_t>(store.cells()));
  for (int cell = 0; cell < store.cells(); ++cell) {
    // What is planned is less than the most trials of the rule once it has ended the cell.
    planned.push_back(rule ? rule->max_trials : store.planned(cell));
  }
  WorkPlan plan(std::move(planned),
                {.rule = rule, .order = order, .shard = store.identity().shard});
  plan.AddStored(store.Finished());
  return plan;
}

std::vector<CellState> StoredEnds(const ResultStore& store) {
  WorkPlan plan = StoredPlan(store, store.rule());
  plan.Next();
  std::vector<CellState> states;
  states.reserve(static_cast<std::size_t>(plan.cells()));
  for (int cell = 0; cell < plan.cells(); ++cell) states.push_back(plan.state(cell));
  return states;
}

}  // namespace rockyard::batch
