// The local map of GESTALT: range points in, goodness and certainty out (Goldberg 2002, section 4,
// steps 1 to 3). Evaluation keeps one; felt hazards mark it. Records depend on every goodness;
// map_differential_test.cc holds it to a plain reference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/pose.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "navigation/gestalt/cells.h"
#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/map_params.h"
#include "navigation/gestalt/planes.h"
#include "navigation/gestalt/point_sieve.h"
#include "navigation/gestalt/traversability.h"

namespace rockyard::navigation {

// A grid with a fixed memory that wraps around the vehicle (Howard 2012, section 2). Frame:
// that of the odometry (O of gestalt.h), which a correction of the estimate does not move, so that
// the map stays where it was put; it is the world as estimated until the first correction.
//
// Deviations from the paper. The ten floats of a cell are whole numbers of micrometres here, so
// that what a map holds does not depend on the order of its points, on the window or on the
// distance from the origin. The bounds x0..xN give the size of the window and the phase of its
// cells; the window follows the rover, as bounds that are fixed would end every drive after 10 m.
class GestaltMap {
 public:
  explicit GestaltMap(const GestaltMapParams& params);

  // Begins a navigation cycle with the rover at (x, y), which must be finite: moves the window by
  // whole cells so that the rover is in its middle one (the upper of two), and throws out cells
  // that leave the window, whose centre is farther than grid_dist_timeout_m, or that got no data
  // for more than max_idles cycles. Cost: O(cells).
  void BeginCycle(double x_m, double y_m);

  // Takes the points of a cloud, seen from X_WR as estimated, in any number of clouds a cycle. Left
  // out are points that are not finite, outside the window, in cells whose centre is farther than
  // grid_dist_timeout_m from the rover of BeginCycle, or more than 10 m above or below R. Left out,
  // too, are points beyond the 65536th of a cell, up to which its sums are exact if its points span
  // less than 23 m of height: 20 m where R stays at its height.
  void Add(const messages::PointCloud& cloud, const math::Transform& X_WR);

  // Marks what the rover felt: every patch that holds the cell at (x, y), or a cell whose centre
  // lies within `radius_m` of (x, y), becomes a step obstacle. Marks age and are thrown out as data
  // are; new data keep them.
  void MarkObstacle(double x_m, double y_m, double radius_m);

  // Forgets everything but where the rover is.
  void Clear();

  // Returns goodness and certainty of every cell of the window. The reference stays valid, its
  // contents hold until the next call. Cost: O(cells), see the gestalt_benchmark.
  const GoodnessGrid& Evaluate();

  // Returns the cells as they are, with the goodness of the last Evaluate, for the view.
  messages::MapView View() const;

 private:
  struct LatticeCell {
    std::int64_t x;
    std::int64_t y;
  };

  LatticeCell LatticeAt(double x_m, double y_m) const;
  // Return the centre of a column or row of the lattice, m.
  double CentreX_m(std::int64_t i) const;
  double CentreY_m(std::int64_t j) const;
  // Returns whether the centre of a cell lies within grid_dist_timeout_m of the rover.
  bool IsNear(int ix, int iy) const {
    return squares_x_m2_[static_cast<std::size_t>(ix)] +
               squares_y_m2_[static_cast<std::size_t>(iy)] <=
           params_.grid_dist_timeout_m * params_.grid_dist_timeout_m;
  }
  // Measures the distances for a window whose first cell is `first`.
  void MeasureDistances(LatticeCell first);
  // Empties what does not belong into a window whose first cell is `first`.
  void DropOldCells(LatticeCell first);
  // Returns which points the map takes, and where it puts them.
  PointSieve Sieve() const;
  void GrowBox(int ix, int iy);

  GestaltMapParams params_;
  CellWindow cells_;
  CellBox box_;  // of the window's cells that may hold something
  std::int64_t cycle_ = 0;
  double rover_x_m_ = 0.0;
  double rover_y_m_ = 0.0;
  std::vector<double> squares_x_m2_;  // of the distances of columns and rows from the rover
  std::vector<double> squares_y_m2_;
  PatchPlanes planes_;
  PatchSteps steps_;
  Traversability traversability_;
  GoodnessGrid grid_;
};

}  // namespace rockyard::navigation
