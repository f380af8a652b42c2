// The best way to a goal among rocks that somebody knows: an oracle, or operators with a map; never
// on-board code. Told routes are planned by it (goal_designation.h), and the path of rendered
// sequences for visual odometry. Records of drives with a told route depend on its cells, ties and
// demands; it draws no random numbers, and the order of rocks does not matter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "messages/estimates.h"
#include "terrain/arena.h"
#include "terrain/rock.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

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

  // Returns whether a straight way leads over free cells only, as tested every half cell.
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

// Returns the shortest path from the start of the course to `goal` among `rocks` on a grid (A*,
// eight neighbours; Hart, Nilsson and Raphael 1968), with its corners pulled straight. It is the
// path of the first of these demands that has one:
//
//   |   | rocks that it keeps clear of | by, from the rover's centre                           |
//   | 1 | of low_rock_m and higher     | half its diagonal and margin_m: it may turn anywhere  |
//   | 2 | of low_rock_m and higher     | half its width and margin_m: it may touch as it turns |
//   | 3 | belly_clearance_m and higher | as 1                                                  |
//   | 4 | belly_clearance_m and higher | as 2                                                  |
//   | 5 | belly_clearance_m and higher | half its width                                        |
//   | 6 | belly_clearance_m and higher | that to the middle of its wheels, which climb flanks  |
//
// The last corner is the goal itself, as messages::Route asks. The route is empty where there is no
// path: no path selection could help the rover, as far as this grid tells. Outlines are ellipses,
// their half axes lengthened by the room that is kept (the true parallel curve lies up to 1 cm
// further out). The way stays inside the arena: a way across a mirror line has another inside the
// lines that is as long. Limits: rocks only, no slopes; rocks that the rover pushes are taken as
// fixed. It draws no random numbers. Cost: 1 to 3 ms for the nominal arena, 10 ms among the rocks
// of VL-2.
messages::Route PlanRoute(const DriveParams& drive, std::span<const terrain::Rock> rocks,
                          const messages::Goal& goal);

}  // namespace rockyard::trial
