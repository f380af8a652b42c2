// The estimator of a drive, and the oracle, an estimator that belongs to the trial. Drives make
// their estimator here, and missions let one go on between sols.
#pragma once

#include <memory>

#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "rover/rover.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Makes the estimator that the scenario names. It believes the rover to be where the course starts,
// or goes on by `memory` where that is not null. An oracle sees `rover`, which stands at the start
// of the course and outlives the estimator; all other estimators see what the rover measures.
std::unique_ptr<localization::Estimator> MakeEstimator(
    const DriveParams& drive, const rover::Rover& rover,
    const localization::EstimatorMemory* memory = nullptr);

// Returns what an estimator of that drive begins with; `memory`, which may be null, outlives it.
localization::EstimatorSetup EstimatorSetupOf(const DriveParams& drive,
                                              const localization::EstimatorMemory* memory);

// Perfect localization: an estimator that is told the true pose in all six degrees of freedom. The
// results of every run that uses it say so; no other estimator sees the truth.
class OracleEstimator final : public localization::Estimator {
 public:
  explicit OracleEstimator(const localization::EstimatorSetup& setup);

  // Sets the rover whose pose it tells; to be called before the first tick. `rover` stands where
  // the drive begins and outlives the estimator.
  void See(const rover::Rover& rover);

  // Takes the present true pose; the odometer grows by the displacement along the mean heading.
  void Propagate(const messages::MotionMeasurement& motion) override;
  void Feel(const messages::VehicleState& /*felt*/, double /*duration_s*/) override {}
  void Place(const messages::PoseUpdate& update) override;

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }

 private:
  const rover::Rover* rover_ = nullptr;
  double start_z_m_ = 0.0;
  messages::LocalizationEstimate estimate_;
};

// Describes the estimator that scenarios name oracle.
localization::EstimatorDescription<core::NoParams> DescribeOracle();

}  // namespace rockyard::trial
