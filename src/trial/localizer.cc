#include "trial/localizer.h"

#include "sensing/oracle.h"
#include "trial/onboard_calibration.h"

namespace rockyard::trial {

Localizer::Localizer(const DriveParams& drive, const math::Pose2& start)
    : oracle_(drive.sensors.localization == Localization::kOracle),
      dead_reckoning_(OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
                      drive.perception.dead_reckoning, start),
      attitude_(drive.perception.attitude),
      last_pose_(dead_reckoning_.estimate()) {}

void Localizer::Place(const truth::RoverState& state) {
  start_z_m_ = state.X_WR.translation().z();
  true_attitude_ = sensing::TrueAttitude(state, start_z_m_);
}

void Localizer::Integrate(const messages::MotionMeasurement& motion,
                          const truth::RoverState& state) {
  if (!oracle_) {
    dead_reckoning_.Integrate(motion);
    return;
  }
  dead_reckoning_.Follow(sensing::TruePose(state));
  true_attitude_ = sensing::TrueAttitude(state, start_z_m_);
}

void Localizer::UpdateAttitude(const messages::VehicleState& felt, double duration_s) {
  attitude_.Integrate(felt, perception::ForwardStep(last_pose_, pose()), duration_s);
  last_pose_ = pose();
}

double Localizer::HeightError(const truth::RoverState& state) const {
  return attitude().z_m - (state.X_WR.translation().z() - start_z_m_);
}

void Localizer::Apply(const messages::PoseUpdate& update) {
  dead_reckoning_.Apply(update);
  attitude_.Restart();
  last_pose_ = pose();
}

}  // namespace rockyard::trial
