// How the curvature of a spline goes from one knot to the next: linearly with distance, or linearly
// with time at the speed of the speed law.
#pragma once

#include <vector>

#include "navigation/gestalt/clothoid.h"
#include "navigation/gestalt/speed_law_params.h"
#include "navigation/gestalt/spline_params.h"

namespace rockyard::navigation {

// With p(c) the share of full speed v at curvature c, curvature that is linear in time has
//   ds/dt = v p(c),  dc/dt constant  =>  p(c) dc = const ds,
// so that F(c) = int_0^c p is linear in the distance. F is odd and grows: c in gentle curves,
// linear in the tightest ones, a parabola in between. With curvature linear in the distance F(c) is
// c itself, which is also what p = 1 gives.
//
// Knots stand at distances in both laws: `length_m` apart. Curvatures in 1/m, positive left.
class CurvatureLaw {
 public:
  CurvatureLaw(SplineLaw law, const SpeedLawParams& speed);

  // Returns the curvature where `share`, 0 to 1, of the way from knot to knot is driven.
  double Between(double from_per_m, double to_per_m, double share) const;

  // Returns dc/ds there, 1/m2.
  double RateBetween(double from_per_m, double to_per_m, double share, double length_m) const;

  // Returns the largest |dc/dt| between the knots, 1/(m s), for a rover at its share of the full
  // speed v: v |dc/ds| p(c), at the least |c| if curvature is linear in the distance; v |F(to) -
  // F(from)| / length all along if it is linear in time.
  double LargestRateInTime(double from_per_m, double to_per_m, double length_m,
                           double full_speed_m_s) const;

  // Returns where the path between two knots, or between two places between knots, ends. With kTime
  // the part on which F is a parabola is integrated over pieces short enough for an error of x and
  // y below 1e-12 m a metre (CurvatureLaw.PathsInTime... has the comparison).
  ClothoidPoint Path(double from_per_m, double to_per_m, double length_m) const;

 private:
  double Integral(double curvature_per_m) const;         // F
  double CurvatureOf(double integral_per_m) const;       // of F, the inverse
  double MeanCurvature(double from_per_m, double to_per_m) const;
  ClothoidPoint SmoothPath(double from_per_m, double to_per_m, double length_m) const;
  ClothoidPoint SlowingPath(double from_per_m, double to_per_m, double length_m) const;

  SplineLaw law_;
  SpeedLawParams speed_;
  double slope_m_ = 0.0;        // -dp/d|c| where the share falls
  double slow_integral_ = 0.0;  // F at slow_curvature
  std::vector<double> edges_;   // curvatures between which Path takes a step, ascending
};

}  // namespace rockyard::navigation
