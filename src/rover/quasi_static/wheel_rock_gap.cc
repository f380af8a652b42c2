#include "rover/quasi_static/wheel_rock_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "math/functions.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

constexpr int kMaxEllipsoidIterations = 12;
// The gap is stationary in the normal and Newton's method is quadratic: after a step of this size
// the error of the gap is below 1e-9 m.
constexpr double kConverged_rad = 3e-3;
// The iterations and the last step for caps, whose points move far with their normals.
constexpr int kMaxCapIterations = 40;
constexpr double kCapConverged_rad = 1e-5;
// A paraboloid, B = 0, is the limit of quadrics with a centre far away; nearer to 0 than this B is
// set to it, which moves no point of the surface by more than a millionth of its height.
constexpr double kLeastBend = 1e-6;
// Least n' S n: keeps the normal straight down, along which the rim of a base has no extent, from
// dividing by zero.
constexpr double kLeastSquare_m2 = 1e-18;
// Longest step on the sphere, rad.
constexpr double kLongestStep_rad = 0.5;
// Cosines of the angle between normal and axle between which a normal is one at the rim's edge.
constexpr double kOnEdge = 1e-3;
constexpr double kOnFace = 0.99;
// Sine of that angle below which the disc counts as seen edge-on.
constexpr double kMinSine = 0.02;

// The convex body that is rock plus disc: supports of both and the offset between their centres.
struct Pair {
  Vector3 offset_W;  // from the rock's centre to the disc's
  Vector3 axle_W;
  double core_radius_m;
  double margin_m;
  const RockSupport* rock;

  int MaxIterations() const { return rock->IsCap() ? kMaxCapIterations : kMaxEllipsoidIterations; }
  double Converged_rad() const { return rock->IsCap() ? kCapConverged_rad : kConverged_rad; }
};

// A piece of the rock's support function along n: with the offset of the disc from the piece's own
// centre, sqrt(n' S n) and S n.
struct Support {
  const RockSupport::Piece& piece;
  Vector3 offset_W;
  Vector3 Sn;
  double D;

  Support(const RockSupport& rock, const Vector3& offset_from_rock_W, const Vector3& n)
      : piece(rock.PieceAt(n)),
        offset_W(offset_from_rock_W.x(), offset_from_rock_W.y(),
                 offset_from_rock_W.z() - piece.above_center_m),
        Sn(piece.S_m2 * n),
        D(std::sqrt(std::max(n.dot(Sn), kLeastSquare_m2))) {}

  // Returns the rock's point with the normal n, from the piece's centre.
  Vector3 Point() const { return piece.sign * Sn / D; }
};

// Returns Newton's step from n, cut where it crosses from a cap's rim to its quadric. The rim bends
// in one direction only, so that steps from its side are too long for the flank, which bends most
// of all right behind the border.
Vector3 UpToBorder(const RockSupport& rock, const Support& support, const Vector3& n,
                   const Vector3& step) {
  if (!support.piece.is_rim) return step;
  const double before_m = rock.FromBorder_m(n);
  const double after_m = rock.FromBorder_m(n + step);
  // The step is cut by secant, which ends beyond the border since FromBorder_m is concave.
  return after_m > 0.0 ? Vector3(before_m / (before_m - after_m) * step) : step;
}

// The arc of a circle that holds the maximum of a function, found by the signs of the function's
// slope. Its ends are less than half a turn apart.
class Bracket {
 public:
  // Takes the slope at n about the axis, and returns `next`, or the middle of the arc where that
  // lies outside of it. An arc with one end has no middle: a step too short to leave n, at the
  // first end, is as good as any.
  Vector3 Hold(const Vector3& axis, const Vector3& n, double slope, const Vector3& next) {
    (slope > 0.0 ? low_ : high_) = n;
    const bool above = !low_ || axis.dot(low_->cross(next)) > 0.0;
    const bool below = !high_ || axis.dot(next.cross(*high_)) > 0.0;
    if ((above && below) || !low_ || !high_) return next;
    return (*low_ + *high_).normalized();
  }

 private:
  std::optional<Vector3> low_;
  std::optional<Vector3> high_;
};

