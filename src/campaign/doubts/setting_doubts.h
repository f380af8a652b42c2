// Settings of a drive, a mission or scenes of hazards that hardly suit each other, by sizes and
// physics.
#pragma once

#include <vector>

#include "core/error.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// Each with the path of one of the settings, what is doubtful, and what would be right. The rules
// ask only what the chosen navigator, sensor and estimator use; their thresholds, assumptions all,
// stand where they are applied. They leave room for rovers and sites that are merely unusual: what
// they doubt would end drives, or hide what is to be found out.
std::vector<core::Problem> DoubtsOfSettings(const scenario::Scenario& scenario);

}  // namespace rockyard::campaign
