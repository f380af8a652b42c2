#include "campaign/planned_trials.h"

#include <fmt/format.h>

#include <algorithm>

namespace rockyard::campaign {

std::string PlannedTrials::text() const {
  return fmt::format("{}{} trials", at_most ? "at most " : "", total);
}

PlannedTrials TrialsOf(const OpenRequest& request, const CampaignPlan& plan) {
  PlannedTrials planned;
  planned.at_most = request.rule.has_value();
  for (const CampaignCell& cell : plan.cells) {
    const std::int64_t trials = request.rule ? request.rule->max_trials : cell.scenario.trials;
    planned.cells.push_back(request.shard.Share(trials));
    planned.total += planned.cells.back();
  }
  const bool limited = request.rule && request.rule->budget > 0;
  if (limited) planned.total = std::min(planned.total, request.rule->budget);
  return planned;
}

}  // namespace rockyard::campaign
