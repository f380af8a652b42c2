#include "navigation/gestalt/clothoid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/check.h"
#include "navigation/gestalt/gauss_nodes.h"

namespace rockyard::navigation {
namespace {

// How far a piece of length l may turn, tau = max(|c| l, sqrt(|c'|) l). With n nodes the error of
// the quadrature of f = e^(i theta) is at most
//   l (n!)^4 / ((2n + 1) ((2n)!)^3) max |f^(2n)| l^(2n)   (Abramowitz and Stegun 1964, 25.4.30),
// and |f^(m)| l^m <= I_m tau^m, with I_m = sum_j m! / (j! (m - 2j)! 2^j) the terms of the m-th
// derivative, 764 for m = 8 and 46206736 for m = 16. That is 3e-14 l with 4 nodes at 1/8, and
// 8e-16 l with 8 nodes at 1.
constexpr double kTurnOfFour_rad = 0.125;
constexpr double kTurnOfEight_rad = 1.0;

// A piece of a clothoid about its middle: theta(u) = theta_m + c_m u + c' u^2 / 2, |u| <= l / 2.
struct Piece {
  double heading_rad;
  double curvature_per_m;
  double rate_per_m2;
  double half_m;
};

// Adds int e^(i theta) du over the piece. The nodes u and -u together are
//   e^(i theta_m) 2 cos(c_m u) e^(i c' u^2 / 2).
template <std::size_t kPairs>
void AddPiece(const Piece& piece, const std::array<GaussPair, kPairs>& pairs,
              ClothoidPoint& point) {
  double along_m = 0.0;
  double across_m = 0.0;
  for (const GaussPair& pair : pairs) {
    const double u_m = pair.place * piece.half_m;
    const double weight_m =
        2.0 * pair.weight * piece.half_m * std::cos(piece.curvature_per_m * u_m);
    const double bend_rad = 0.5 * piece.rate_per_m2 * u_m * u_m;
    along_m += weight_m * std::cos(bend_rad);
    across_m += weight_m * std::sin(bend_rad);
  }
  const double cosine = std::cos(piece.heading_rad);
  const double sine = std::sin(piece.heading_rad);
  point.x_m += cosine * along_m - sine * across_m;
  point.y_m += sine * along_m + cosine * across_m;
}

}  // namespace

ClothoidPoint OnClothoid(double curvature_per_m, double rate_per_m2, double length_m) {
  EXPECT(length_m >= 0.0);
  const double end_per_m = curvature_per_m + rate_per_m2 * length_m;
  const double turn_rad =
      length_m * std::max({std::abs(curvature_per_m), std::abs(end_per_m),
                           std::sqrt(std::abs(rate_per_m2))});
  const double pieces = std::max(1.0, std::ceil(turn_rad / kTurnOfEight_rad));
  const double piece_m = length_m / pieces;
  ClothoidPoint point;
  for (double k = 0.0; k < pieces; ++k) {
    // theta(s) = c s + c' s^2 / 2 and c(s) = c + c' s at the middle of the piece.
    const double middle_m = (k + 0.5) * piece_m;
    const Piece piece{middle_m * (curvature_per_m + 0.5 * rate_per_m2 * middle_m),
                      curvature_per_m + rate_per_m2 * middle_m, rate_per_m2, 0.5 * piece_m};
    if (turn_rad <= kTurnOfFour_rad) {
      AddPiece(piece, kFourNodes, point);
    } else {
      AddPiece(piece, kEightNodes, point);
    }
  }
  point.heading_rad = length_m * (curvature_per_m + 0.5 * rate_per_m2 * length_m);
  return point;
}

ClothoidPoint Joined(const ClothoidPoint& first, const ClothoidPoint& second) {
  const double cosine = std::cos(first.heading_rad);
  const double sine = std::sin(first.heading_rad);
  return {first.x_m + cosine * second.x_m - sine * second.y_m,
          first.y_m + sine * second.x_m + cosine * second.y_m,
          first.heading_rad + second.heading_rad};
}

}  // namespace rockyard::navigation
