// The work and the memory of placing rocks: both are counted, not timed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "terrain/rock_layout.h"

namespace rockyard::terrain {
namespace {

// Discs of 0.2 m on a lattice over the layout, so many per m2.
Placement Fill(const Rectangle& layout, double per_m2) {
  Placement placement(layout, {}, 0.0, std::nullopt);
  const double spacing_m = 1.0 / std::sqrt(per_m2);
  for (double x_m = layout.x_min_m; x_m < layout.x_max_m; x_m += spacing_m) {
    for (double y_m = layout.y_min_m; y_m < layout.y_max_m; y_m += spacing_m) {
      placement.Add({x_m, y_m, 0.1});
    }
  }
  return placement;
}

std::size_t MostInOneCell(const Placement& placement) {
  std::size_t most = 0;
  for (const auto& discs : placement.cells()) most = std::max(most, discs.size());
  return most;
}

// At two rocks per m2 a cell of half a metre meets those within 0.7 m along x and y: one or two.
TEST(PlacementWorkTest, WorkForOneRockDoesNotGrowWithTheLengthOfTheField) {
  for (const double length_m : {12.0, 100.0, 1000.0}) {
    const Placement placement = Fill({-2.0, length_m - 2.0, -6.0, 6.0}, 2.0);
    EXPECT_LE(MostInOneCell(placement), 2u) << length_m;
    EXPECT_LE(placement.cells().size(), 4.2 * 12.5 * length_m) << length_m;
  }
}

// A square kilometre has cells of 2 m instead of half a metre: at one rock in 40 m2, one in each.
TEST(PlacementWorkTest, CellsOfWideFieldsGrow) {
  const Placement placement = Fill({-500.0, 500.0, -500.0, 500.0}, 1.0 / 40.0);
  EXPECT_LE(placement.cells().size(), 252'000u);
  EXPECT_LE(MostInOneCell(placement), 1u);
}

}  // namespace
}  // namespace rockyard::terrain
