// Terrain with rocks where a test wants them.
#pragma once

#include <utility>
#include <vector>

#include "terrain/terrain.h"

namespace rockyard::terrain {

inline Rock EllipsoidRock(double x_m, double y_m, double z_m, double a_m, double b_m, double c_m,
                          double yaw_rad = 0.0) {
  Rock rock;
  rock.center_W = {x_m, y_m, z_m};
  rock.semi_axes_m = {a_m, b_m, c_m};
  rock.yaw_rad = yaw_rad;
  rock.diameter_m = 2.0 * a_m;
  rock.height_m = z_m + c_m;
  return rock;
}

inline Terrain FlatWith(std::vector<Rock> rocks, std::vector<Wall> walls = {}) {
  return {Ground(), std::move(rocks), std::move(walls)};
}

}  // namespace rockyard::terrain
