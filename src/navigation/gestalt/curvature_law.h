// Clothoids: paths whose curvature is linear in the distance driven.
#pragma once

#include <array>
#include <vector>

#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "navigation/gestalt/gestalt_params.h"

namespace rockyard::navigation {

// Nodes of Gauss-Legendre quadrature over [-1, 1]: -place and +place, each with the weight.
struct GaussPair {
  double place;
  double weight;
};

// n = 8 (Abramowitz and Stegun 1964, table 25.4).
inline constexpr std::array<GaussPair, 4> kEightNodes{{{0.1834346424956498, 0.3626837833783620},
                                                       {0.5255324099163290, 0.3137066458778873},
                                                       {0.7966664774136267, 0.2223810344533745},
                                                       {0.9602898564975363, 0.1012285362903763}}};

// The planar part of an estimate. A path begins there; the headings of its later poses hold all
// that it has turned and are not wrapped.
inline math::Pose2 Planar(const messages::PoseEstimate& estimate) {
  return {estimate.x_m, estimate.y_m, estimate.heading_rad};
}

// Returns the place after length_m >= 0 on the clothoid of curvature c + c' s that begins at
// `from`; where that is the origin along x
//   theta(s) = c s + c' s^2 / 2,  x = int_0^s cos theta,  y = int_0^s sin theta,
// of which arcs (c' = 0) and straight lines (c = c' = 0) are cases like any other.
//
// Error of x and y: below 1e-12 m a metre of length, for any curvatures: the length is cut into
// pieces over which the integrand hardly turns (the source has the bounds). Cost: one sine and
// cosine if it turns by 1/8 rad or less, otherwise 13 a radian.
math::Pose2 AlongClothoid(const math::Pose2& from, double curvature_per_m, double rate_per_m2,
                          double length_m);

// How the curvature of a spline goes from one knot to the next: linearly with distance, or linearly
// with time at the speed of the speed law.

// Returns the share of the full speed, from min_speed_share to 1, at the curvature c of either
// sign:
//   1 up to c_full, 1 - (1 - p_min) (|c| - c_full) / (c_slow - c_full) up to c_slow, p_min beyond.
double SpeedShare(const SpeedLawParams& params, double curvature_per_m);

// With p(c) the share of full speed v at curvature c, curvature that is linear in time has
//   ds/dt = v p(c),  dc/dt constant  =>  p(c) dc = const ds,
// so that F(c) = int_0^c p is linear in the distance. F is odd and grows: c in gentle curves,
// linear in the tightest ones, a parabola in between. With curvature linear in the distance F(c) is
// c itself, which is also what p = 1 gives.
//
// Votes judge the paths of splines by it, and the manoeuvre steers by it. The two must be one law
// with one set of parameters, or the rover would drive over other ground than was judged.
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

  // Returns where the path from one curvature to the other ends that begins at `from`. Both are
  // those of knots, or of places between two knots. With kTime the part on which F is a parabola is
  // integrated over pieces short enough for an error of x and y below 1e-12 m a metre, as that of
  // clothoids.
  math::Pose2 Along(const math::Pose2& from, double from_per_m, double to_per_m,
                    double length_m) const;

 private:
  double Integral(double curvature_per_m) const;    // F
  double CurvatureOf(double integral_per_m) const;  // of F, the inverse
  double MeanCurvature(double from_per_m, double to_per_m) const;
  double NextEdge(double from_per_m, double to_per_m) const;
  // Between two edges.
  math::Pose2 AlongPiece(const math::Pose2& from, double from_per_m, double to_per_m,
                         double length_m) const;
  // Where the speed falls or rises all the way, within a turn of 1 rad.
  math::Pose2 AlongSlowing(const math::Pose2& from, double from_per_m, double to_per_m,
                           double length_m) const;

  SplineLaw law_;
  SpeedLawParams speed_;
  double slope_m_ = 0.0;        // -dp/d|c| where the share falls
  double slow_integral_ = 0.0;  // F at slow_curvature
  std::vector<double> edges_;   // curvatures between which a path is all of one kind, ascending
};

using messages::Spline;

// Returns the curvature, 1/m, after driven_m: that of the start before it, and that of the second
// knot beyond the end.
double CurvatureAt(const Spline& spline, double driven_m, const CurvatureLaw& law);

// Returns what it grows by with each metre, 1/m2; where it has a corner, what it grows by from
// there on. 0 before the start and beyond the end.
double CurvatureRateAt(const Spline& spline, double driven_m, const CurvatureLaw& law);

// Returns the place after to_m >= from_m of a spline that has led to `from` after from_m >= 0.
// Errors: those of CurvatureLaw::Along.
math::Pose2 AlongSpline(const math::Pose2& from, const Spline& spline, double from_m, double to_m,
                        const CurvatureLaw& law);

}  // namespace rockyard::navigation
