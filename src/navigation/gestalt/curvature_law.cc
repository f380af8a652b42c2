#include "navigation/gestalt/curvature_law.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/check.h"
#include "math/functions.h"

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
// as what is odd in t vanishes; |a| <= tau / 2 and |b| <= tau^2 / 8. The series of both factors are
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

// The chord by quadrature with n = 8 nodes, -u and u at a time. With f = e^(i theta) the error is
// at most
//   l (n!)^4 / ((2n + 1) ((2n)!)^3) max |f^(2n)| l^(2n)   (Abramowitz and Stegun 1964, 25.4.30),
// and |f^(16)| l^16 <= I tau^16, with I = sum_j 16! / (j! (16 - 2j)! 2^j) = 46206736 the terms of
// the derivative: 8e-16 l up to tau = 1.
Chord QuadratureChord(const Piece& piece) {
  Chord chord{0.0, 0.0};
  for (const GaussPair& pair : kEightNodes) {
    const double u_m = pair.place * piece.half_m;
    // e^(i c_m u) + e^(-i c_m u) = 2 cos(c_m u).
    const double weight_m =
        2.0 * pair.weight * piece.half_m * math::Cos(piece.curvature_per_m * u_m);
    const double bend_rad = 0.5 * piece.rate_per_m2 * u_m * u_m;
    chord.along_m += weight_m * math::Cos(bend_rad);
    chord.across_m += weight_m * math::Sin(bend_rad);
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
    const auto [sine, cosine] = math::SinCos(piece.heading_rad);
    point.x_m += cosine * chord.along_m - sine * chord.across_m;
    point.y_m += sine * chord.along_m + cosine * chord.across_m;
  }
  point.heading_rad += length_m * (curvature_per_m + 0.5 * rate_per_m2 * length_m);
  return point;
}

double SpeedShare(const SpeedLawParams& params, double curvature_per_m) {
  // How far |c| is from the one curvature to the other.
  const double way = (std::abs(curvature_per_m) - params.full_speed_curvature_per_m) /
                     (params.slow_curvature_per_m - params.full_speed_curvature_per_m);
  return 1.0 - (1.0 - params.min_speed_share) * std::clamp(way, 0.0, 1.0);
}

namespace {

// Where the speed falls, a piece ends when the speed has fallen to this share of that at the
// piece's beginning. p^2 is linear in the distance there and c has a singularity at p = 0, which
// then lies 1.78 lengths of the piece beyond its end. Eight nodes converge as rho^-16 with rho = 9,
// to 5e-16.
constexpr double kSlowingOfPiece = 0.8;

// Largest turn of such a piece; as kTurnOfQuadrature_rad of clothoids.
constexpr double kTurnOfPiece_rad = 1.0;

}  // namespace

CurvatureLaw::CurvatureLaw(SplineLaw law, const SpeedLawParams& speed) : law_(law), speed_(speed) {
  const double full_per_m = speed.full_speed_curvature_per_m;
  const double slow_per_m = speed.slow_curvature_per_m;
  EXPECT(slow_per_m > full_per_m && speed.min_speed_share > 0.0);
  slope_m_ = (1.0 - speed.min_speed_share) / (slow_per_m - full_per_m);
  slow_integral_ = full_per_m + 0.5 * (1.0 + speed.min_speed_share) * (slow_per_m - full_per_m);
  // p = 0.8^k at c_full + (1 - p) / slope.
  for (double share = 1.0; share > speed.min_speed_share; share *= kSlowingOfPiece) {
    edges_.push_back(full_per_m + (1.0 - share) / slope_m_);
  }
  edges_.push_back(slow_per_m);
  const std::size_t count = edges_.size();
  for (std::size_t i = 0; i < count; ++i) edges_.push_back(-edges_[i]);
  std::sort(edges_.begin(), edges_.end());
}

double CurvatureLaw::Integral(double curvature_per_m) const {
  if (law_ == SplineLaw::kDistance) return curvature_per_m;
  const double size = std::abs(curvature_per_m);
  const double over = size - speed_.full_speed_curvature_per_m;
  double integral = size;
  if (size > speed_.slow_curvature_per_m) {
    integral = slow_integral_ + speed_.min_speed_share * (size - speed_.slow_curvature_per_m);
  } else if (over > 0.0) {
    integral -= 0.5 * slope_m_ * over * over;
  }
  return std::copysign(integral, curvature_per_m);
}

