// Clothoids: paths whose curvature is linear in the distance driven.
#pragma once

#include <array>

#include "math/pose.h"
#include "messages/estimates.h"

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
// pieces over which the integrand hardly turns (clothoid.cc has the bounds). Cost: one sine and
// cosine if it turns by 1/8 rad or less, otherwise 13 a radian.
math::Pose2 AlongClothoid(const math::Pose2& from, double curvature_per_m, double rate_per_m2,
                          double length_m);

}  // namespace rockyard::navigation
