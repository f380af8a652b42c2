// What each wheel carries on level ground at rest, and where the centre of mass has to be for that.
#pragma once

#include "messages/wheels.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// Returns the wheel loads in N, by the law of the lever. Each side carries half of the chassis,
// whose moment the differential passes on to both rockers alike; moments about the bogie pivot give
// the load of the wheel on the rocker, and the bogie's wheels share the rest as their levers do.
// This is exact where wheels have no friction along the ground; with friction the loads of a rover
// at rest also depend on how it came there. A negative load means that the rover cannot stand.
messages::PerWheel<double> StaticWheelLoads(const RoverParams& params);

// An open interval along x of R, m.
struct ComRange {
  double min_m;
  double max_m;
};

// Returns the positions mass.chassis_com_x_m of the chassis' centre of mass with which every wheel
// carries something; the present position does not matter.
ComRange StandingComRange(const RoverParams& params);

}  // namespace rockyard::rover
