// Perfect localization: an estimator that is told the truth. A sensor without noise, marked in the
// results of every run that uses it.
#pragma once

#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "rover/rover.h"

namespace rockyard::trial {

// All six degrees of freedom of the true pose; the only estimator that sees the truth.
class OracleEstimator final : public localization::Estimator {
 public:
  explicit OracleEstimator(const localization::EstimatorSetup& setup);

  // Needed before the first tick; `rover`, which stands where the drive begins, outlives this.
  void See(const rover::Rover& rover);

  // Takes the true pose of now; the odometer grows by the displacement along the mean heading.
  void Propagate(const messages::MotionMeasurement& motion) override;
  void Feel(const messages::VehicleState& /*felt*/, double /*duration_s*/) override {}
  void Place(const messages::PoseUpdate& update) override;

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }

 private:
  const rover::Rover* rover_ = nullptr;
  double start_z_m_ = 0.0;
  messages::LocalizationEstimate estimate_;
};

// Named oracle.
localization::EstimatorDescription<core::NoParams> DescribeOracle();

}  // namespace rockyard::trial
