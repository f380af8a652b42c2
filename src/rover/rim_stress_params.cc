#include "rover/rim_stress_params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "math/functions.h"

namespace rockyard::rover {
namespace {

using terrain::SoilPressure;
using terrain::WheelLaw;

// Points of the midpoint rule over the arc in the soil: loads within 0.15 % of those of 400 points,
// pull and traction within 0.7 % of the load.
constexpr int kPoints = 20;

// Generic coefficients of resistive force theory, over the stress on a level plate that sinks (Li,
// Zhang and Goldman 2013, supplement, table S3).
constexpr double kA00 = 0.206, kA10 = 0.169;
constexpr double kB11 = 0.212, kB01 = 0.358, kBm11 = 0.055;
constexpr double kC11 = -0.124, kC01 = 0.253, kCm11 = 0.007, kD10 = 0.088;
// Shear over pressure of a level plate that slides, and stress on an upright one.
constexpr double kLevelSliding = (kC11 + kC01 + kCm11) / (kA00 + kA10);
constexpr double kUpright = -kC11 + kC01 - kCm11;

// Angle of largest stress over theta_1, loose sand (Wong and Reece 1967).
constexpr double kPeak = 0.18;
constexpr double kPeakPerSlip = 0.32;

// Friction of soil on metal, as a share of its own angle (Potyondy 1961, smooth steel: 0.54 to
// 0.76).
constexpr double kSmoothRim = 2.0 / 3.0;
// Length of soil that a lug holds, in its height: traction of lugs of tracks is best at spacings of
// four to six heights. Assumed.
constexpr double kHeldLength = 5.0;

// Returns the share of the rim that lugs cover with soil.
double LuggedShare(const RimShape& wheel) {
  const double spacing_m = 2.0 * std::numbers::pi * wheel.radius_m;
  return std::min(1.0, kHeldLength * wheel.lug_height_m * wheel.lug_count / spacing_m);
}

// Pressure of a granular soil per depth, Pa/m (Agarwal, Goldman and Kamrin 2023).
double GranularModulus(const terrain::SoilParams& soil, double gravity_m_s2) {
  const double mu = math::Tan(soil.friction_angle_rad);
  return soil.density_kg_m3 * gravity_m_s2 * mu * (89.0 + mu * (-386.0 + mu * 894.0));
}

}  // namespace

RimStress::RimStress(const terrain::SoilParams& soil, const RimShape& wheel, double gravity_m_s2)
    : law_(soil.law),
      radius_m_(wheel.radius_m),
      width_m_(wheel.width_m),
      modulus_(soil.cohesive_modulus_N_per_mn1 / wheel.width_m + soil.frictional_modulus_N_per_mn2),
      exponent_(soil.sinkage_exponent),
      friction_(math::Tan(soil.friction_angle_rad)),
      cohesion_Pa_(soil.cohesion_Pa),
      shear_modulus_m_(soil.shear_modulus_m) {
  if (soil.pressure == SoilPressure::kDensity) {
    modulus_ = GranularModulus(soil, gravity_m_s2);
    exponent_ = 1.0;
  }
  if (law_ == WheelLaw::kIntrusion) {
    const double lugged = LuggedShare(wheel);
    const double rough = math::Sin(soil.friction_angle_rad);
    const double smooth = math::Tan(kSmoothRim * soil.friction_angle_rad);
    friction_ = lugged * rough + (1.0 - lugged) * smooth;
    cohesion_Pa_ *= lugged + (1.0 - lugged) * kSmoothRim;
  }
}

double RimStress::Pressure(double depth_m) const {
  return modulus_ * (exponent_ == 1.0 ? depth_m : math::Pow(depth_m, exponent_));
}

RimStress::Stress RimStress::Granular(const RimPoint& at, double rim) const {
  // Velocity of the point over that of the axle.
  const double forward = 1.0 - rim * at.cos;
  const double downward = rim * at.sin;
  // The functions are those of a surface that moves forward; one that moves back is its mirror
  // image. With the tilt beta = theta of the rim and the direction gamma of its motion below level,
  //   alpha_z = A00 + A10 cos 2b + B11 sin(2b + g) + B01 sin g + B-11 sin(-2b + g),
  //   alpha_x = C11 cos(2b + g) + C01 cos g + C-11 cos(-2b + g) + D10 sin 2b.
  const double mirror = forward >= 0.0 ? 1.0 : -1.0;
  const double inverse = 1.0 / std::sqrt(forward * forward + downward * downward);
  const double cos_g = std::abs(forward) * inverse;
  const double sin_g = downward * inverse;
  const double cos_2b = at.cos * at.cos - at.sin * at.sin;
  const double sin_2b = mirror * 2.0 * at.sin * at.cos;
  const double cc = cos_2b * cos_g;
  const double cs = cos_2b * sin_g;
  const double sc = sin_2b * cos_g;
  const double ss = sin_2b * sin_g;
  const double up = kA00 + kA10 * cos_2b + kB11 * (sc + cs) + kB01 * sin_g + kBm11 * (cs - sc);
  const double back =
      mirror * (kC11 * (cc - ss) + kC01 * cos_g + kCm11 * (cc + ss) + kD10 * sin_2b);
  const double normal = std::max(up * at.cos + back * at.sin, 0.0);
  const double along = up * at.sin - back * at.cos;
  if (law_ == WheelLaw::kResistiveForce) return {at.pressure_Pa * normal, at.pressure_Pa * along};
  const double normal_Pa = at.pressure_Pa * normal;
  if (normal_Pa == 0.0) return {0.0, 0.0};
  const double mobilized = std::clamp(along / (normal * kLevelSliding), -1.0, 1.0);
  return {normal_Pa, (cohesion_Pa_ + normal_Pa * friction_) * mobilized};
}

RimStress::Stress RimStress::WongReece(const RimPoint& at, double entry_rad, double slip) const {
  const double peak_rad = (kPeak + kPeakPerSlip * std::abs(slip)) * entry_rad;
  // Behind the peak the stress is that as far ahead of it, the arc behind taken as long as the one
  // ahead.
  double normal_Pa = at.pressure_Pa;
  if (at.angle_rad < peak_rad) {
    const double ahead_rad = entry_rad - at.angle_rad / peak_rad * (entry_rad - peak_rad);
    normal_Pa = Pressure(std::max(radius_m_ * (math::Cos(ahead_rad) - math::Cos(entry_rad)), 0.0));
  }
  // Way of the rim over the soil since it met it; for a wheel that skids over that of the axle.
  const double rim = slip >= 0.0 ? 1.0 : 1.0 / (1.0 + slip);
  const double way = (slip >= 0.0 ? 1.0 - slip : 1.0) * rim;
  const double j_m = radius_m_ * (entry_rad - at.angle_rad - way * (math::Sin(entry_rad) - at.sin));
  const double share = shear_modulus_m_ == 0.0 ? (j_m == 0.0 ? 0.0 : 1.0)
                                               : -math::Expm1(-std::abs(j_m) / shear_modulus_m_);
  return {normal_Pa, std::copysign((cohesion_Pa_ + normal_Pa * friction_) * share, j_m)};
}

std::vector<RimForces> RimStress::At(double entry_rad, std::span<const double> slips) const {
  const double step_rad = entry_rad / kPoints;
  const double cos_entry = math::Cos(entry_rad);
  std::array<RimPoint, kPoints> points{};
  double side_N = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle_rad = (static_cast<double>(i) + 0.5) * step_rad;
    const double cos = math::Cos(angle_rad);
    const double depth_m = radius_m_ * (cos - cos_entry);
    points[i] = {angle_rad, math::Sin(angle_rad), cos, Pressure(depth_m)};
    // A column of the side face, as wide as the rim is long there, ahead and behind.
    side_N += 2.0 * kUpright * points[i].pressure_Pa * depth_m / (exponent_ + 1.0) * cos;
  }
  side_N *= law_ == WheelLaw::kWongReece ? 0.0 : radius_m_ * step_rad;
  const double area_m2 = radius_m_ * width_m_ * step_rad;
  std::vector<RimForces> forces;
  forces.reserve(slips.size());
  for (const double slip : slips) {
    const double rim = slip >= 0.0 ? 1.0 / (1.0 - slip) : 1.0 + slip;
    RimForces sum;
    for (const RimPoint& point : points) {
      const Stress stress =
          law_ == WheelLaw::kWongReece ? WongReece(point, entry_rad, slip) : Granular(point, rim);
      sum.load_N += stress.normal_Pa * point.cos + stress.shear_Pa * point.sin;
      sum.pull_N += stress.shear_Pa * point.cos - stress.normal_Pa * point.sin;
      sum.gross_N += stress.shear_Pa;
    }
    forces.push_back({area_m2 * sum.load_N, area_m2 * sum.pull_N, area_m2 * sum.gross_N, side_N});
  }
  return forces;
}

}  // namespace rockyard::rover
