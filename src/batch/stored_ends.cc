#include "batch/stored_ends.h"

#include <utility>

namespace rockyard::batch {

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
