// Parameters of the speed at which a rover drives curves.
#pragma once

#include "core/fields.h"

namespace rockyard::navigation {

// Full speed up to one curvature, min_speed_share of it from another one on: "The maximum speed
// [...] was 7 cm/sec and is reduced only for high-curvature maneuvers" (Howard 2012, section 3).
struct SpeedLawParams {
  double full_speed_curvature_per_m = 0.5;
  double min_speed_share = 1.0;
  double slow_curvature_per_m = 1.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation
