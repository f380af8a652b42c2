#include "trial/oracle_estimator.h"

#include <cmath>
#include <memory>

#include "core/check.h"
#include "localization/attitude.h"
#include "sensing/oracle.h"

namespace rockyard::trial {

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

}  // namespace rockyard::trial
