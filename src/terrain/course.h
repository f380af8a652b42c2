// Start and goal of a trial, as far as a terrain needs to know them.
#pragma once

namespace rockyard::terrain {

// The points are in W, m.
struct Course {
  double start_x_m = 0.0;
  double start_y_m = 0.0;
  double goal_x_m = 7.6;
  double goal_y_m = 0.0;
};

}  // namespace rockyard::terrain
