// Where the cells of a store ended, decided again from what is stored.
#pragma once

#include <cstdint>
#include <vector>

#include "batch/result_store.h"
#include "batch/work_plan.h"

namespace rockyard::batch {

// The plan of a store under a rule, with its finished trials; before the first Next.
WorkPlan StoredPlan(const ResultStore& store, const std::optional<StoppingRule>& rule,
                    Order order = Order::kNatural);

// One state per cell, as the rule of the store decides; a store without a rule has only open or
// planned cells. Cost: reads cell, trial and outcome of every row.
std::vector<CellState> StoredEnds(const ResultStore& store);

}  // namespace rockyard::batch
