// Parameters of the splines among which a rover that steers while it drives chooses (Howard 2012,
// sections 2 and 3).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::navigation {

// Full speed up to one curvature, min_speed_share of it from another one on: "The maximum speed
// [...] was 7 cm/sec and is reduced only for high-curvature maneuvers" (Howard 2012, section 3). By
// default curves are driven as fast as straight lines.
struct SpeedLawParams {
  double full_speed_curvature_per_m = 0.5;
  double min_speed_share = 1.0;
  double slow_curvature_per_m = 1.0;

  void Visit(core::FieldVisitor& v);
};

// In what the curvature between two knots is linear: "Clothoid trajectories are motions whose
// curvature varies linearly with distance or time" (Howard 2012, section 2). The two are the same
// at constant speed.
enum class SplineLaw {
  kDistance,
  kTime,  // at the speed of the speed law
};

// Knots of either kind are spaced evenly from -max_curvature to +max_curvature.
struct GestaltSplineParams {
  double length_m = 3.0;
  std::int64_t num_first_knots = 15;
  std::int64_t num_second_knots = 15;
  double max_curvature_per_m = 1.0;
  double max_curvature_rate_per_m_s = 0.45;
  SplineLaw law = SplineLaw::kDistance;
  double waypoint_m = 3.0;

  // |dc/ds| of a spline from one of the first knots' curvatures to the next.
  double LeastRate_per_m2() const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::SplineLaw> {
  static constexpr std::array<std::string_view, 2> kNames{"distance", "time"};
};
