#include "trial/solar_supply.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "math/sun_position.h"

namespace rockyard::trial {
namespace {

constexpr double kSecondsPerRadian = math::kSolOfMars_s / (2.0 * std::numbers::pi);

}  // namespace

SolarSupply::SolarSupply(double noon_W, double latitude_rad, double declination_rad,
                         double start_solar_time_h)
    : noon_W_(noon_W),
      a_(std::sin(latitude_rad) * std::sin(declination_rad)),
      b_(std::cos(latitude_rad) * std::cos(declination_rad)),
      start_rad_((start_solar_time_h - 12.0) * std::numbers::pi / 12.0) {
  EXPECT(noon_W >= 0.0 && b_ > 0.0 && a_ + b_ > 0.0);
}

double SolarSupply::HourAngle(double time_s) const {
  return start_rad_ + time_s / kSecondsPerRadian;
}

double SolarSupply::Power_W(double time_s) const {
  return noon_W_ * std::max(0.0, a_ + b_ * std::cos(HourAngle(time_s))) / (a_ + b_);
}

double SolarSupply::CarryingAngle(double power_W) const {
  if (noon_W_ <= 0.0) return 0.0;
  const double cosine = (power_W / noon_W_ * (a_ + b_) - a_) / b_;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

double SolarSupply::Carries_s(double load_W) const {
  return CarryingAngle(load_W) * kSecondsPerRadian;
}

double SolarSupply::ShortSinceNoon_J(double load_W, double hour_angle_rad) const {
  // Every whole sol holds the same, twice that of noon to midnight.
  const double sols = std::round(hour_angle_rad / (2.0 * std::numbers::pi));
  const double within = hour_angle_rad - 2.0 * std::numbers::pi * sols;
  const double carrying = CarryingAngle(load_W);
  const double sunset = CarryingAngle(0.0);
  // From 0 to h >= 0: nothing as long as the sun carries the load, then the load less S.
  const auto from_noon = [&](double h) {
    if (h <= carrying) return 0.0;
    const double sun_end = std::max(carrying, std::min(h, sunset));
    const double sun = a_ * (sun_end - carrying) + b_ * (std::sin(sun_end) - std::sin(carrying));
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
