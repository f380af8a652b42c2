// Where a wheel touches ground that may bend more sharply than its rim. The contact finders of both
// fidelities take the touches of their wheels from it. Records depend on which places it takes: on
// kPlaces, kStep_rad, kApartCosine, and which of equal heights counts.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "math/pose.h"
#include "terrain/ground.h"

namespace rockyard::rover {

// A place at which a wheel touches the ground, or is nearest to it.
struct GroundTouch {
  math::Vector3 n_W = math::Vector3::UnitZ();  // normal of the ground
  math::Vector3 p_W = math::Vector3::Zero();   // point of the wheel
  double gap_m = 0.0;  // distance of p_W from the tangent plane; negative: penetration
};

// One touch, or two where a wheel stands between the flanks of a ditch. Must stay: the touch
// farther back comes first, as by this order each touch keeps its load from step to step.
struct GroundTouches {
  std::array<GroundTouch, 2> touches;
  std::size_t count = 1;

  // Takes one more touch: the deepest of all stays, and the deepest of those apart from it.
  void Take(const GroundTouch& touch, double apart_cosine) {
    GroundTouch other = touch;
    if (count == 0 || touch.gap_m < touches[0].gap_m) {
      other = touches[0];
      touches[0] = touch;
      if (count == 0) {
        count = 1;
        return;
      }
    }
    if (count == 2 && touches[1].n_W.dot(touches[0].n_W) > apart_cosine) count = 1;
    if (other.n_W.dot(touches[0].n_W) > apart_cosine) return;
    if (count == 2 && other.gap_m >= touches[1].gap_m) return;
    touches[1] = other;
    count = 2;
  }
};

// Returns the touch of a wheel whose point farthest against n_W is support(n_W), where the ground
// has the normal n_W: height over the ground times the cosine of the slope.
template <typename Support>
GroundTouch TouchAlong(const terrain::Ground& ground, const math::Vector3& n_W,
                       const Support& support) {
  const math::Vector3 p_W = support(n_W);
  return {n_W, p_W, (p_W.z() - ground.Height(p_W.x(), p_W.y())) * n_W.z()};
}

// Searches the rim of one wheel, by the angle around the axle from a first normal.
template <typename Support>
class RimSearch {
 public:
  RimSearch(const terrain::Ground& ground, const math::Vector3& below_W,
            const math::Vector3& axle_W, const Support& support)
      : ground_(ground), below_W_(below_W), axle_W_(axle_W), support_(support) {}

  GroundTouch At(double angle_rad) const {
    return TouchAlong(ground_, math::RotationAbout(angle_rad, axle_W_) * below_W_, support_);
  }
  // Returns the height of the rim's point over the ground. It is least where rim and ground have
  // one tangent, also on sharp edges, where normals change too fast to be followed.
  double Height_m(double angle_rad) const {
    const GroundTouch touch = At(angle_rad);
    return touch.n_W.z() > kSteepest ? touch.gap_m / touch.n_W.z() : kNever_m;
  }
  // Returns the angle of the least height between two angles that enclose one.
  double Least(double low_rad, double high_rad) const {
    constexpr double kGolden = 0.6180339887498949;
    while (high_rad - low_rad > kResolution_rad) {
      const double a_rad = high_rad - kGolden * (high_rad - low_rad);
      const double b_rad = low_rad + kGolden * (high_rad - low_rad);
      if (Height_m(a_rad) < Height_m(b_rad)) {
        high_rad = b_rad;
      } else {
        low_rad = a_rad;
      }
    }
    return 0.5 * (low_rad + high_rad);
  }

 private:
  // Cosine of the steepest ground that counts as below a wheel.
  static constexpr double kSteepest = 0.1;
  static constexpr double kNever_m = 1e9;
  static constexpr double kResolution_rad = 1e-6;

  const terrain::Ground& ground_;
  const math::Vector3& below_W_;
  const math::Vector3& axle_W_;
  const Support& support_;
};

// Returns the touches of the wheel around center_W. Away from ditches and pits it takes the normal
// of the ground below the centre, which is exact on a plane and near enough on roughness. Near
// ditches and pits it looks for places around the rim that are nearer to the ground than the places
// beside them. It takes the deepest of these places, and of the others the deepest whose normal is
// at least 20 degrees from the normal there.
template <typename Support>
GroundTouches FindGroundTouches(const terrain::Ground& ground, const math::Vector3& center_W,
                                const math::Vector3& axle_W, double radius_m,
                                const Support& support) {
  constexpr int kPlaces = 15;  // to either side
  constexpr double kStep_rad = 0.1;
  constexpr double kApartCosine = 0.94;  // 20 degrees
  const math::Vector3 below_W = ground.Normal(center_W.x(), center_W.y());
  if (!ground.HasDepressionNear(center_W.x(), center_W.y(), radius_m)) {
    return {{TouchAlong(ground, below_W, support), {}}, 1};
  }
  const RimSearch<Support> rim(ground, below_W, axle_W, support);
  std::array<double, 2 * kPlaces + 1> heights_m{};
  for (int i = 0; i <= 2 * kPlaces; ++i) {
    heights_m[static_cast<std::size_t>(i)] = rim.Height_m(kStep_rad * (i - kPlaces));
  }
  GroundTouches result{{TouchAlong(ground, below_W, support), {}}, 0};
  for (std::size_t i = 1; i < 2 * kPlaces; ++i) {
    // The last of equal neighbours counts, so that a level stretch is one place.
    if (heights_m[i] > heights_m[i - 1] || heights_m[i] >= heights_m[i + 1]) continue;
    const double angle_rad = kStep_rad * (static_cast<double>(i) - kPlaces);
    const GroundTouch touch = rim.At(rim.Least(angle_rad - kStep_rad, angle_rad + kStep_rad));
    result.Take(touch, kApartCosine);
  }
  result.count = std::max<std::size_t>(result.count, 1);
  // Forward is across the axle, which points to the left, and the vertical.
  const math::Vector3 forward_W = axle_W.cross(math::Vector3::UnitZ());
  if (result.count == 2 && (result.touches[1].p_W - result.touches[0].p_W).dot(forward_W) < 0.0) {
    std::swap(result.touches[0], result.touches[1]);
  }
  return result;
}

}  // namespace rockyard::rover
