// The grid on which ways among rocks are searched (route_planner.h), and the search. Records of
// drives with a told route depend on its cells and on how it decides between equal ways.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/functions.h"
#include "messages/estimates.h"
#include "terrain/arena.h"
#include "terrain/rock.h"

namespace rockyard::trial {

// The outline of a rock with half axes longer by room_m: where the rock is that near, as the true
// parallel curve lies up to 1 cm further out.
class WidenedOutline {
 public:
  WidenedOutline(const terrain::Rock& rock, double room_m);
  bool Holds(const messages::Goal& point) const;

 private:
  messages::Goal center_W_;
  double a_m_;
  double b_m_;
  math::SineCosine turn_;
};

// Returns the point of the straight way at a share of it, 0 to 1.
messages::Goal PointBetween(const messages::Goal& from, const messages::Goal& to, double share);

// Where the centre of a rover may be: cells of a rectangle, free or blocked. The centres of cells
// lie within the rectangle (unless it is narrower than half a cell); the last cells are longer or
// shorter than the others.
class FreeGrid {
 public:
  FreeGrid(const terrain::Rectangle& bounds, double cell_m);

  // Blocks the cells whose centres lie inside the rock's outline with half axes longer by room_m.
  void Block(const terrain::Rock& rock, double room_m);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  std::size_t size() const { return blocked_.size(); }
  bool IsFree(int ix, int iy) const {
    return ix >= 0 && ix < nx_ && iy >= 0 && iy < ny_ && blocked_[Index(ix, iy)] == 0;
  }
  bool IsFree(const messages::Goal& point) const {
    return IsFree(Column(point.x_m), Row(point.y_m));
  }
  std::size_t Index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(ix);
  }
  // Return column and row of the cell that holds a point, -1 or nx(), ny() beyond the grid.
  int Column(double x_m) const;
  int Row(double y_m) const;
  messages::Goal Centre(std::size_t index) const;

  // Returns in how many steps of at most half a cell a straight way is tested.
  int Steps(const messages::Goal& from, const messages::Goal& to) const;
  // Returns whether a straight way leads over free cells only, as tested step by step.
  bool IsClear(const messages::Goal& from, const messages::Goal& to) const;

 private:
  terrain::Rectangle bounds_;
  double cell_m_;
  int nx_;
  int ny_;
  std::vector<std::uint8_t> blocked_;
};

// Returns the cells of a shortest path between free cells, both ends included; empty where there is
// none. Moves lead to the eight neighbours, across a corner only where both cells beside it are
// free. Of equally short paths it always returns the same one.
std::vector<std::size_t> ShortestPath(const FreeGrid& grid, std::size_t from, std::size_t to);

}  // namespace rockyard::trial
