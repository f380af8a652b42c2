#include "navigation/gestalt/speed_law.h"

#include <algorithm>
#include <cmath>

namespace rockyard::navigation {

double SpeedShare(const SpeedLawParams& params, double curvature_per_m) {
  // How much of the way from the one curvature to the other.
  const double way = (std::abs(curvature_per_m) - params.full_speed_curvature_per_m) /
                     (params.slow_curvature_per_m - params.full_speed_curvature_per_m);
  return 1.0 - (1.0 - params.min_speed_share) * std::clamp(way, 0.0, 1.0);
}

}  // namespace rockyard::navigation