double CurvatureLaw::CurvatureOf(double integral_per_m) const {
  if (law_ == SplineLaw::kDistance) return integral_per_m;
  const double size = std::abs(integral_per_m);
  const double over = size - speed_.full_speed_curvature_per_m;
  double curvature = size;
  if (size > slow_integral_) {
    curvature = speed_.slow_curvature_per_m + (size - slow_integral_) / speed_.min_speed_share;
  } else if (over > 0.0) {
    // d - slope d^2 / 2 = F - c_full, solved for d = c - c_full so that no digits are lost.
    const double share = std::sqrt(1.0 - 2.0 * slope_m_ * over);
    curvature = speed_.full_speed_curvature_per_m + 2.0 * over / (1.0 + share);
  }
  return std::copysign(curvature, integral_per_m);
}

double CurvatureLaw::Between(double from_per_m, double to_per_m, double share) const {
  const double from = Integral(from_per_m);
  return CurvatureOf(from + share * (Integral(to_per_m) - from));
}

double CurvatureLaw::RateBetween(double from_per_m, double to_per_m, double share,
                                 double length_m) const {
  // dF/ds = F'(c) dc/ds.
  const double rate = (Integral(to_per_m) - Integral(from_per_m)) / length_m;
  if (law_ == SplineLaw::kDistance) return rate;
  return rate / SpeedShare(speed_, Between(from_per_m, to_per_m, share));
}

double CurvatureLaw::LargestRateInTime(double from_per_m, double to_per_m, double length_m,
                                       double full_speed_m_s) const {
  // v |dF/ds|.
  const double rate =
      full_speed_m_s * std::abs(Integral(to_per_m) - Integral(from_per_m)) / length_m;
  if (law_ == SplineLaw::kTime) return rate;
  const bool straight_between = from_per_m * to_per_m <= 0.0;
  const double gentlest =
      straight_between ? 0.0 : std::min(std::abs(from_per_m), std::abs(to_per_m));
  return rate * SpeedShare(speed_, gentlest);
}

double CurvatureLaw::MeanCurvature(double from_per_m, double to_per_m) const {
  // int c p dc / int p dc between two curvatures of one side where p falls, with d = |c| - c_full:
  //   c_full + ((d0 + d1) / 2 - slope (d0^2 + d0 d1 + d1^2) / 3) / (1 - slope (d0 + d1) / 2).
  const double full_per_m = speed_.full_speed_curvature_per_m;
  const double d0 = std::abs(from_per_m) - full_per_m;
  const double d1 = std::abs(to_per_m) - full_per_m;
  const double middle = 0.5 * (d0 + d1);
  const double over =
      (middle - slope_m_ * (d0 * d0 + d0 * d1 + d1 * d1) / 3.0) / (1.0 - slope_m_ * middle);
  return std::copysign(full_per_m + over, from_per_m + to_per_m);
}

double CurvatureLaw::NextEdge(double from_per_m, double to_per_m) const {
  if (to_per_m > from_per_m) {
    const auto above = std::upper_bound(edges_.begin(), edges_.end(), from_per_m);
    return above == edges_.end() ? to_per_m : std::min(*above, to_per_m);
  }
  const auto at_or_above = std::lower_bound(edges_.begin(), edges_.end(), from_per_m);
  return at_or_above == edges_.begin() ? to_per_m : std::max(*std::prev(at_or_above), to_per_m);
}

math::Pose2 CurvatureLaw::AlongSlowing(const math::Pose2& from, double from_per_m, double to_per_m,
                                       double length_m) const {
  math::Pose2 end = from;
  const double half_m = 0.5 * length_m;
  const auto add = [&](double s_m, double weight_m) {
    const double here = Between(from_per_m, to_per_m, s_m / length_m);
    // theta(s) = s times the mean of the curvature so far.
    const double heading_rad = from.heading_rad + s_m * MeanCurvature(from_per_m, here);
    end.x_m += weight_m * math::Cos(heading_rad);
    end.y_m += weight_m * math::Sin(heading_rad);
  };
  for (const GaussPair& pair : kEightNodes) {
    add(half_m * (1.0 - pair.place), half_m * pair.weight);
    add(half_m * (1.0 + pair.place), half_m * pair.weight);
  }
  end.heading_rad += length_m * MeanCurvature(from_per_m, to_per_m);
  return end;
}

