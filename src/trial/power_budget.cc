#include "trial/power_budget.h"

#include "rendering/imager_params.h"
#include "sensing/stripe_layout_params.h"

namespace rockyard::trial {

int EmittersAtOnce(const sensing::LightStripeParams& sensor) {
  const messages::StripeArraySize size = sensing::ArraySize(sensor);
  const int groups = sensing::LaserGroups(sensor);
  const int lasers = (static_cast<int>(size.stripes) + groups - 1) / groups;
  const bool one_a_point = sensor.laser.fan == sensing::BeamFan::kThreeScanlines;
  return one_a_point ? lasers * static_cast<int>(size.rows) : lasers;
}

double PowerBudget::Power(Activity activity) const {
  switch (activity) {
    case Activity::kDriving:
    case Activity::kTurning:
    case Activity::kStalled:
      return base_W + guards_W + driving_W;
    case Activity::kSteering:
      return base_W + guards_W + steering_W;
    case Activity::kScanning:
      return base_W + imaging_W + lasers_W;
    case Activity::kImaging:
      return base_W + stereo_imaging_W;
    case Activity::kComputing:
    case Activity::kOverhead:
      return base_W + computing_W;
  }
  return base_W;
}

double PowerBudget::PowerBeside(Activity activity) const {
  switch (activity) {
    case Activity::kSteering:
      return steering_W;
    case Activity::kImaging:
      return stereo_imaging_W;
    case Activity::kComputing:
      return computing_W;
    default:
      return 0.0;
  }
}

PowerBudget MakePowerBudget(const DriveParams& drive) {
  const EnergyParams& energy = drive.energy;
  const sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
  const bool cmos = sensor.imager.kind == rendering::ImagerKind::kCmos;
  return {.base_W = energy.cpu_W + energy.gyro_W,
          .guards_W = drive.sensors.vehicle.accelerometers.enabled ? energy.accelerometers_W : 0.0,
          .driving_W = energy.driving_W,
          .steering_W = energy.steering_W,
          .imaging_W = energy.imaging_W * (cmos ? energy.cmos_imaging_share : 1.0),
          .lasers_W =
              EmittersAtOnce(sensor) * sensor.laser.input_power_w / energy.laser_supply_efficiency,
          .stereo_imaging_W = energy.stereo_imaging_W,
          .computing_W = energy.computing_W};
}

}  // namespace rockyard::trial
