#include "replay/motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/angles.h"

namespace rockyard::replay {
namespace {

constexpr double kGrowth = 1.5;
constexpr double kLoosest = 1000.0;  // growth beyond which nothing more can be gained

double Lerp(double a, double b, double share) { return a + share * (b - a); }

double ShareOfTime(double from_s, double to_s, double at_s) {
  return to_s > from_s ? (at_s - from_s) / (to_s - from_s) : 1.0;
}

// A moment that must be kept whatever the tolerance.
bool IsMark(std::span<const ReplayPose> poses, std::size_t i) {
  if (i == 0 || i + 1 == poses.size() || poses[i].set_back || poses[i + 1].set_back) return true;
  return poses[i].sample.activity != poses[i + 1].sample.activity;
}

// The part between two kept moments, ends included.
using Part = std::pair<std::size_t, std::size_t>;

void KeepBetween(std::span<const ReplayPose> poses, const MotionTolerance& tolerance, Part whole,
                 std::vector<bool>& keep) {
  std::vector<Part> parts{whole};
  while (!parts.empty()) {
    const auto [first, last] = parts.back();
    parts.pop_back();
    double worst = 1.0;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double error = ShownError(poses[first], poses[last], poses[i], tolerance);
      if (error <= worst) continue;
      worst = error;
      at = i;
    }
    if (at == first) continue;
    keep[at] = true;
    parts.emplace_back(first, at);
    parts.emplace_back(at, last);
  }
}

std::vector<std::size_t> Kept(std::span<const ReplayPose> poses, const MotionTolerance& tolerance) {
  std::vector<bool> keep(poses.size(), false);
  std::size_t before = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!IsMark(poses, i)) continue;
    keep[i] = true;
    KeepBetween(poses, tolerance, {before, i}, keep);
    before = i;
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (keep[i]) kept.push_back(i);
  }
  return kept;
}

double JointError(const ReplayPose& before, const ReplayPose& after, const ReplayPose& pose,
                  double share) {
  double worst_rad = 0.0;
  for (std::size_t i = 0; i < pose.joint_rad.size(); ++i) {
    const double shown_rad = Lerp(before.joint_rad[i], after.joint_rad[i], share);
    worst_rad = std::max(worst_rad, std::abs(pose.joint_rad[i] - shown_rad));
  }
  return worst_rad;
}

}  // namespace

double ShownError(const ReplayPose& before, const ReplayPose& after, const ReplayPose& pose,
                  const MotionTolerance& tolerance) {
  const truth::TraceSample& a = before.sample;
  const truth::TraceSample& b = after.sample;
  const truth::TraceSample& now = pose.sample;
  const double share = ShareOfTime(a.time_s, b.time_s, now.time_s);
  const auto position = [](const truth::TraceSample& s) {
    return math::Vector3(s.posture.X_WR.translation());
  };
  const auto attitude = [](const truth::TraceSample& s) {
    return Eigen::Quaterniond(s.posture.X_WR.linear());
  };
  const double position_m =
      (position(a) + share * (position(b) - position(a)) - position(now)).norm();
  const double believed_m =
      std::hypot(Lerp(a.estimate.x_m, b.estimate.x_m, share) - now.estimate.x_m,
                 Lerp(a.estimate.y_m, b.estimate.y_m, share) - now.estimate.y_m);
  const double attitude_rad = attitude(a).slerp(share, attitude(b)).angularDistance(attitude(now));
  const double heading_rad =
      math::WrapAngle(now.estimate.heading_rad - a.estimate.heading_rad -
                      share * math::WrapAngle(b.estimate.heading_rad - a.estimate.heading_rad));
  return std::max({position_m / tolerance.position_m, believed_m / tolerance.position_m,
                   attitude_rad / tolerance.angle_rad, std::abs(heading_rad) / tolerance.angle_rad,
                   JointError(before, after, pose, share) / tolerance.joint_rad});
}

ThinnedMotion ThinMotion(std::span<const ReplayPose> poses, std::size_t most) {
  ThinnedMotion motion;
  for (double scale = 1.0;; scale *= kGrowth) {
    motion.tolerance = MotionTolerance{}.Scaled(scale);
    motion.kept = Kept(poses, motion.tolerance);
    if (motion.kept.size() <= most || scale > kLoosest) return motion;
  }
}

}  // namespace rockyard::replay
