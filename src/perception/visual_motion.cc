#include "perception/visual_motion.h"

#include <cmath>

#include "math/angles.h"
#include "math/functions.h"
#include "math/pose.h"

namespace rockyard::perception {
namespace {

using messages::Index;
using messages::PoseCoordinate;
using messages::PoseVector;

// The angles of R_FB = Rz(heading) Ry(pitch) Rx(roll).
struct Angles {
  double heading_rad = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

Angles AnglesOf(const Eigen::Matrix3d& R_FB) {
  return {math::Atan2(R_FB(1, 0), R_FB(0, 0)),
          math::Atan2(-R_FB(2, 0), math::Hypot(R_FB(0, 0), R_FB(1, 0))),
          math::Atan2(R_FB(2, 1), R_FB(2, 2))};
}

// Returns how roll, pitch and heading (rows) change by small turns about the axes of F (columns):
// the equations of visual_motion.h.
Eigen::Matrix3d AnglesByTurns(const Angles& angles) {
  const auto [s, c] = math::SinCos(angles.heading_rad);
  const double tan_pitch = math::Tan(angles.pitch_rad);
  const double cos_pitch = math::Cos(angles.pitch_rad);
  Eigen::Matrix3d by_turns;
  by_turns << c / cos_pitch, s / cos_pitch, 0.0,  //
      -s, c, 0.0,                                 //
      c * tan_pitch, s * tan_pitch, 1.0;
  return by_turns;
}

}  // namespace

messages::RelativeMotion LevelledMotion(const vision::Motion& motion, const FirstStance& first) {
  const Eigen::Matrix3d R_FR0 =
      math::MakePose(math::Vector3::Zero(), 0.0, first.attitude.pitch_rad, first.attitude.roll_rad)
          .linear();
  const math::Vector3 p_F = R_FR0 * motion.X_FS.translation();
  const Angles after = AnglesOf(R_FR0 * motion.X_FS.linear());

  messages::RelativeMotion levelled;
  levelled.motion_F << p_F, math::WrapAngle(after.roll_rad - first.attitude.roll_rad),
      after.pitch_rad - first.attitude.pitch_rad, after.heading_rad;
  messages::PoseCovariance by_motion = messages::PoseCovariance::Zero();
  by_motion.topLeftCorner<3, 3>() = R_FR0;
  by_motion.bottomRightCorner<3, 3>() = AnglesByTurns(after) * R_FR0;
  levelled.covariance = by_motion * motion.covariance * by_motion.transpose();
  const int z = Index(PoseCoordinate::kZ);
  levelled.covariance(z, z) += first.tilt_sd_rad * first.tilt_sd_rad * p_F.head<2>().squaredNorm();
  return levelled;
}

std::optional<MeasuredSlip> SlipOf(const Eigen::Vector2d& rolled_F,
                                   const messages::RelativeMotion& seen,
                                   const SlipCheckParams& params) {
  const double rolled_m = rolled_F.norm();
  if (!(rolled_m >= params.min_way_m)) return std::nullopt;
  const Eigen::Vector2d along = rolled_F / rolled_m;
  MeasuredSlip measured;
  measured.slip = 1.0 - seen.motion_F.head<2>().dot(along) / rolled_m;
  measured.sd = std::sqrt(along.dot(seen.covariance.topLeftCorner<2, 2>() * along)) / rolled_m;
  measured.exceeded = measured.slip - params.sigma * measured.sd > params.limit;
  return measured;
}

Eigen::Vector2d RolledWay(const messages::PoseEstimate& from, const messages::PoseEstimate& to) {
  const math::Pose2 step =
      math::SeenFrom({from.x_m, from.y_m, from.heading_rad}, {to.x_m, to.y_m, to.heading_rad});
  return {step.x_m, step.y_m};
}

}  // namespace rockyard::perception
