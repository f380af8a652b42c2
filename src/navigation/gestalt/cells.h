// What the map of GESTALT holds of each cell, in memory that wraps around. The map writes it;
// planes and steps of patches read it. No record depends on where a cell lies in memory, which
// wraps so that a window that moves copies nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/point_moments.h"
#include "navigation/gestalt/goodness_grid.h"

namespace rockyard::navigation {

// All that the map keeps of a cell.
struct MapCell {
  math::PointMoments moments;   // of its points, in the map's frame
  std::int64_t last_cycle = 0;  // in which it got data
  bool marked = false;          // the rover felt an obstacle here

  bool empty() const { return moments.empty() && !marked; }
};

// A box of cells: columns [x, x_end) and rows [y, y_end).
struct CellBox {
  int x = 0, x_end = 0, y = 0, y_end = 0;

  bool empty() const { return x >= x_end || y >= y_end; }
  // Returns the box with a margin, cut to nx by ny cells.
  CellBox Grown(int margin_x, int margin_y, int nx, int ny) const {
    return {x > margin_x ? x - margin_x : 0, x_end + margin_x < nx ? x_end + margin_x : nx,
            y > margin_y ? y - margin_y : 0, y_end + margin_y < ny ? y_end + margin_y : ny};
  }
};

// A window of nx by ny cells onto an endless lattice: cell (i, j) of the lattice lies in slot
// (i mod nx, j mod ny), so that a window that moves keeps what stays in it where it is.
class CellWindow {
 public:
  CellWindow(int nx, int ny) : nx_(nx), ny_(ny), slots_(CellIndex(0, ny, nx)) {}

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  // The lattice numbers of the window's first column and row.
  std::int64_t first_x() const { return first_x_; }
  std::int64_t first_y() const { return first_y_; }

  // Returns the cell in column ix and row iy of the window.
  MapCell& At(int ix, int iy) { return slots_[Slot(ix, iy)]; }
  const MapCell& At(int ix, int iy) const { return slots_[Slot(ix, iy)]; }

  // Returns the cell in a slot: row times nx plus column of the slot. The window's first column is
  // in slot column wrap_x, its first row in slot row wrap_y.
  MapCell& InSlot(std::size_t slot) { return slots_[slot]; }
  int wrap_x() const { return wrap_x_; }
  int wrap_y() const { return wrap_y_; }

  // Moves the window. Slots of cells that go out hold the cells that come in: the caller empties
  // them first.
  void MoveTo(std::int64_t first_x, std::int64_t first_y) {
    first_x_ = first_x;
    first_y_ = first_y;
    wrap_x_ = Modulo(first_x, nx_);
    wrap_y_ = Modulo(first_y, ny_);
  }

 private:
  static int Modulo(std::int64_t value, int divisor) {
    const auto rest = static_cast<int>(value % divisor);
    return rest < 0 ? rest + divisor : rest;
  }
  std::size_t Slot(int ix, int iy) const {
    const int column = ix + wrap_x_ < nx_ ? ix + wrap_x_ : ix + wrap_x_ - nx_;
    const int row = iy + wrap_y_ < ny_ ? iy + wrap_y_ : iy + wrap_y_ - ny_;
    return CellIndex(column, row, nx_);
  }

  int nx_;
  int ny_;
  std::int64_t first_x_ = 0;
  std::int64_t first_y_ = 0;
  int wrap_x_ = 0;
  int wrap_y_ = 0;
  std::vector<MapCell> slots_;
};

}  // namespace rockyard::navigation
