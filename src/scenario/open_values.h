// Values that follow others where a scenario leaves them open (trial/open_values_params.h).
#pragma once

#include <vector>

#include "core/json_value.h"
#include "scenario/scenario.h"
#include "trial/open_values_params.h"

namespace rockyard::scenario {

// Those that the document does not state, or states as null, which is taken out of it.
std::vector<trial::OpenValue> TakeOpenValues(core::JsonValue& document);

// Sets them to what suits the scenario.
void SetOpenValues(const std::vector<trial::OpenValue>& open, Scenario& scenario);

// Lets the schema of scenarios have null for them.
void AllowOpenValues(core::JsonValue& schema);

}  // namespace rockyard::scenario
