// Hand-made maps for the tests of GESTALT's votes.
#pragma once

#include <cmath>
#include <functional>

#include "messages/estimates.h"
#include "navigation/gestalt/goodness_grid.h"

namespace rockyard::navigation {

inline constexpr CellValue kGood{255, 255, true};
inline constexpr CellValue kObstacle{0, 255, true};
inline constexpr CellValue kUnknownCell{11, 0, false};  // Goldberg 2002, table 1

// A square window of cells centred on the origin, each with the value at its centre.
inline GoodnessGrid GridOf(const std::function<CellValue(double x_m, double y_m)>& value,
                           int cells = 50, double step_m = 0.2) {
  GoodnessGrid grid;
  grid.x0_m = grid.y0_m = -0.5 * cells * step_m;
  grid.xstep_m = grid.ystep_m = step_m;
  grid.nx = grid.ny = cells;
  grid.unknown = kUnknownCell;
  for (int iy = 0; iy < cells; ++iy) {
    for (int ix = 0; ix < cells; ++ix) {
      grid.cells.push_back(value(grid.x0_m + (ix + 0.5) * step_m, grid.y0_m + (iy + 0.5) * step_m));
    }
  }
  return grid;
}

inline GoodnessGrid UniformGrid(const CellValue& value) {
  return GridOf([value](double, double) { return value; });
}

// Good ground with a disc of obstacles.
inline GoodnessGrid GridWithDisc(double x_m, double y_m, double radius_m) {
  return GridOf([=](double x, double y) {
    return std::hypot(x - x_m, y - y_m) <= radius_m ? kObstacle : kGood;
  });
}

inline messages::PoseEstimate At(double x_m, double y_m, double heading_rad) {
  return {.x_m = x_m, .y_m = y_m, .heading_rad = heading_rad};
}

}  // namespace rockyard::navigation