// Finds the best n in the plane of the disc, n = cos(a) e1 + sin(a) e2, where the rim lies flat on
// the rock. Returns the sideways pull, the derivative of the smooth part of f along the axle.
double AlignInPlane(const Pair& pair, Vector3& n) {
  n -= n.dot(pair.axle_W) * pair.axle_W;
  // Nothing is left of the normal of a side face; any direction is as good a start.
  if (n.squaredNorm() < 1e-6) n = pair.axle_W.unitOrthogonal();
  n.normalize();
  const int max_iterations = pair.MaxIterations();
  const double converged_rad = pair.Converged_rad();
  Bracket bracket;
  for (int i = 0; i < max_iterations; ++i) {
    // With n' = e and n'' = -n along the circle, D = sqrt(n' S n):
    //   f'  = e . d - e . S n / D,
    //   -f'' = n . d - D + e . S e / D - (e . S n)^2 / D^3   (d: offset of the centres),
    // and the step is f' / -f''. The margin bounds -f'' away from zero, so that the step goes
    // uphill.
    const Vector3 e = pair.axle_W.cross(n);
    const Support support(*pair.rock, pair.offset_W, n);
    const double D = support.D;
    const double sign = support.piece.sign;
    const double eSn = e.dot(support.Sn);
    const double slope = e.dot(support.offset_W) - sign * eSn / D;
    const double bend = n.dot(support.offset_W) - sign * D +
                        sign * e.dot(support.piece.S_m2 * e) / D - sign * eSn * eSn / (D * D * D);
    const double step =
        std::clamp(slope / std::max(bend, pair.margin_m), -kLongestStep_rad, kLongestStep_rad);
    const Vector3 last = n;
    n += UpToBorder(*pair.rock, support, n, step * e);
    n.normalize();
    if (pair.rock->IsCap()) n = bracket.Hold(pair.axle_W, last, slope, n);
    if (std::abs(step) < converged_rad) break;
  }
  // Along the axle the terms -r sqrt(1 - t^2) and -w |t| have slope 0 and -w sign(t) at t = 0, so t
  // = 0 is the maximum as long as this pull of the smooth part stays within w.
  const Support support(*pair.rock, pair.offset_W, n);
  return pair.axle_W.dot(support.offset_W) -
         support.piece.sign * pair.axle_W.dot(support.Sn) / support.D;
}

// Returns whether the rock's point with the normal `face_W` of a side face lies over that face.
bool TouchesFace(const Pair& pair, const Vector3& face_W) {
  const Support support(*pair.rock, pair.offset_W, face_W);
  const Vector3 d = support.offset_W - support.Point();
  return (d - d.dot(face_W) * face_W).squaredNorm() <= pair.core_radius_m * pair.core_radius_m;
}

// Finds the best n, by both of its angles, where an edge of the rim touches.
void AlignOnEdge(const Pair& pair, Vector3& n) {
  Vector3 last = n;
  Vector3 move = Vector3::Zero();
  double last_f = -std::numeric_limits<double>::infinity();
  const int max_iterations = pair.MaxIterations();
  const double converged_rad = pair.Converged_rad();
  for (int i = 0; i < max_iterations; ++i) {
    // Orthonormal b, e, n: b across the axle and the normal, e from the rim's plane towards the
    // axle.
    const double t = n.dot(pair.axle_W);
    const double sine = std::max(std::sqrt(std::max(1.0 - t * t, 0.0)), kMinSine);
    Vector3 b = pair.axle_W.cross(n);
    b.normalize();
    const Vector3 e = n.cross(b);
    const Support support(*pair.rock, pair.offset_W, n);
    const double D = support.D;
    const double sign = support.piece.sign;
    // The offset is that of the rim's circle on the nearer side, so w |t| is part of it. f + m is
    // homogeneous of degree 1 in n, so n . gradient = f + m.
    const Vector3 gradient =
        support.offset_W - support.Point() - pair.core_radius_m / sine * (n - t * pair.axle_W);
    const double f = n.dot(gradient) - pair.margin_m;
    if (f < last_f) {  // too far: near a side face the curvature changes quickly
      move *= 0.5;
      n = (last + move).normalized();
      continue;
    }
    last = n;
    last_f = f;
    const double bSn = b.dot(support.Sn);
    const double eSn = e.dot(support.Sn);
    const double D3 = D * D * D;
    // -Hessian on the sphere: that of the ambient function, plus n . gradient = f + m on the
    // diagonal for the sphere's own curvature, kept at m / 2 or more in deep penetration. The disc,
    // r sqrt(|n|^2 - t^2), bends by r / sqrt(1 - t^2) about the axle (b) and not at all towards it
    // (e).
    const double spin = pair.margin_m + std::max(f, -0.5 * pair.margin_m);
    const Vector3 Sb = support.piece.S_m2 * b;
    const double M_bb =
        sign * b.dot(Sb) / D - sign * bSn * bSn / D3 + pair.core_radius_m / sine + spin;
    const double M_be = sign * e.dot(Sb) / D - sign * bSn * eSn / D3;
    const double M_ee = sign * e.dot(support.piece.S_m2 * e) / D - sign * eSn * eSn / D3 + spin;
    const double g_b = b.dot(gradient);
    const double g_e = e.dot(gradient);
    const double determinant = M_bb * M_ee - M_be * M_be;
    // M step = g for the 2 x 2 matrix.
    double step_b = (M_ee * g_b - M_be * g_e) / determinant;
    double step_e = (M_bb * g_e - M_be * g_b) / determinant;
    const double size = math::Hypot(step_b, step_e);
    if (size > kLongestStep_rad) {
      step_b *= kLongestStep_rad / size;
      step_e *= kLongestStep_rad / size;
    }
    move = step_b * b + step_e * e;
    move = UpToBorder(*pair.rock, support, n, move);
    n = (last + move).normalized();
    if (size < converged_rad) break;
  }
}

