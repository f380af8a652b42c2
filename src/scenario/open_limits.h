// Limits that follow course and rover where a scenario leaves them open (trial/patience_params.h).
#pragma once

#include <vector>

#include "core/json_value.h"
#include "scenario/scenario.h"
#include "trial/patience_params.h"

namespace rockyard::scenario {

// Those that the document does not state, or states as null, which is taken out of it.
std::vector<trial::OpenLimit> TakeOpenLimits(core::JsonValue& document);

// Sets them to what suits the scenario.
void SetOpenLimits(const std::vector<trial::OpenLimit>& open, Scenario& scenario);

// Lets the schema of scenarios have null for them.
void AllowOpenLimits(core::JsonValue& schema);

}  // namespace rockyard::scenario
