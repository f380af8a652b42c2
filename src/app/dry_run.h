// What a run would do.
#pragma once

#include "app/campaign_options.h"
#include "app/exit_code.h"
#include "campaign/open_run.h"

namespace rockyard::app {

// Prints the cells, the trials that are pending, the folder, and the cost that three pilot trials
// of the first cell let expect. Writes nothing. Throws core::UserError as RunCampaign would, where
// the options or the folder forbid the run.
ExitCode DryRun(const CampaignOptions& options, const campaign::CampaignPlan& plan);

}  // namespace rockyard::app
