#include "trial/clock/power.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "math/functions.h"
#include "math/sun_position.h"
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

namespace {

constexpr double kSecondsPerRadian = math::kSolOfMars_s / (2.0 * std::numbers::pi);

}  // namespace

SolarSupply::SolarSupply(double noon_W, double latitude_rad, double declination_rad,
                         double start_solar_time_h)
    : noon_W_(noon_W),
      a_(math::Sin(latitude_rad) * math::Sin(declination_rad)),
      b_(math::Cos(latitude_rad) * math::Cos(declination_rad)),
      start_rad_((start_solar_time_h - 12.0) * std::numbers::pi / 12.0) {
  EXPECT(noon_W >= 0.0 && b_ > 0.0 && a_ + b_ > 0.0);
}

double SolarSupply::HourAngle(double time_s) const {
  return start_rad_ + time_s / kSecondsPerRadian;
}

double SolarSupply::Power_W(double time_s) const {
  return noon_W_ * std::max(0.0, a_ + b_ * math::Cos(HourAngle(time_s))) / (a_ + b_);
}

double SolarSupply::CarryingAngle(double power_W) const {
  if (noon_W_ <= 0.0) return 0.0;
  const double cosine = (power_W / noon_W_ * (a_ + b_) - a_) / b_;
  return math::Acos(std::clamp(cosine, -1.0, 1.0));
}

double SolarSupply::Carries_s(double load_W) const {
  return CarryingAngle(load_W) * kSecondsPerRadian;
}

double SolarSupply::ShortSinceNoon_J(double load_W, double hour_angle_rad) const {
  // Every whole sol has the same shortfall, twice that from noon to midnight.
  const double sols = std::round(hour_angle_rad / (2.0 * std::numbers::pi));
  const double within = hour_angle_rad - 2.0 * std::numbers::pi * sols;
  const double carrying = CarryingAngle(load_W);
  const double sunset = CarryingAngle(0.0);
  // The shortfall from noon to h >= 0: nothing as long as the sun carries the load, then the load
  // less S. The closed form lets a drive or a night cut into pieces add up to the whole.
  const auto from_noon = [&](double h) {
    if (h <= carrying) return 0.0;
    const double sun_end = std::max(carrying, std::min(h, sunset));
    const double sun = a_ * (sun_end - carrying) + b_ * (math::Sin(sun_end) - math::Sin(carrying));
    return load_W * (h - carrying) - noon_W_ / (a_ + b_) * sun;
  };
  const double whole = sols == 0.0 ? 0.0 : 2.0 * sols * from_noon(std::numbers::pi);
  return kSecondsPerRadian * (whole + std::copysign(from_noon(std::abs(within)), within));
}

double SolarSupply::Energy_J(double begin_s, double end_s) const {
  return Used_J(noon_W_, begin_s, end_s);
}

double SolarSupply::Used_J(double load_W, double begin_s, double end_s) const {
  return load_W * (end_s - begin_s) - Shortfall_J(load_W, begin_s, end_s);
}

double SolarSupply::Shortfall_J(double load_W, double begin_s, double end_s) const {
  EXPECT(load_W >= 0.0 && end_s >= begin_s);
  const double short_J =
      ShortSinceNoon_J(load_W, HourAngle(end_s)) - ShortSinceNoon_J(load_W, HourAngle(begin_s));
  return std::max(0.0, short_J);
}

}  // namespace rockyard::trial
