// What a part of the ground that is no plane adds to it.
#pragma once

namespace rockyard::terrain {

// Height and slopes at one point.
struct ReliefSample {
  double height_m = 0.0;
  double slope_x = 0.0;  // dz/dx
  double slope_y = 0.0;  // dz/dy
};

}  // namespace rockyard::terrain
