// Whether a plan can be run as it is asked for.
#pragma once

#include "campaign/campaign_request.h"
#include "campaign/open_run.h"

namespace rockyard::campaign {

// Throws core::UserError with everything that is asked of this plan and that cannot be: a stopping
// rule of a shard, where nothing drives, or where trials share layouts and are not independent;
// traces that are asked for with a rule that is none, or where nothing drives.
void CheckPlan(const CampaignRequest& request, const CampaignPlan& plan);

}  // namespace rockyard::campaign
