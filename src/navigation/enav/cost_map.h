// The cost map of ENav: coarser and larger than the height map, what a metre of each cell costs,
// and what the way from each cell to the goal costs (Dijkstra). Costs are times, s.
//
// A metre of a cell takes, with the time t of a metre of flat ground,
//   t (1 + w_t tilt / extreme_tilt + w_r r^2 / c0^2)
// by the plane through the points around the cell, r^2 the mean square of their distances from it
// and c0 the belly's clearance. It cannot be crossed where tilt is extreme or the fit failed.
#pragma once

#include <vector>

#include "math/point_moments.h"
#include "math/pose.h"
#include "navigation/enav/enav_params.h"
#include "navigation/enav/grid.h"

namespace rockyard::navigation {

struct CostCell {
  math::PointMoments points;  // in a frame that lies on the cell's lower corner
  double cost_s_per_m = 0.0;
  double to_go_s = 0.0;
};

class CostMap {
 public:
  // `speed_m_s` is the rover's on flat ground, clearance_m that of its belly there.
  CostMap(const EnavMapParams& params, double speed_m_s, double clearance_m);

  void Follow(double x_m, double y_m) { grid_.Follow(x_m, y_m); }
  // Adds a point of the map's frame; one outside of the window is left out.
  void Add(const math::Vector3& point);
  // Works out all costs anew.
  void Update(double goal_x_m, double goal_y_m);

  // Return what the last Update found. Outside of the window ground is unseen. ToGo_s is linear
  // between the middles of cells.
  double Cost_s_per_m(double x_m, double y_m) const;
  double ToGo_s(double x_m, double y_m) const;
  double FlatCost_s_per_m() const { return flat_s_per_m_; }

 private:
  void Judge(const LatticeCell& at);
  void Dijkstra(double goal_x_m, double goal_y_m);
  double Beyond_s(double x_m, double y_m) const;

  EnavMapParams params_;
  double flat_s_per_m_;
  double clearance_m_;
  double goal_x_m_ = 0.0;
  double goal_y_m_ = 0.0;
  RoverGrid<CostCell> grid_;
};

}  // namespace rockyard::navigation