math::Pose2 CurvatureLaw::AlongPiece(const math::Pose2& from, double from_per_m, double to_per_m,
                                     double length_m) const {
  const double middle = 0.5 * std::abs(from_per_m + to_per_m);
  const bool slowing =
      middle > speed_.full_speed_curvature_per_m && middle < speed_.slow_curvature_per_m;
  if (!slowing)
    return AlongClothoid(from, from_per_m, (to_per_m - from_per_m) / length_m, length_m);
  const double turn_rad = length_m * std::max(std::abs(from_per_m), std::abs(to_per_m));
  const double pieces = std::max(1.0, std::ceil(turn_rad / kTurnOfPiece_rad));
  math::Pose2 end = from;
  double begin = from_per_m;
  for (double k = 1.0; k <= pieces; ++k) {
    const double next = k < pieces ? Between(from_per_m, to_per_m, k / pieces) : to_per_m;
    end = AlongSlowing(end, begin, next, length_m / pieces);
    begin = next;
  }
  return end;
}

math::Pose2 CurvatureLaw::Along(const math::Pose2& from, double from_per_m, double to_per_m,
                                double length_m) const {
  EXPECT(length_m >= 0.0);
  if (length_m == 0.0) return from;
  const double whole = Integral(to_per_m) - Integral(from_per_m);
  // True also where a curvature is not a number.
  const bool steady = !(std::abs(whole) > 0.0);
  const bool clothoid = law_ == SplineLaw::kDistance || slope_m_ == 0.0 || steady;
  if (clothoid) {
    return AlongClothoid(from, from_per_m, (to_per_m - from_per_m) / length_m, length_m);
  }
  math::Pose2 end = from;
  double begin = from_per_m;
  while (begin != to_per_m) {
    const double next = NextEdge(begin, to_per_m);
    // F is linear in the distance.
    const double piece_m = length_m * (Integral(next) - Integral(begin)) / whole;
    if (piece_m > 0.0) end = AlongPiece(end, begin, next, piece_m);
    begin = next;
  }
  return end;
}

double CurvatureAt(const Spline& spline, double driven_m, const CurvatureLaw& law) {
  const double half_m = 0.5 * spline.length_m;
  if (driven_m <= 0.0) return spline.start_per_m;
  if (driven_m < half_m) {
    return law.Between(spline.start_per_m, spline.first_knot_per_m, driven_m / half_m);
  }
  if (driven_m < spline.length_m) {
    return law.Between(spline.first_knot_per_m, spline.second_knot_per_m,
                       (driven_m - half_m) / half_m);
  }
  return spline.second_knot_per_m;
}

double CurvatureRateAt(const Spline& spline, double driven_m, const CurvatureLaw& law) {
  const double half_m = 0.5 * spline.length_m;
  if (driven_m < 0.0 || driven_m >= spline.length_m) return 0.0;
  if (driven_m < half_m) {
    return law.RateBetween(spline.start_per_m, spline.first_knot_per_m, driven_m / half_m, half_m);
  }
  return law.RateBetween(spline.first_knot_per_m, spline.second_knot_per_m,
                         (driven_m - half_m) / half_m, half_m);
}

math::Pose2 AlongSpline(const math::Pose2& from, const Spline& spline, double from_m, double to_m,
                        const CurvatureLaw& law) {
  EXPECT(0.0 <= from_m && from_m <= to_m);
  math::Pose2 end = from;
  double begin_m = from_m;
  // Up to each knot, and beyond the last one, as far as the way leads.
  for (const double knot_m : {0.5 * spline.length_m, spline.length_m, to_m}) {
    const double next_m = std::min(knot_m, to_m);
    if (next_m <= begin_m) continue;
    end = law.Along(end, CurvatureAt(spline, begin_m, law), CurvatureAt(spline, next_m, law),
                    next_m - begin_m);
    begin_m = next_m;
  }
  return end;
}

}  // namespace rockyard::navigation
