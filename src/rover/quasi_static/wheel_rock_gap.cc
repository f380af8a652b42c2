#include "rover/quasi_static/wheel_rock_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rockyard::rover {
namespace {

using math::Vector3;

constexpr int kMaxIterations = 12;
// The gap is stationary in the normal and Newton's method is quadratic: after a step of this size
// the error of the gap is below 1e-9 m.
constexpr double kConverged_rad = 3e-3;
// Longest step on the sphere, rad.
constexpr double kLongestStep_rad = 0.5;
// Sine of the angle between normal and axle below which the disc counts as seen edge-on.
constexpr double kMinSine = 0.02;

// The convex body that is rock plus disc: supports of both and the offset between their centres.
struct Pair {
  Vector3 offset_W;  // from the rock's centre to the disc's
  Vector3 axle_W;
  double core_radius_m;
  double margin_m;
  const RockSupport* rock;
};

// Flat on the rim: n = cos(a) e1 + sin(a) e2 in the plane of the disc. Returns the sideways pull,
// the derivative of the smooth part of f along the axle.
double AlignInPlane(const Pair& pair, Vector3& n) {
  n -= n.dot(pair.axle_W) * pair.axle_W;
  // Nothing is left of the normal of a side face: any direction starts as well.
  if (n.squaredNorm() < 1e-6) n = pair.axle_W.unitOrthogonal();
  n.normalize();
  for (int i = 0; i < kMaxIterations; ++i) {
    // With n' = e and n'' = -n along the circle, D = sqrt(n' S n):
    //   f'  = e . d - e . S n / D,
    //   -f'' = n . d - D + e . S e / D - (e . S n)^2 / D^3   (d: offset of the centres),
    // and the step is f' / -f''. The margin bounds -f'' away from zero, so that the step goes
    // uphill.
    const Vector3 e = pair.axle_W.cross(n);
    const Vector3 Sn = pair.rock->S_m2 * n;
    const double D = std::sqrt(n.dot(Sn));
    const double eSn = e.dot(Sn);
    const double slope = e.dot(pair.offset_W) - eSn / D;
    const double bend =
        n.dot(pair.offset_W) - D + e.dot(pair.rock->S_m2 * e) / D - eSn * eSn / (D * D * D);
    const double step =
        std::clamp(slope / std::max(bend, pair.margin_m), -kLongestStep_rad, kLongestStep_rad);
    n += step * e;
    n.normalize();
    if (std::abs(step) < kConverged_rad) break;
  }
  // Along the axle the terms -r sqrt(1 - t^2) and -w |t| have slope 0 and -w sign(t) at t = 0, so t
  // = 0 is the maximum as long as this pull of the smooth part stays within w.
  const Vector3 Sn = pair.rock->S_m2 * n;
  return pair.axle_W.dot(pair.offset_W) - pair.axle_W.dot(Sn) / std::sqrt(n.dot(Sn));
}

// True where the rock's point with the normal `face_W` of a side face lies over that face.
bool TouchesFace(const Pair& pair, const Vector3& face_W) {
  const Vector3 Sn = pair.rock->S_m2 * face_W;
  const Vector3 d = pair.offset_W - Sn / std::sqrt(face_W.dot(Sn));
  return (d - d.dot(face_W) * face_W).squaredNorm() <= pair.core_radius_m * pair.core_radius_m;
}

// On an edge of the rim: both angles of n.
void AlignOnEdge(const Pair& pair, Vector3& n) {
  Vector3 last = n;
  Vector3 move = Vector3::Zero();
  double last_f = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxIterations; ++i) {
    // Orthonormal b, e, n: b across the axle and the normal, e from the rim's plane towards the
    // axle.
    const double t = n.dot(pair.axle_W);
    const double sine = std::max(std::sqrt(std::max(1.0 - t * t, 0.0)), kMinSine);
    Vector3 b = pair.axle_W.cross(n);
    b.normalize();
    const Vector3 e = n.cross(b);
    const Vector3 Sn = pair.rock->S_m2 * n;
    const double D = std::sqrt(n.dot(Sn));
    // The offset is that of the rim's circle on the nearer side, so w |t| is part of it. f + m is
    // homogeneous of degree 1 in n, so n . gradient = f + m.
    const Vector3 gradient =
        pair.offset_W - Sn / D - pair.core_radius_m / sine * (n - t * pair.axle_W);
    const double f = n.dot(gradient) - pair.margin_m;
    if (f < last_f) {  // too far: near a side face the curvature changes quickly
      move *= 0.5;
      n = (last + move).normalized();
      continue;
    }
    last = n;
    last_f = f;
    const double bSn = b.dot(Sn);
    const double eSn = e.dot(Sn);
    const double D3 = D * D * D;
    // -Hessian on the sphere: that of the ambient function, plus n . gradient = f + m on the
    // diagonal for the sphere's own curvature, kept at m / 2 or more in deep penetration. The disc,
    // r sqrt(|n|^2 - t^2), bends by r / sqrt(1 - t^2) about the axle (b) and not at all towards it
    // (e).
    const double spin = pair.margin_m + std::max(f, -0.5 * pair.margin_m);
    const Vector3 Sb = pair.rock->S_m2 * b;
    const double M_bb = b.dot(Sb) / D - bSn * bSn / D3 + pair.core_radius_m / sine + spin;
    const double M_be = e.dot(Sb) / D - bSn * eSn / D3;
    const double M_ee = e.dot(pair.rock->S_m2 * e) / D - eSn * eSn / D3 + spin;
    const double g_b = b.dot(gradient);
    const double g_e = e.dot(gradient);
    const double determinant = M_bb * M_ee - M_be * M_be;
    // M step = g for the 2 x 2 matrix.
    double step_b = (M_ee * g_b - M_be * g_e) / determinant;
    double step_e = (M_bb * g_e - M_be * g_b) / determinant;
    const double size = std::hypot(step_b, step_e);
    if (size > kLongestStep_rad) {
      step_b *= kLongestStep_rad / size;
      step_e *= kLongestStep_rad / size;
    }
    move = step_b * b + step_e * e;
    n = (last + move).normalized();
    if (size < kConverged_rad) break;
  }
}

