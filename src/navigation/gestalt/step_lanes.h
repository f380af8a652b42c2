// Steps of the patches of a row of GESTALT's map from their planes, side by side. Each operation
// rounds as its scalar form does and none is fused, so that maps are the same on every processor.
#pragma once

#include <array>
#include <cstddef>

namespace rockyard::navigation {

// A row of patches of `columns` by `rows` cells, each a cell to the right of the one before.
struct PatchRow {
  // The means of cells, x, y and z, from the first cell of the first patch on, in rows of `stride`
  // cells; not a number where a cell has no data. Vectors read 8 more.
  std::array<const double*, 3> means_m;
  std::size_t stride;
  std::size_t columns;
  std::size_t rows;
  // dz/dx and dz/dy of the patches' planes, with room for 8 more.
  const double* rise_x;
  const double* rise_y;
};

// Writes the largest difference of elevation above its plane in each of `count` patches, m; 0 where
// no two cells have data. `steps_m` has room for 8 more.
void FindSteps(const PatchRow& row, std::size_t count, double* steps_m);

}  // namespace rockyard::navigation
