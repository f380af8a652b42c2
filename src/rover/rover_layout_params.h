// Where wheels and pivots are, in frame R while the rover stands on level ground.
#pragma once

#include <array>

#include "math/pose.h"
#include "messages/wheels.h"
#include "rover/rover_geometry_params.h"

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

}  // namespace rockyard::rover