// Returns f(n) of the header: a lower bound of the gap for any unit n, the gap itself at its
// maximum.
double Separation(const WheelShape& wheel, const Vector3& offset_W, const Vector3& axle_W,
                  const RockSupport& rock, const Vector3& n) {
  const double t = n.dot(axle_W);
  return n.dot(offset_W) - rock.Along(n) -
         wheel.core_radius_m * std::sqrt(std::max(1.0 - t * t, 0.0)) -
         wheel.core_half_width_m * std::abs(t) - wheel.margin_m;
}

// Goes on from a normal at one edge of the rim; returns false where it is at none, or does not end
// at that edge.
bool StayOnEdge(const Pair& pair, double half_width_m, Vector3& n) {
  const double t = n.dot(pair.axle_W);
  if (std::abs(t) < kOnEdge || std::abs(t) > kOnFace) return false;
  const Vector3 face_W = std::copysign(1.0, t) * pair.axle_W;
  Pair edge = pair;
  edge.offset_W -= half_width_m * face_W;
  if (TouchesFace(edge, face_W)) return false;
  Vector3 found = n;
  AlignOnEdge(edge, found);
  if (found.dot(face_W) <= 0.0) return false;
  n = found;
  return true;
}

// Finds the best n from any start: in the plane of the disc first. Where the pull exceeds the half
// width, the rim does not lie flat on the rock: the rim's edge on that side touches it, or the side
// face, where the rock's point with the face's normal lies over the face.
void Align(const Pair& pair, const WheelShape& wheel, Vector3& n) {
  const double pull_m = AlignInPlane(pair, n);
  if (std::abs(pull_m) <= wheel.core_half_width_m) return;
  const Vector3 face_W = std::copysign(1.0, pull_m) * pair.axle_W;
  Pair edge = pair;
  edge.offset_W -= wheel.core_half_width_m * face_W;
  const auto separation_m = [&](const Vector3& along_W) {
    return Separation(wheel, pair.offset_W, pair.axle_W, *pair.rock, along_W);
  };
  if (TouchesFace(edge, face_W) && separation_m(face_W) > separation_m(n)) {
    n = face_W;
  } else {
    AlignOnEdge(edge, n);
  }
}

}  // namespace

// Must agree with AddWheels (part_shapes.cc).
WheelShape::WheelShape(const RoverGeometryParams& params)
    : margin_m(std::min(0.25 * params.wheel_width_m, 0.5 * params.wheel_radius_m)) {
  core_radius_m = params.wheel_radius_m - margin_m;
  core_half_width_m = 0.5 * params.wheel_width_m - margin_m;
}

