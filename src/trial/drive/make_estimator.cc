#include "trial/drive/make_estimator.h"

#include <cmath>
#include <memory>

#include "core/check.h"
#include "localization/dead_reckoning.h"
#include "localization/error_state_filter.h"
#include "localization/visual_odometry_estimator.h"
#include "sensing/tracker.h"
#include "trial/drive_params.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::trial {

localization::EstimatorSetup EstimatorSetupOf(const DriveParams& drive,
                                              const localization::EstimatorMemory* memory) {
  localization::EstimatorSetup setup{
      .calibration = OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
      .dead_reckoning = drive.perception.dead_reckoning,
      .attitude = drive.perception.attitude,
      .start = drive.course.Start(),
      .call_cpu_s = drive.navigation.limits.decision_cpu_s,
      .drive_cpu_s = drive.navigation.limits.drive_cpu_s};
  if (const DesignationParams& designation = drive.course.designation; designation.enabled) {
    const messages::Goal lander = drive.course.LanderPlace();
    setup.lander = {.x_m = lander.x_m, .y_m = lander.y_m, .pan_sd_rad = designation.PanSd_rad()};
  }
  if (memory != nullptr) {
    setup.start = memory->pose;
    setup.memory = memory;
  }
  return setup;
}

std::unique_ptr<localization::Estimator> MakeEstimator(
    const DriveParams& drive, const rover::Rover& rover,
    const localization::EstimatorMemory* memory) {
  auto estimator = drive.localization.estimators.chosen().Make(EstimatorSetupOf(drive, memory));
  if (auto* oracle = dynamic_cast<OracleEstimator*>(estimator.get())) oracle->See(rover);
  return estimator;
}

OracleEstimator::OracleEstimator(const localization::EstimatorSetup& setup) {
  estimate_.covariance = messages::PoseCovariance::Zero();
  Place({setup.start.x_m, setup.start.y_m, setup.start.heading_rad});
}

void OracleEstimator::See(const rover::Rover& rover) {
  rover_ = &rover;
  start_z_m_ = rover.state().X_WR.translation().z();
  estimate_.attitude = sensing::TrueAttitude(rover.state(), start_z_m_);
}

void OracleEstimator::Propagate(const messages::MotionMeasurement& /*motion*/) {
  EXPECT(rover_ != nullptr);
  const messages::PoseEstimate before = estimate_.pose;
  Place(sensing::TruePose(rover_->state()));
  estimate_.pose.distance_m += std::abs(localization::ForwardStep(before, estimate_.pose));
  estimate_.odometry = estimate_.pose;
  estimate_.attitude = sensing::TrueAttitude(rover_->state(), start_z_m_);
}

void OracleEstimator::Place(const messages::PoseUpdate& update) {
  estimate_.pose.x_m = update.x_m;
  estimate_.pose.y_m = update.y_m;
  estimate_.pose.heading_rad = math::WrapAngle(update.heading_rad);
  estimate_.odometry = estimate_.pose;
}

localization::EstimatorDescription<core::NoParams> DescribeOracle() {
  return {.name = "oracle",
          .doc = "the true pose",
          .make = [](const core::NoParams&, const localization::EstimatorSetup& setup)
              -> std::unique_ptr<localization::Estimator> {
            return std::make_unique<OracleEstimator>(setup);
          }};
}

localization::EstimatorSet StandardEstimators() {
  localization::EstimatorSet set;
  set.Add(localization::DescribeDeadReckoning());
  set.Add(DescribeOracle());
  set.Add(localization::DescribeErrorStateFilter());
  set.Add(localization::DescribeVisualOdometry());
  return set;
}

}  // namespace rockyard::trial
