// How a rover stands: what each wheel carries on level ground at rest, where the centre of mass has
// to be for that, and the steepest slope on which soil holds it.
#pragma once

#include "messages/wheels.h"
#include "rover/rover_params.h"
#include "terrain/soil_params.h"

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

// Returns the inclination in [0, pi/2] at which the pull down the slope reaches what the soil bears
// across a braked wheel, whatever the rover's heading:
//   tan(slope) = T_max(N) / N,   N = W cos(slope) / 6,
// with each wheel under the mean load (wheel_rut_params.h). Wheels that point up or down the slope
// bear their resistance R more.
double SteepestHeldSlope_rad(const RoverParams& params, const terrain::SoilParams& soil);

}  // namespace rockyard::rover
