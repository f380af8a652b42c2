#include "navigation/gestalt/clothoid.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace rockyard::navigation {
namespace {

// A piece of a clothoid about its middle: theta(u) = theta_m + c_m u + c' u^2 / 2, |u| <= l / 2.
struct Piece {
  double heading_rad;
  double curvature_per_m;
  double rate_per_m2;
  double half_m;
};

// A chord in the frame that has its x along the heading in the middle of a piece.
struct Chord {
  double along_m;
  double across_m;
};

// How far pieces may turn, tau = max(|c|, sqrt(|c'|)) l, for either way to integrate them.
constexpr double kTurnOfSeries_rad = 0.125;
constexpr double kTurnOfQuadrature_rad = 1.0;

// With u = t l / 2, a = c_m l / 2 and b = c' l^2 / 8 the chord is
//   l / 2 int_-1^1 cos(a t) e^(i b t^2) dt,
// as what is odd in t vanishes; |a| <= tau / 2 and |b| <= tau^2 / 8. The series of both factors,
// integrated term by term. The largest terms left out, up to tau = 1/8: a^4 b^2 / 432 and b^4 / 216
// along, a^2 b^3 / 108 across; 4e-13 l together.
Chord SeriesChord(const Piece& piece) {
  const double a = piece.curvature_per_m * piece.half_m;
  const double b = 0.5 * piece.rate_per_m2 * piece.half_m * piece.half_m;
  const double a2 = a * a;
  const double b2 = b * b;
  const double along =
      1.0 - a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0)) - b2 * (1.0 / 10.0 - a2 / 28.0);
  const double across = b * (1.0 / 3.0 - a2 / 10.0 + a2 * a2 / 168.0 - b2 / 42.0);
  return {2.0 * piece.half_m * along, 2.0 * piece.half_m * across};
}

// The same by quadrature with n = 8 nodes, -u and u at a time. Of f = e^(i theta) its error is at
// most
//   l (n!)^4 / ((2n + 1) ((2n)!)^3) max |f^(2n)| l^(2n)   (Abramowitz and Stegun 1964, 25.4.30),
// and |f^(16)| l^16 <= I tau^16, with I = sum_j 16! / (j! (16 - 2j)! 2^j) = 46206736 the terms of
// the derivative: 8e-16 l up to tau = 1.
Chord QuadratureChord(const Piece& piece) {
  Chord chord{0.0, 0.0};
  for (const GaussPair& pair : kEightNodes) {
    const double u_m = pair.place * piece.half_m;
    // e^(i c_m u) + e^(-i c_m u) = 2 cos(c_m u).
    const double weight_m =
        2.0 * pair.weight * piece.half_m * std::cos(piece.curvature_per_m * u_m);
    const double bend_rad = 0.5 * piece.rate_per_m2 * u_m * u_m;
    chord.along_m += weight_m * std::cos(bend_rad);
    chord.across_m += weight_m * std::sin(bend_rad);
  }
  return chord;
}

}  // namespace

math::Pose2 AlongClothoid(const math::Pose2& from, double curvature_per_m, double rate_per_m2,
                          double length_m) {
  EXPECT(length_m >= 0.0);
  const double end_per_m = curvature_per_m + rate_per_m2 * length_m;
  const double turn_rad = length_m * std::max(std::abs(curvature_per_m), std::abs(end_per_m));
  const double bend_rad = length_m * length_m * std::abs(rate_per_m2);
  const bool short_turn =
      turn_rad <= kTurnOfSeries_rad && bend_rad <= kTurnOfSeries_rad * kTurnOfSeries_rad;
  const double pieces = short_turn
                            ? 1.0
                            : std::max(1.0, std::ceil(std::max(turn_rad, std::sqrt(bend_rad)) /
                                                      kTurnOfQuadrature_rad));
  const double piece_m = length_m / pieces;
  math::Pose2 point = from;
  for (double k = 0.0; k < pieces; ++k) {
    // theta(s) = c s + c' s^2 / 2 and c(s) = c + c' s at the middle of the piece.
    const double middle_m = (k + 0.5) * piece_m;
    const Piece piece{
        from.heading_rad + middle_m * (curvature_per_m + 0.5 * rate_per_m2 * middle_m),
        curvature_per_m + rate_per_m2 * middle_m, rate_per_m2, 0.5 * piece_m};
    const Chord chord = short_turn ? SeriesChord(piece) : QuadratureChord(piece);
    const double cosine = std::cos(piece.heading_rad);
    const double sine = std::sin(piece.heading_rad);
    point.x_m += cosine * chord.along_m - sine * chord.across_m;
    point.y_m += sine * chord.along_m + cosine * chord.across_m;
  }
  point.heading_rad += length_m * (curvature_per_m + 0.5 * rate_per_m2 * length_m);
  return point;
}

}  // namespace rockyard::navigation
