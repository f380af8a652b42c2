// How many trials a campaign would have.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/open_run.h"

namespace rockyard::campaign {

struct PlannedTrials {
  std::vector<std::int64_t> cells;  // the shard's share of each
  std::int64_t total = 0;           // of all, as far as the budget of a rule goes
  bool at_most = false;             // a rule may end cells before

  std::string text() const;  // "12 trials", "at most 100 trials"
};

// Of a plan that is to be run as requested; trials that are stored already are among them.
PlannedTrials TrialsOf(const OpenRequest& request, const CampaignPlan& plan);

}  // namespace rockyard::campaign