// f(n) of the header: a lower bound of the gap for any unit n, the gap itself at its maximum.
double Separation(const WheelShape& wheel, const Vector3& offset_W, const Vector3& axle_W,
                  const RockSupport& rock, const Vector3& n) {
  const double t = n.dot(axle_W);
  return n.dot(offset_W) - std::sqrt(n.dot(rock.S_m2 * n)) -
         wheel.core_radius_m * std::sqrt(std::max(1.0 - t * t, 0.0)) -
         wheel.core_half_width_m * std::abs(t) - wheel.margin_m;
}

}  // namespace

WheelShape::WheelShape(const RoverGeometryParams& params)
    : margin_m(std::min(0.25 * params.wheel_width_m, 0.5 * params.wheel_radius_m)) {
  core_radius_m = params.wheel_radius_m - margin_m;
  core_half_width_m = 0.5 * params.wheel_width_m - margin_m;
}

RockSupport::RockSupport(const terrain::Rock& rock)
    : center_W(rock.center_W),
      bounding_radius_m(rock.semi_axes_m.maxCoeff()),
      top_W_m(rock.center_W.z() + rock.semi_axes_m.z()) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(rock.yaw_rad, Vector3::UnitZ()).toRotationMatrix();
  // The ellipsoid's support function is sqrt(n' R diag(a^2) R' n) = sqrt(n' S n).
  S_m2 = R * rock.semi_axes_m.cwiseAbs2().asDiagonal() * R.transpose();
}

Vector3 GuessNormal(const Vector3& center_W, const RockSupport& rock) {
  const Vector3 d = center_W - rock.center_W;
  // Stretches the direction in z by a_x / a_z: flat rocks are mostly met from above. S_xx is a_x^2
  // up to yaw, S_zz is a_z^2.
  const Vector3 scaled(d.x(), d.y(), d.z() * std::sqrt(rock.S_m2(0, 0) / rock.S_m2(2, 2)));
  const double norm = scaled.norm();
  return norm > 1e-9 ? Vector3(scaled / norm) : Vector3::UnitZ();
}

WheelRockGap FindGap(const WheelShape& wheel, const Vector3& center_W, const Vector3& axle_W,
                     const RockSupport& rock, double reach_m, const Vector3& n_W) {
  const Vector3 offset_W = center_W - rock.center_W;
  WheelRockGap result;
  result.n_W = n_W;
  result.gap_m = Separation(wheel, offset_W, axle_W, rock, n_W);
  if (result.gap_m > reach_m) return result;

  Vector3& n = result.n_W;
  Pair pair{offset_W, axle_W, wheel.core_radius_m, wheel.margin_m, &rock};
  const double pull_m = AlignInPlane(pair, n);
  // The pull exceeds the half width, so the rim does not lie flat on the rock: it is met by the
  // rim's edge on that side, or by the side face where the rock's point with that normal lies over
  // it.
  if (std::abs(pull_m) > wheel.core_half_width_m) {
    const double across_m = pull_m > 0.0 ? -wheel.core_half_width_m : wheel.core_half_width_m;
    pair.offset_W += across_m * axle_W;
    const Vector3 face_W = pull_m > 0.0 ? axle_W : Vector3(-axle_W);
    const double before_m = Separation(wheel, offset_W, axle_W, rock, n);
    if (TouchesFace(pair, face_W) && Separation(wheel, offset_W, axle_W, rock, face_W) > before_m) {
      n = face_W;
    } else {
      AlignOnEdge(pair, n);
    }
  }
  result.gap_m = Separation(wheel, offset_W, axle_W, rock, n);
  const Vector3 Sn = rock.S_m2 * n;
  // The rock's support point S n / D, moved along n by the gap, lies on the wheel.
  result.p_W = rock.center_W + Sn / std::sqrt(n.dot(Sn)) + result.gap_m * n;
  return result;
}

}  // namespace rockyard::rover
