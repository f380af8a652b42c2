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

struct RoverGeometry {
  messages::PerWheel<math::Vector3> wheel_R;  // wheel centres, m
  messages::PerWheel<bool> steered{};
  messages::PerWheel<bool> on_bogie{};          // otherwise on the rocker
  std::array<math::Vector3, 2> rocker_pivot_R;  // by Side
  std::array<math::Vector3, 2> bogie_pivot_R;
};

RoverGeometry MakeRoverGeometry(const RoverGeometryParams& params);

// The true drive geometry; on-board code gets a copy.
messages::DriveCalibration MakeDriveCalibration(const RoverParams& params);

// Closed outlines seen from above, as (x, y) in R, counter-clockwise, m.
using Outline = std::vector<std::pair<double, double>>;
Outline BodyOutline(const RoverGeometryParams& params);   // overall length by width
Outline BellyOutline(const RoverGeometryParams& params);  // underside of the chassis
std::array<Outline, messages::kWheelCount> WheelOutlines(const RoverGeometryParams& params);

}  // namespace rockyard::rover
