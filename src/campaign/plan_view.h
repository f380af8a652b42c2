// The plan view of a drive over its terrain.
#pragma once

#include <string>

#include "scenario/scenario.h"
#include "truth/trace.h"

namespace rockyard::campaign {

// An SVG file in the manner of Matthies 1995, figure 16: octagons at the positions and of the sizes
// of rocks, true path solid, dead-reckoned path dotted, filled circles on both where obstacles were
// detected, an x at start and goal. Rocks lie where they lay at the start. Cost: that of building
// the terrain.
std::string PlanView(const scenario::Scenario& scenario, const truth::TracedTrial& traced);

}  // namespace rockyard::campaign
