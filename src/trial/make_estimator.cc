#include "trial/make_estimator.h"

#include "trial/onboard_calibration.h"
#include "trial/oracle_estimator.h"

namespace rockyard::trial {

localization::EstimatorSetup EstimatorSetupOf(const DriveParams& drive,
                                              const localization::EstimatorMemory* memory) {
  localization::EstimatorSetup setup{
      .calibration = OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
      .dead_reckoning = drive.perception.dead_reckoning,
      .attitude = drive.perception.attitude,
      .start = drive.course.Start()};
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

}  // namespace rockyard::trial
