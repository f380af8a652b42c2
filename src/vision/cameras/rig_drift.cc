#include "vision/cameras/rig_drift.h"

#include <optional>

#include "core/check.h"
#include "core/random.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

// Returns the axes of the camera's own frame as columns, in A: x to the right along a row, y down,
// z along the middle ray.
Eigen::Matrix3d AxesOf(const CameraModel& camera) {
  RayJacobian by_pixel;
  const std::optional<Ray> ray = BackProject(camera, MiddleOf(camera.size), &by_pixel);
  EXPECT(ray.has_value());
  const Vector3 z = ray->direction;
  const Vector3 along = by_pixel.direction.col(0);
  const Vector3 x = (along - along.dot(z) * z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

}  // namespace

RigDrift DrawRigDrift(const RigDriftParams& params, core::RandomStream& stream) {
  RigDrift drift;
  drift.roll_rad = core::SampleNormal(stream, 0.0, params.roll_sd_rad);
  drift.pitch_rad = core::SampleNormal(stream, 0.0, params.pitch_sd_rad);
  drift.yaw_rad = core::SampleNormal(stream, 0.0, params.yaw_sd_rad);
  drift.baseline_m = core::SampleNormal(stream, 0.0, params.baseline_sd_m);
  drift.focal_share = core::SampleNormal(stream, 0.0, 0.01 * params.focal_sd_percent);
  return drift;
}

CameraModel DriftedRight(const CameraModel& left, const CameraModel& right, const RigDrift& drift) {
  if (drift == RigDrift{}) return right;
  const Vector3 centre = CentreOf(right);
  const Vector3 baseline = centre - CentreOf(left);
  EXPECT(baseline.norm() > 0.0);
  const Eigen::Matrix3d axes = AxesOf(right);
  const Eigen::Matrix3d turn = (math::RotationAbout(-drift.yaw_rad, Vector3::UnitY()) *
                                math::RotationAbout(-drift.pitch_rad, Vector3::UnitX())) *
                               math::RotationAbout(drift.roll_rad, Vector3::UnitZ());
  // `move` takes p to centre + the baseline's change + turn (p - centre).
  math::Transform move = math::Transform::Identity();
  move.linear() = axes * turn * axes.transpose();
  move.translation() = centre + drift.baseline_m * baseline.normalized() - move.linear() * centre;
  const CameraModel moved = Moved(move, right);
  const PixelMap grown{1.0 + drift.focal_share, -drift.focal_share * MiddleOf(right.size)};
  return {std::visit([&](const auto& lens) -> AnyLens { return Mapped(lens, grown); }, moved.lens),
          right.size};
}

}  // namespace rockyard::vision
