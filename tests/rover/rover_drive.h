// Wheel commands and terrains for tests of the rover.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "messages/commands.h"
#include "rover/rover.h"
#include "rover/rover_geometry.h"
#include "terrain/terrain.h"

namespace rockyard::rover {

inline constexpr messages::WheelCommand kBraked{};

// Wheel set points for the planar motion with forward speed v at R's origin and turn rate w.
inline messages::WheelCommand Drive(const RoverParams& params, double v_m_s, double w_rad_s) {
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  messages::WheelCommand command;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double vx = v_m_s - w_rad_s * geometry.wheel_R[i].y();
    const double vy = w_rad_s * geometry.wheel_R[i].x();
    double steer = 0.0;
    double rim = vx;
    if (geometry.steered[i]) {
      const double sign = vx < 0.0 ? -1.0 : 1.0;
      steer = std::atan2(sign * vy, sign * vx);
      rim = sign * std::hypot(vx, vy);
    }
    command.steer_rad[i] = steer;
    command.rate_rad_s[i] = rim / params.geometry.wheel_radius_m;
  }
  return command;
}

inline terrain::Terrain FlatTerrain(std::vector<terrain::Rock> rocks = {},
                                    std::vector<terrain::Wall> walls = {}) {
  return {terrain::Ground(), std::move(rocks), std::move(walls)};
}

inline terrain::Terrain SlopeTerrain(double slope_rad, double direction_rad) {
  terrain::GroundParams params;
  params.slope_rad = slope_rad;
  params.slope_direction_rad = direction_rad;
  return {terrain::Ground(params, {}), {}, {}};
}

// An ellipsoid with its centre at the given height.
inline terrain::Rock MakeRock(double x_m, double y_m, double center_z_m, double a_m, double b_m,
                              double c_m) {
  terrain::Rock rock;
  rock.center_W = math::Vector3(x_m, y_m, center_z_m);
  rock.semi_axes_m = math::Vector3(a_m, b_m, c_m);
  rock.diameter_m = 2.0 * a_m;
  rock.height_m = center_z_m + c_m;
  return rock;
}

inline void RunFor(Rover& rover, const messages::WheelCommand& command, double time_s) {
  const int steps = static_cast<int>(std::lround(time_s / rover.step_s()));
  for (int i = 0; i < steps; ++i) rover.Step(command);
}

}  // namespace rockyard::rover
