// The estimator of a drive.
#pragma once

#include <memory>

#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "rover/rover.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Returns the one that the scenario names. An oracle sees `rover`, which stands at the start of the
// course and outlives it; all others see what the rover measures. They believe to be where the
// course starts, or go on by `memory` where it is not null.
std::unique_ptr<localization::Estimator> MakeEstimator(
    const DriveParams& drive, const rover::Rover& rover,
    const localization::EstimatorMemory* memory = nullptr);

// What an estimator of that drive begins with; `memory`, which may be null, outlives its use.
localization::EstimatorSetup EstimatorSetupOf(const DriveParams& drive,
                                              const localization::EstimatorMemory* memory);

// Perfect localization: an estimator that is told the truth, all six degrees of freedom of it. A
// sensor without noise, marked in the results of every run that uses it; no other estimator sees
// the truth.
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
