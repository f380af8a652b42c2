// What `--dry-run` says.
#pragma once

#include <string>

#include "campaign/dry_run.h"
#include "campaign/sweep.h"

namespace rockyard::app {

// What a run would do and cost.
std::string RehearsalText(const campaign::DryRun& told);

// What a sweep would run and cost, and where its plan is.
std::string RehearsalText(const campaign::SweepRehearsal& told);

}  // namespace rockyard::app
