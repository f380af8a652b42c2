// The sheet of charts of a study of mobility.
#pragma once

#include <string>

#include "campaign/mobility/mobility.h"

namespace rockyard::campaign {

// Returns an SVG file: against the slope the slip straight up, down and across, side slip, sinkage,
// torque and power; against the slip of a wheel its pull and sinkage; steepest slopes and highest
// steps. One colour for each soil, one dash for each load, bands where soils were drawn, and the
// measured points.
std::string MobilitySvg(const MobilityRequest& request, const MobilityResult& result);

// Returns what is charted, in two lines for people: the rover, and how it was driven.
std::vector<std::string> MobilityHead(const MobilityRequest& request, const MobilityResult& result);

}  // namespace rockyard::campaign
