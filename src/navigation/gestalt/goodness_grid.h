// The seam between the map and the votes of GESTALT: goodness and certainty of every cell around
// the rover (Goldberg 2002, section 4). The map writes the grid; the votes on arcs and splines read
// it. Goodness and certainty have 8 bits: votes, and so records, depend on the rounding
// (traversability.cc).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rockyard::navigation {

// Returns the place of cell (ix, iy) in a grid that is `width` cells wide, row by row.
inline std::size_t CellIndex(int ix, int iy, int width) {
  return static_cast<std::size_t>(iy) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(ix);
}

// How safe it is for a rover centred at the cell (goodness), and how sure that is (certainty): 8
// bits each, 255 is best.
struct CellValue {
  std::uint8_t goodness = 0;
  std::uint8_t certainty = 0;
  bool known = false;  // false: not evaluated; goodness and certainty are those of unknown cells

  bool operator==(const CellValue&) const = default;
};

// A window of cells, aligned with the axes of the estimated world frame. Cell (ix, iy) covers
// [x0 + ix xstep, x0 + (ix + 1) xstep) and likewise in y.
struct GoodnessGrid {
  double x0_m = 0.0;
  double y0_m = 0.0;
  double xstep_m = 0.2;
  double ystep_m = 0.2;
  int nx = 0;
  int ny = 0;
  CellValue unknown;             // everything outside the window
  std::vector<CellValue> cells;  // [iy][ix]

  const CellValue& Cell(int ix, int iy) const { return cells[CellIndex(ix, iy, nx)]; }
  const CellValue& At(double x_m, double y_m) const {
    return AtCells((x_m - x0_m) / xstep_m, (y_m - y0_m) / ystep_m);
  }
  // Returns the value at a place that is told in cells from the window's corner. Written so that a
  // place that is not a number lies outside. The conversion to int drops the fraction, as the
  // values are not negative; std::floor would be a call.
  const CellValue& AtCells(double column, double row) const {
    if (!(column >= 0.0 && column < nx && row >= 0.0 && row < ny)) return unknown;
    return Cell(static_cast<int>(column), static_cast<int>(row));
  }
};

}  // namespace rockyard::navigation