RockSupport::RockSupport(const terrain::Rock& rock)
    : center_W_(rock.center_W),
      bounding_radius_m_(rock.semi_axes_m.maxCoeff()),
      top_W_m_(rock.center_W.z() + rock.semi_axes_m.z()),
      growth_(rock.cap_growth),
      height_m_(rock.semi_axes_m.z()) {
  const Eigen::Matrix3d R = math::RotationAbout(rock.yaw_rad, Vector3::UnitZ());
  const Vector3 squares = rock.semi_axes_m.cwiseAbs2();
  if (!IsCap()) {
    // The ellipsoid's support function is sqrt(n' R diag(a^2) R' n) = sqrt(n' S n).
    pieces_[0].S_m2 = R * squares.asDiagonal() * R.transpose();
    return;
  }
  const double exact = 1.0 - growth_;
  const double B = std::abs(exact) < kLeastBend ? std::copysign(kLeastBend, exact) : exact;
  const double ratio = 0.5 * growth_ / B;
  const Vector3 quadric = ratio * ratio * Vector3(-B * squares.x(), -B * squares.y(), squares.z());
  pieces_[0] = {R * quadric.asDiagonal() * R.transpose(), B > 0.0 ? -1.0 : 1.0,
                height_m_ + ratio * height_m_};
  const Vector3 rim(squares.x(), squares.y(), 0.0);
  pieces_[1] = {R * rim.asDiagonal() * R.transpose(), 1.0, 0.0, true};
}

double RockSupport::FromBorder_m(const Vector3& n_W) const {
  return height_m_ * n_W.z() -
         (1.0 - 0.5 * growth_) * std::sqrt(std::max(n_W.dot(pieces_[1].S_m2 * n_W), 0.0));
}

double RockSupport::Along(const Vector3& n_W) const {
  const Piece& piece = PieceAt(n_W);
  return n_W.z() * piece.above_center_m + piece.sign * std::sqrt(n_W.dot(piece.S_m2 * n_W));
}

Vector3 RockSupport::GuessNormal(const Vector3& center_W) const {
  const Vector3 d = center_W - center_W_;
  Vector3 scaled;
  if (IsCap()) {
    // The normal where the line from the centre of the base to center_W leaves a round cap, as in
    // RockBody::NearestOnCap from inside. S_xx of the rim is a^2 up to yaw.
    const double a2_m2 = pieces_[1].S_m2(0, 0);
    const double zeta = std::max(d.z(), 0.0) / height_m_;
    const double rho2 = d.head<2>().squaredNorm() / a2_m2;
    const double scale = 2.0 / std::max(zeta * (2.0 - growth_) +
                                            std::sqrt(growth_ * growth_ * zeta * zeta + 4.0 * rho2),
                                        1e-9);
    const double slope = 0.5 * growth_ + (1.0 - growth_) * (1.0 - scale * zeta);
    scaled = Vector3(scale * d.x() / a2_m2, scale * d.y() / a2_m2, slope / height_m_);
  } else {
    // Stretches the direction in z by a_x / a_z: flat rocks are mostly met from above. S_xx is
    // a_x^2 up to yaw, S_zz is a_z^2.
    const Eigen::Matrix3d& S_m2 = pieces_[0].S_m2;
    scaled = Vector3(d.x(), d.y(), d.z() * std::sqrt(S_m2(0, 0) / S_m2(2, 2)));
  }
  const double norm = scaled.norm();
  return norm > 1e-9 ? Vector3(scaled / norm) : Vector3::UnitZ();
}

WheelRockGap FindGap(const WheelShape& wheel, const Vector3& center_W, const Vector3& axle_W,
                     const RockSupport& rock, double reach_m, const Vector3& n_W) {
  const Vector3 offset_W = center_W - rock.center_W();
  WheelRockGap result;
  result.n_W = n_W;
  result.gap_m = Separation(wheel, offset_W, axle_W, rock, n_W);
  if (result.gap_m > reach_m) return result;

  Vector3& n = result.n_W;
  const Pair pair{offset_W, axle_W, wheel.core_radius_m, wheel.margin_m, &rock};
  if (!StayOnEdge(pair, wheel.core_half_width_m, n)) Align(pair, wheel, n);
  result.gap_m = Separation(wheel, offset_W, axle_W, rock, n);
  const Support support(rock, offset_W, n);
  // The rock's support point, moved along n by the gap, lies on the wheel.
  result.p_W = rock.center_W() + support.piece.above_center_m * Vector3::UnitZ() + support.Point() +
               result.gap_m * n;
  return result;
}

}  // namespace rockyard::rover
