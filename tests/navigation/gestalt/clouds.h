// Point clouds on made-up ground, for maps that can be checked by hand.
#pragma once

#include <functional>

#include "math/pose.h"
#include "messages/point_cloud.h"
#include "navigation/gestalt/map.h"

namespace rockyard::navigation {

using Height = std::function<double(double x_m, double y_m)>;

inline double Level(double, double) { return 0.0; }

// A window of 21 x 21 cells of 20 cm around a rover in the middle of cell (10, 10), in which
// nothing is too far. With the vehicle of table 1 a patch has 5 x 5 cells; h = 20 cm.
inline GestaltMapParams HandParams() {
  GestaltMapParams params;
  params.grid.xN_m = 4.2;
  params.grid.yN_m = 4.2;
  params.grid_dist_timeout_m = 100.0;
  return params;
}

inline constexpr double kHandRover_m = 0.1;

// Coordinate of the lower corner of column or row i of that window.
inline double Edge(int i) { return 0.2 * (i - 10); }

// Points 10 cm apart, four in each cell of the columns [x, x_end) and rows [y, y_end) of the
// window: at 5 and 15 cm, so that none lies on an edge.
inline messages::PointCloud PointsOn(const CellBox& cells, const Height& height) {
  messages::PointCloud cloud;
  for (int i = 2 * (cells.x - 10); i < 2 * (cells.x_end - 10); ++i) {
    for (int j = 2 * (cells.y - 10); j < 2 * (cells.y_end - 10); ++j) {
      const double x = 0.1 * i + 0.05;
      const double y = 0.1 * j + 0.05;
      cloud.points_R.push_back({x, y, height(x, y)});
    }
  }
  return cloud;
}

inline constexpr CellBox kWholeWindow{0, 21, 0, 21};

inline GestaltMap MapOf(const GestaltMapParams& params, const messages::PointCloud& cloud) {
  GestaltMap map(params);
  map.BeginCycle(kHandRover_m, kHandRover_m);
  map.Add(cloud, math::Transform::Identity());
  return map;
}

// Goodness of all cells of the hand-checked window with `height` seen everywhere.
inline GoodnessGrid GridOf(const GestaltMapParams& params, const Height& height) {
  return MapOf(params, PointsOn(kWholeWindow, height)).Evaluate();
}

}  // namespace rockyard::navigation
