// Where a cell of a grid is kept.
#pragma once

#include <cstddef>

namespace rockyard::navigation {

// Returns the place of cell (ix, iy) in a grid that is `width` cells wide, row by row.
inline std::size_t CellIndex(int ix, int iy, int width) {
  return static_cast<std::size_t>(iy) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(ix);
}

}  // namespace rockyard::navigation
