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

double SolarSupply::UsedSinceNoon_J(double load_W, double hour_angle_rad) const {
  // Every whole sol holds the same, twice that of noon to midnight.
  const double sols = std::round(hour_angle_rad / (2.0 * std::numbers::pi));
  const double within = hour_angle_rad - 2.0 * std::numbers::pi * sols;
  const double carrying = CarryingAngle(load_W);
  const double sunset = CarryingAngle(0.0);
  // Integral of min(load, S) dH from 0 to h >= 0: the load up to where S falls below it, then S.
  const auto from_noon = [&](double h) {
    const double load_end = std::min(h, carrying);
    const double sun_end = std::max(load_end, std::min(h, sunset));
    const double sun = a_ * (sun_end - load_end) + b_ * (std::sin(sun_end) - std::sin(load_end));
    return load_W * load_end + noon_W_ / (a_ + b_) * sun;
  };
  const double whole = sols == 0.0 ? 0.0 : 2.0 * sols * from_noon(std::numbers::pi);
  return kSecondsPerRadian * (whole + std::copysign(from_noon(std::abs(within)), within));
}

double SolarSupply::Energy_J(double begin_s, double end_s) const {
  return Used_J(noon_W_, begin_s, end_s);
}

double SolarSupply::Used_J(double load_W, double begin_s, double end_s) const {
  EXPECT(load_W >= 0.0 && end_s >= begin_s);
  return UsedSinceNoon_J(load_W, HourAngle(end_s)) - UsedSinceNoon_J(load_W, HourAngle(begin_s));
}

double SolarSupply::Shortfall_J(double load_W, double begin_s, double end_s) const {
  return std::max(0.0, load_W * (end_s - begin_s) - Used_J(load_W, begin_s, end_s));
}

}  // namespace rockyard::trial
