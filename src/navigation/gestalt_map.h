// The local map of GESTALT: range points in, goodness and certainty out (Goldberg 2002, section 4,
// steps 1 to 3).
#pragma once

#include "math/pose.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "navigation/gestalt_map_params.h"
#include "navigation/goodness_grid.h"

namespace rockyard::navigation {

class GestaltMap {
 public:
  explicit GestaltMap(const GestaltMapParams& params);

  // A new navigation cycle with the rover at (x, y) of the estimated world frame: moves the window
  // by whole cells so that the rover is in its middle, and throws out cells that leave it, that are
  // farther than grid_dist_timeout, or that got no data for more than max_idles cycles.
  void BeginCycle(double x_m, double y_m);

  // Takes the points of a cloud that lie in the window and within grid_dist_timeout. X_WR as
  // estimated. Any number of clouds a cycle.
  void Add(const messages::PointCloud& cloud, const math::Transform& X_WR);

  // What the rover felt: every patch that holds one of the cells within `radius_m` of (x, y), or
  // the cell there, becomes a step obstacle. Ages as data do.
  void MarkObstacle(double x_m, double y_m, double radius_m);

  // Forgets everything.
  void Clear();

  // Goodness and certainty of every cell of the window. The reference stays valid, and holds until
  // the next call.
  const GoodnessGrid& Evaluate();

  // The window as of the last Evaluate, for people.
  messages::MapView View() const;

 private:
  GestaltMapParams params_;
  GoodnessGrid grid_;
};

}  // namespace rockyard::navigation
