#include "localization/dead_reckoning_estimator.h"

#include <memory>

namespace rockyard::localization {

DeadReckoningEstimator::DeadReckoningEstimator(const EstimatorSetup& setup)
    : dead_reckoning_(setup.calibration, setup.dead_reckoning, setup.start),
      attitude_(setup.attitude),
      felt_pose_(dead_reckoning_.estimate()) {
  TakePose();
}

void DeadReckoningEstimator::Propagate(const messages::MotionMeasurement& motion) {
  dead_reckoning_.Integrate(motion);
  TakePose();
}

void DeadReckoningEstimator::Feel(const messages::VehicleState& felt, double duration_s) {
  attitude_.Integrate(felt, ForwardStep(felt_pose_, dead_reckoning_.estimate()), duration_s);
  felt_pose_ = dead_reckoning_.estimate();
  estimate_.attitude = attitude_.estimate();
}

void DeadReckoningEstimator::Place(const messages::PoseUpdate& update) {
  dead_reckoning_.Apply(update);
  attitude_.Restart();
  felt_pose_ = dead_reckoning_.estimate();
  TakePose();
}

void DeadReckoningEstimator::TakePose() {
  estimate_.pose = dead_reckoning_.estimate();
  estimate_.odometry = estimate_.pose;
}

EstimatorDescription<core::NoParams> DescribeDeadReckoning() {
  return {
      .name = "dead_reckoning",
      .doc = "wheels, gyro and accelerometers",
      .make = [](const core::NoParams&, const EstimatorSetup& setup) -> std::unique_ptr<Estimator> {
        return std::make_unique<DeadReckoningEstimator>(setup);
      }};
}

}  // namespace rockyard::localization
