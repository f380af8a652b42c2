#include "localization/visual_odometry_estimator.h"

#include <memory>

#include "math/pose.h"

namespace rockyard::localization {
namespace {

using math::Pose2;
using messages::PoseCoordinate;

Pose2 PlanarStep(const messages::RelativeMotion& motion) {
  return {motion.motion_F[messages::Index(PoseCoordinate::kX)],
          motion.motion_F[messages::Index(PoseCoordinate::kY)],
          motion.motion_F[messages::Index(PoseCoordinate::kHeading)]};
}

Pose2 ToPose2(const messages::PoseEstimate& pose) { return {pose.x_m, pose.y_m, pose.heading_rad}; }

}  // namespace

VisualOdometryEstimator::VisualOdometryEstimator(const EstimatorSetup& setup)
    : wheels_(setup), estimate_(wheels_.estimate()) {}

Pose2 VisualOdometryEstimator::PoseNow() const { return ToPose2(estimate_.pose); }

void VisualOdometryEstimator::TakePose(const Pose2& pose) {
  estimate_.pose.x_m = pose.x_m;
  estimate_.pose.y_m = pose.y_m;
  estimate_.pose.heading_rad = pose.heading_rad;
}

void VisualOdometryEstimator::Propagate(const messages::MotionMeasurement& motion) {
  const Pose2 before = ToPose2(estimate_.odometry);
  wheels_.Propagate(motion);
  estimate_.odometry = wheels_.estimate().odometry;
  estimate_.pose.distance_m = estimate_.odometry.distance_m;
  // The wheels' step as seen from where they stood before, laid off from the corrected pose.
  TakePose(PoseNow() * math::SeenFrom(before, ToPose2(estimate_.odometry)));
}

void VisualOdometryEstimator::Feel(const messages::VehicleState& felt, double duration_s) {
  wheels_.Feel(felt, duration_s);
  estimate_.attitude = wheels_.estimate().attitude;
}

void VisualOdometryEstimator::Place(const messages::PoseUpdate& update) {
  wheels_.Place(update);
  estimate_ = wheels_.estimate();
  moments_.clear();
}

void VisualOdometryEstimator::Capture(messages::CaptureNumber capture) {
  moments_[capture] = PoseNow();
}

void VisualOdometryEstimator::Forget(messages::CaptureNumber capture) { moments_.erase(capture); }

AidUse VisualOdometryEstimator::Update(const messages::RelativeMotion& motion) {
  const auto from = moments_.find(motion.from);
  const auto to = moments_.find(motion.to);
  if (from == moments_.end() || to == moments_.end()) return AidUse::kUnknown;
  const Pose2 before = to->second;
  const Pose2 after = from->second * PlanarStep(motion);
  // Moments after `to` move along, as the next motion will begin at one of them.
  for (auto later = to; later != moments_.end(); ++later) {
    later->second = after * math::SeenFrom(before, later->second);
  }
  TakePose(after * math::SeenFrom(before, PoseNow()));
  return AidUse::kUsed;
}

EstimatorDescription<core::NoParams> DescribeVisualOdometry() {
  return {
      .name = "visual_odometry",
      .doc = "what visual odometry measures, and wheels and gyro where it found no motion",
      .make = [](const core::NoParams&, const EstimatorSetup& setup) -> std::unique_ptr<Estimator> {
        return std::make_unique<VisualOdometryEstimator>(setup);
      },
      .takes_motions = true};
}

}  // namespace rockyard::localization
