// Clothoids: paths whose curvature is linear in the distance driven.
#pragma once

namespace rockyard::navigation {

// Where a path has led to, in the frame in which it began at the origin along x; y is left.
struct ClothoidPoint {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;  // what it has turned, not wrapped
};

// Returns the place after length_m >= 0 on the clothoid of curvature c + c' s,
//   theta(s) = c s + c' s^2 / 2,  x = int_0^s cos theta,  y = int_0^s sin theta,
// of which arcs (c' = 0) and straight lines (c = c' = 0) are cases like any other.
//
// Error of x and y: below 1e-12 m a metre of length, for any curvatures: the length is cut into
// pieces over which the integrand hardly turns (GaussNodes in clothoid.cc has the bound). Cost:
// 4 sines and cosines a piece if that turns by 1/8 rad or less, otherwise 8 a radian; a length of
// 3 m within +-1 / m takes up to 4 pieces.
ClothoidPoint OnClothoid(double curvature_per_m, double rate_per_m2, double length_m);

// Returns `second`, which begins at the origin along x, moved to where `first` ends.
ClothoidPoint Joined(const ClothoidPoint& first, const ClothoidPoint& second);

}  // namespace rockyard::navigation
