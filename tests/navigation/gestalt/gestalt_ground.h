// Ground for the benchmark of GESTALT.
#pragma once

#include <cmath>

#include "core/distributions.h"
#include "core/random.h"
#include "navigation/gestalt/map.h"

namespace rockyard::navigation {

inline constexpr double kSide_m = 9.0;

// Table 1 on a grid of that side, in which nothing is too far.
inline GestaltMapParams Params(double cell_m) {
  GestaltMapParams params;
  params.grid = {0.0, 0.0, kSide_m, kSide_m, cell_m, cell_m};
  params.grid_dist_timeout_m = 100.0;
  return params;
}

// Rolling ground with blocks and centimetres of noise; four points for every cell of 10 cm.
inline messages::PointCloud Ground() {
  core::RandomStream stream({41, 0}, core::Purpose::kTest, 1);
  messages::PointCloud cloud;
  for (double x = -4.975; x < 5.0; x += 0.05) {
    for (double y = -4.975; y < 5.0; y += 0.05) {
      const bool rock = std::sin(3.1 * x) * std::sin(2.3 * y + x) > 0.93;
      const double noise = core::SampleUniform(stream, -0.02, 0.02);
      cloud.points_R.push_back({x, y, 0.03 * std::sin(x + y) + (rock ? 0.18 : 0.0) + noise});
    }
  }
  return cloud;
}

struct Cells {
  CellWindow window;
  CellBox box;
};

// All cells of the grid, filled with the ground.
inline Cells FilledCells(const GestaltMapParams& params) {
  Cells cells{CellWindow(params.grid.nx(), params.grid.ny()), {}};
  cells.box = {0, params.grid.nx(), 0, params.grid.ny()};
  for (const math::Vector3& p : Ground().points_R) {
    const auto ix = static_cast<int>(std::floor((p.x() + 0.5 * kSide_m) / params.grid.xstep_m));
    const auto iy = static_cast<int>(std::floor((p.y() + 0.5 * kSide_m) / params.grid.ystep_m));
    if (ix < 0 || iy < 0 || ix >= params.grid.nx() || iy >= params.grid.ny()) continue;
    cells.window.At(ix, iy).moments.AddPoint(math::ToMomentUnits(p.x()), math::ToMomentUnits(p.y()),
                                             math::ToMomentUnits(p.z()));
  }
  return cells;
}

}  // namespace rockyard::navigation
