// What `rockyard trace` and `rockyard replay` share: which trial, and whether it repeats its
// record.
#pragma once

#include <vector>

#include "app/exit_code.h"
#include "campaign/trial_source.h"
#include "core/error.h"

namespace CLI {
class App;
}

namespace rockyard::app {

// Adds SCENARIO_OR_RUN, --trial, --cell, --seed and --set to a command. `request` must outlive it.
void AddTrialOptions(CLI::App& command, campaign::TrialRequest& request);

// Says whether a trial repeats its stored record: kDone, or kDiffers where there are differences
// (CompareWithStore).
ExitCode TellRepetition(const std::vector<core::Problem>& differences);

}  // namespace rockyard::app
