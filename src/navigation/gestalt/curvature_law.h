// Clothoids, paths whose curvature is linear in the distance driven; splines of them, and the law
// of curvature between their knots. The votes judge the paths of splines by it, the manoeuvre
// steers and predicts by it. Records of drives that plan on the move depend on the last bits:
// another quadrature changes them, even within the errors that are stated.
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

// The nodes for n = 8 (Abramowitz and Stegun 1964, table 25.4).
inline constexpr std::array<GaussPair, 4> kEightNodes{{{0.1834346424956498, 0.3626837833783620},
                                                       {0.5255324099163290, 0.3137066458778873},
                                                       {0.7966664774136267, 0.2223810344533745},
                                                       {0.9602898564975363, 0.1012285362903763}}};

// Returns the planar part of an estimate. A path begins there; the headings of its later poses hold
// all that it has turned and are not wrapped.
inline math::Pose2 Planar(const messages::PoseEstimate& estimate) {
  return {estimate.x_m, estimate.y_m, estimate.heading_rad};
}

// Returns the place after length_m >= 0 on the clothoid of curvature c + c' s that begins at
// `from`; from the origin along x it is
//   theta(s) = c s + c' s^2 / 2,  x = int_0^s cos theta,  y = int_0^s sin theta,
// of which arcs (c' = 0) and straight lines (c = c' = 0) are cases like any other.
//
// Error of x and y: below 1e-12 m a metre of length, for any curvatures: the length is cut into
// pieces over which the integrand hardly turns (the source has the bounds). Cost: one sine and
// cosine if it turns by 1/8 rad or less, otherwise 13 a radian.
math::Pose2 AlongClothoid(const math::Pose2& from, double curvature_per_m, double rate_per_m2,
                          double length_m);

// Returns the share p(c) of the full speed, from min_speed_share to 1, at the curvature c of either
// sign:
//   1 up to c_full, 1 - (1 - p_min) (|c| - c_full) / (c_slow - c_full) up to c_slow, p_min beyond.
double SpeedShare(const SpeedLawParams& params, double curvature_per_m);

// How the curvature of a spline goes from one knot to the next: linearly with distance, or linearly
// with time at the speed of the speed law. With p = SpeedShare, curvature that is linear in time
// has
//   ds/dt = v p(c),  dc/dt constant  =>  p(c) dc = const ds,
// so that F(c) = int_0^c p is linear in the distance. F is odd and grows: c in gentle curves,
// linear in the tightest ones, a parabola in between. With curvature linear in the distance F(c) is
// c itself, which is also what p = 1 gives.
//
// Must stay: one law with one set of parameters for the votes (SplineVoter) and for the manoeuvre
// (Manoeuvre), or the rover would drive over other ground than was judged.
//
// In both laws a knot stands `length_m` from the one before. Curvatures in 1/m, positive left.
class CurvatureLaw {
 public:
  CurvatureLaw(SplineLaw law, const SpeedLawParams& speed);

  // Returns the curvature where `share`, 0 to 1, of the way from knot to knot is driven.
  double Between(double from_per_m, double to_per_m, double share) const;

  // Returns dc/ds at that place, 1/m2.
  double RateBetween(double from_per_m, double to_per_m, double share, double length_m) const;

  // Returns the largest |dc/dt| between the knots, 1/(m s), for a rover at its share of the full
  // speed v:
  //   v |dc/ds| p(c) at the least |c|        if curvature is linear in the distance,
  //   v |F(to) - F(from)| / length all along  if it is linear in time.
  double LargestRateInTime(double from_per_m, double to_per_m, double length_m,
                           double full_speed_m_s) const;

  // Returns where the path that begins at `from` ends, between the curvatures of two knots or of
  // two places between knots. With kTime the part on which F is a parabola is integrated over
  // pieces short enough for an error of x and y below 1e-12 m a metre, as that of clothoids.
  math::Pose2 Along(const math::Pose2& from, double from_per_m, double to_per_m,
                    double length_m) const;

 private:
  double Integral(double curvature_per_m) const;    // F
  double CurvatureOf(double integral_per_m) const;  // the inverse of F
  double MeanCurvature(double from_per_m, double to_per_m) const;
  double NextEdge(double from_per_m, double to_per_m) const;
  // Returns the end of a path between two neighbours of edges_.
  math::Pose2 AlongPiece(const math::Pose2& from, double from_per_m, double to_per_m,
                         double length_m) const;
  // Returns the end of a path on which the speed falls or rises all the way, within a turn of 1
  // rad.
  math::Pose2 AlongSlowing(const math::Pose2& from, double from_per_m, double to_per_m,
                           double length_m) const;

  SplineLaw law_;
  SpeedLawParams speed_;
  double slope_m_ = 0.0;        // -dp/d|c| where the share falls
  double slow_integral_ = 0.0;  // F at slow_curvature
  std::vector<double> edges_;   // curvatures between which a path is all of one kind, ascending
};

using messages::Spline;

// Returns the curvature of a spline, 1/m, after driven_m: that of its start before it, and that of
// its second knot beyond the end.
double CurvatureAt(const Spline& spline, double driven_m, const CurvatureLaw& law);

// Returns dc/ds of a spline after driven_m, 1/m2; at a knot that of the piece after it. 0 before
// the start and beyond the end.
double CurvatureRateAt(const Spline& spline, double driven_m, const CurvatureLaw& law);

// Returns the place after to_m >= from_m of a spline that has led to `from` after from_m >= 0.
// Errors: those of CurvatureLaw::Along.
math::Pose2 AlongSpline(const math::Pose2& from, const Spline& spline, double from_m, double to_m,
                        const CurvatureLaw& law);

}  // namespace rockyard::navigation
