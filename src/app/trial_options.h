// What `rockyard trace` and `rockyard replay` share: which trial, and whether it repeats its
// record.
#pragma once

#include <optional>

#include "campaign/trial_source.h"

namespace CLI {
class App;
}

namespace rockyard::app {

// Adds SCENARIO_OR_RUN, --trial, --cell, --seed and --set to a command. `request` must outlive it.
void AddTrialOptions(CLI::App& command, campaign::TrialRequest& request);

// Makes of the name of a scenario its file. Throws core::UserError where it is neither that nor one
// run.
void FindSource(campaign::TrialRequest& request);

// Says that a trial repeats its stored record, where it does, and of one of a run (`source` is its
// folder) that has none yet that it is compared with nothing.
void PrintRepetition(std::optional<bool> repeats_stored, const std::string& source);

}  // namespace rockyard::app
