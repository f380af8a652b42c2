#include "experiments/designation/lander_pair.h"

#include <cmath>

#include "vision/cameras/rectification.h"

namespace rockyard::experiments {

using math::Vector3;

LanderPair::LanderPair(const LanderCameras& cameras, const Vector3& p_goal_L) {
  const Vector3 top_L(0.0, 0.0, cameras.mast_height_m);
  const Vector3 ahead_L = (p_goal_L - top_L).normalized();
  // Pan and no roll: rows of the images are level.
  const double along_m = std::hypot(ahead_L.x(), ahead_L.y());
  const Vector3 right_L = along_m > 0.0
                              ? Vector3(ahead_L.y() / along_m, -ahead_L.x() / along_m, 0.0)
                              : Vector3(0.0, -1.0, 0.0);
  const double focal_px = 1.0 / cameras.pixel_rad;
  const double middle_px = 0.5 * (cameras.image_side_px - 1);
  left_.A = ahead_L;
  left_.H = focal_px * right_L + middle_px * ahead_L;
  left_.V = focal_px * ahead_L.cross(right_L) + middle_px * ahead_L;
  right_ = left_;
  left_.C = top_L - 0.5 * cameras.baseline_m * right_L;
  right_.C = top_L + 0.5 * cameras.baseline_m * right_L;
}

std::optional<StereoPick> LanderPair::See(const Vector3& p_L) const {
  const auto left_px = vision::Project(left_, p_L);
  const auto right_px = vision::Project(right_, p_L);
  if (!left_px || !right_px) return std::nullopt;
  return StereoPick{*left_px, left_px->x() - right_px->x()};
}

std::optional<Vector3> LanderPair::Place(const StereoPick& pick) const {
  const auto point = vision::Triangulate(left_, right_, pick.left_px, pick.disparity_px);
  if (!point) return std::nullopt;
  return point->p_A;
}

Vector3 Panned(const Vector3& p_L, double pan_rad) {
  return Eigen::AngleAxisd(pan_rad, Vector3::UnitZ()) * p_L;
}

}  // namespace rockyard::experiments
