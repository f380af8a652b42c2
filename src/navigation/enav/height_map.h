// The map that ACE reads: mean heights of the points that fell into square cells.
#pragma once

#include <cstdint>

#include "navigation/enav/grid.h"

namespace rockyard::navigation {

// Points of one cell. A cell without points is unseen.
struct HeightCell {
  double sum_m = 0.0;
  std::int64_t points = 0;

  bool seen() const { return points > 0; }
  // Returns the mean height of its points, up.
  double Height_m() const { return sum_m / static_cast<double>(points); }
  void Add(double height_m) {
    sum_m += height_m;
    ++points;
  }
};

using HeightMap = RoverGrid<HeightCell>;

}  // namespace rockyard::navigation
