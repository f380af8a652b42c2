// Cross section of a laser beam: light per radian of the angle out of the light plane.
#pragma once

#include <cmath>
#include <numbers>

#include "sensing/laser_params.h"

namespace rockyard::sensing {

// How the light of a beam is spread across the light plane. Both profiles carry the power 1.
// Gaussian: f(a) = exp(-a^2 / 2 s^2) / (s sqrt(2 pi)) with s = w / 4, so that the width w lies
// between the points at 1/e2 of the peak (ISO 11146: 4 s); it is cut off at 5 s, which drops 6e-7
// of the light. Top hat: 1 / w within w / 2.
class BeamCrossSection {
 public:
  BeamCrossSection(BeamProfile profile, double width_rad)
      : profile_(profile), width_rad_(width_rad), sigma_rad_(0.25 * width_rad) {}

  // Returns the angle beyond which there is no light.
  double reach_rad() const {
    return profile_ == BeamProfile::kTopHat ? 0.5 * width_rad_ : 5.0 * sigma_rad_;
  }

  // Returns f at an angle, 1/rad.
  double Density(double angle_rad) const {
    if (std::abs(angle_rad) > reach_rad()) return 0.0;
    if (profile_ == BeamProfile::kTopHat) return 1.0 / width_rad_;
    const double x = angle_rad / sigma_rad_;
    return std::exp(-0.5 * x * x) / (sigma_rad_ * std::sqrt(2.0 * std::numbers::pi));
  }

  // Returns the integral of f up to the angle, C.
  double Cumulative(double angle_rad) const {
    if (angle_rad <= -reach_rad()) return 0.0;
    if (angle_rad >= reach_rad()) return 1.0;
    if (profile_ == BeamProfile::kTopHat) return 0.5 + angle_rad / width_rad_;
    return 0.5 * std::erfc(-angle_rad / (sigma_rad_ * std::numbers::sqrt2));
  }

  // Returns the mean of f between two angles, 1/rad: what a pixel between them sees.
  double Mean(double from_rad, double to_rad) const {
    constexpr double kPoint_rad = 1e-9;
    const double width_rad = to_rad - from_rad;
    if (std::abs(width_rad) < kPoint_rad) return Density(from_rad);
    return (Cumulative(to_rad) - Cumulative(from_rad)) / width_rad;
  }

 private:
  BeamProfile profile_;
  double width_rad_;
  double sigma_rad_;
};

}  // namespace rockyard::sensing
