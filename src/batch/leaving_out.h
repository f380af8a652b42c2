// A campaign without some of its trials.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "batch/result_store.h"
#include "batch/work_plan.h"
#include "batch/work_source.h"

namespace rockyard::batch {

// Hands out what `source` has, but for trials that hang or are killed: they stay pending. A round
// of a stopping rule that has one of them never ends, so that everything ends with it.
class LeavingOutSource final : public WorkSource {
 public:
  LeavingOutSource(LocalWorkSource& source, std::vector<TrialId> left_out);

  std::optional<TrialId> Take() override;
  void Finish(CellRecord record) override;
  void Close() override { source_.Close(); }

 private:
  LocalWorkSource& source_;
  const std::vector<TrialId> left_out_;
  std::mutex mutex_;
  int running_ = 0;
};

// Where the cells of a store ended, decided again from what is stored.

// The plan of a store under a rule, with its finished trials; before the first Next.
WorkPlan StoredPlan(const ResultStore& store, const std::optional<StoppingRule>& rule,
                    Order order = Order::kNatural);

// One state per cell, as the rule of the store decides; a store without a rule has only open or
// planned cells. Cost: reads cell, trial and outcome of every row.
std::vector<CellState> StoredEnds(const ResultStore& store);

}  // namespace rockyard::batch
