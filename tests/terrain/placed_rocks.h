// Terrain with rocks where a test wants them.
#pragma once

#include <utility>

#include "terrain/terrain.h"

namespace rockyard::terrain {

inline Rock EllipsoidRock(double x_m, double y_m, double z_m, double a_m, double b_m, double c_m,
                          double yaw_rad = 0.0) {
  return Rock{.center_W = {x_m, y_m, z_m},
              .semi_axes_m = {a_m, b_m, c_m},
              .yaw_rad = yaw_rad,
              .diameter_m = 2.0 * a_m,
              .height_m = z_m + c_m};
}

inline Terrain FlatWith(std::vector<Rock> rocks, std::vector<Wall> walls = {}) {
  return {Ground(), std::move(rocks), std::move(walls)};
}

}  // namespace rockyard::terrain
