// The way that is left to the goal from any place: the straight one, or the cheapest over what the
// rover has seen (remedies.cost_to_go). Evaluation plans it at each vote; votes by the way and
// turns in place ask it.
//
// Carsten, Rankin, Ferguson and Stentz 2007 ran Field D* beside GESTALT, whose cost from each arc's
// end replaced the vote for the goal. Here the same interpolated costs (Ferguson and Stentz 2005)
// are searched anew at each plan, from the goal on as Dijkstra's algorithm goes: a window of a
// hundred cells square is searched in milliseconds, so that nothing is repaired.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "messages/estimates.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/goodness_grid.h"

namespace rockyard::navigation {

// Returns the cost at a corner of a square cell whose sides of `side_m` cost side_cost altogether,
// from the costs at the next corner along a side and at the opposite one, of a path that crosses
// the two sides beyond in a straight line; between these two corners the cost is linear:
//   min over t in [0, 1] of (1 - t) next + t opposite + side_cost sqrt(1 + t^2)
//     = next                                    + side_cost,        d <= 0,
//     = next     + sqrt(side_cost^2 - d^2),                         0 < d < side_cost / sqrt(2),
//     = opposite + sqrt(2) side_cost                                beyond,    d = next - opposite
// (Ferguson and Stentz 2005, without paths that follow a side first and then cross).
double CrossingCost(double next, double opposite, double side_cost);

// Costs of cells in a window, and the cost to go at their corners. Costs are in metres of good
// ground.
struct CostField {
  double x0_m = 0.0;  // of the window's corner
  double y0_m = 0.0;
  double cell_m = 0.2;
  int nx = 0;  // cells
  int ny = 0;
  std::vector<double> cost_per_m;  // [iy][ix], above 0
  std::vector<double> to_go;       // of corners, [iy][ix], nx + 1 a row

  // Computes to_go. A goal outside the window is reached by its edge and straight on, at
  // `beyond_per_m`. Cost: O(n log n) of the cells.
  void Search(const messages::Goal& goal, double beyond_per_m);

  // Returns the cost to go from a place in the window, bilinear between the corners.
  double At(double column, double row) const;

  // Returns whether the way from a place in the window, after the last Search, leads from cells
  // that cost less than `cost` over others to such cells again.
  bool Crosses(double column, double row, double cost) const;
};

// Remembers what was seen around the rover, and searches the way. Invariant: cells are those of the
// map's lattice; a cell keeps the worst and the latest cost that was seen of it until it leaves the
// window.
class WayToGo {
 public:
  explicit WayToGo(const GestaltParams& params);

  // Remembers the grid, and searches the way of a rover at x, y to the goal.
  void Plan(const GoodnessGrid& grid, const messages::Goal& goal, double x_m, double y_m);
  void Forget() {
    worst_.clear();
    latest_.clear();
  }

  // Returns the way from a place to the goal of the last plan, m: in metres of good ground.
  double From_m(double x_m, double y_m) const;

 private:
  void Remember(const GoodnessGrid& grid);
  // Returns what is remembered of the cell, moved to where the window lies now.
  std::vector<double> Moved(const std::vector<double>& costs, std::int64_t first_x,
                            std::int64_t first_y) const;
  void Search(const std::vector<double>& costs);

  CostToGoParams params_;
  std::vector<double> cost_of_goodness_;  // a metre, by goodness
  int cells_;                             // of a side of the window
  double phase_x_m_ = 0.0;                // of the lattice
  double phase_y_m_ = 0.0;
  std::int64_t first_x_ = 0;  // lattice numbers of the window's first cell
  std::int64_t first_y_ = 0;
  // Costs of a metre, [iy][ix]; 0: never seen.
  std::vector<double> worst_;
  std::vector<double> latest_;
  CostField field_;
  messages::Goal goal_;
};

}  // namespace rockyard::navigation
