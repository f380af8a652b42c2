// Where the parts of the rover are, in frame R while it stands on level ground.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/wheels.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

enum class Side : std::size_t { kLeft, kRight };

// Centres and pivots in R, m, by messages::Wheel and by Side.
struct RoverGeometry {
  messages::PerWheel<math::Vector3> wheel_R;  // wheel centres, m
  messages::PerWheel<bool> steered{};
  messages::PerWheel<bool> on_bogie{};          // otherwise on the rocker
  std::array<math::Vector3, 2> rocker_pivot_R;  // by Side
  std::array<math::Vector3, 2> bogie_pivot_R;
};

// Spreads the wheels over the wheelbase and puts the bogies at the end that the parameters name.
RoverGeometry MakeRoverGeometry(const RoverGeometryParams& params);

// Returns the true drive geometry, of which on-board code gets a copy.
messages::DriveCalibration MakeDriveCalibration(const RoverParams& params);

// A closed outline seen from above: corners (x, y) in R, m, counter-clockwise.
using Outline = std::vector<std::pair<double, double>>;
Outline BodyOutline(const RoverGeometryParams& params);   // overall length by width
Outline BellyOutline(const RoverGeometryParams& params);  // underside of the chassis
std::array<Outline, messages::kWheelCount> WheelOutlines(const RoverGeometryParams& params);

}  // namespace rockyard::rover
