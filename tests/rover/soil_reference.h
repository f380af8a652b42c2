// The wheel-soil model once more, plainly: every quantity from its definition by bisection or by a
// sum over the rut, to compare rover/wheel_soil.h and the moving rover with.
#pragma once

#include <cmath>
#include <functional>

#include "messages/wheels.h"
#include "rover/wheel_soil.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// Where an increasing function crosses zero within [low, high].
inline double Bisect(double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Integral of f from 0 to b by the midpoint rule.
inline double Integrate(double b, const std::function<double(double)>& f) {
  constexpr int kCells = 4000;
  double sum = 0.0;
  for (int i = 0; i < kCells; ++i) sum += f(b * (i + 0.5) / kCells);
  return sum * b / kCells;
}

// A preset's soil by Bekker's law, whose closed form this file has.
inline terrain::SoilParams BekkerSoil(
    terrain::SoilPreset preset = terrain::SoilPreset::kLandscapingSand) {
  terrain::SoilParams soil = terrain::MakeSoil(preset);
  soil.law = terrain::WheelLaw::kBekker;
  return soil;
}

// What the rover makes of Bekker's law under one wheel.
class BekkerWheel : public WheelRut {
 public:
  BekkerWheel(const terrain::SoilParams& soil, double radius_m, double width_m)
      : WheelRut(soil, radius_m, width_m), shear_modulus_m_(soil.shear_modulus_m) {}

  double ShearRatio(double load_N) const { return ContactLength_m(load_N) / shear_modulus_m_; }
  double TractionShare(double slip, double load_N) const {
    if (slip <= 0.0) return 0.0;
    if (shear_modulus_m_ == 0.0) return 1.0;
    return ShareOfRatio(slip * ShearRatio(load_N)).value;
  }

 private:
  double shear_modulus_m_;
};

struct SoilReference {
  terrain::SoilParams soil = BekkerSoil();
  double radius_m = 0.065;
  double width_m = 0.08;

  // b p(z), the pressure of a plate across the wheel (Bekker), N/m.
  double LinePressure(double z_m) const {
    return (soil.cohesive_modulus_N_per_mn1 + width_m * soil.frictional_modulus_N_per_mn2) *
           std::pow(z_m, soil.sinkage_exponent);
  }
  // W(z) = (3 - n) / 3 * b p(z) * sqrt(D z).
  double Load(double z_m) const {
    return (3.0 - soil.sinkage_exponent) / 3.0 * LinePressure(z_m) *
           std::sqrt(2.0 * radius_m * z_m);
  }
  double Sinkage(double load_N) const {
    return Bisect(0.0, radius_m, [&](double z_m) { return Load(z_m) - load_N; });
  }
  // Work per length of pressing a plate down to z.
  double Resistance(double load_N) const {
    return Integrate(Sinkage(load_N), [&](double z) { return LinePressure(z); });
  }
  // From the lowest point of the rim up to the surface: cos(angle) = 1 - z / r.
  double ContactLength(double load_N) const {
    return radius_m * std::acos(1.0 - Sinkage(load_N) / radius_m);
  }
  double LargestTraction(double load_N) const {
    return width_m * ContactLength(load_N) * soil.cohesion_Pa +
           load_N * std::tan(soil.friction_angle_rad);
  }
  // Mean of 1 - exp(-j / K) over the rut, in which the shear displacement j grows to slip * l.
  double Share(double slip, double load_N) const {
    if (slip < 0.0) return -Share(-slip, load_N);
    if (soil.shear_modulus_m == 0.0) return slip > 0.0 ? 1.0 : 0.0;
    const double l = ContactLength(load_N);
    return Integrate(l,
                     [&](double x) { return 1.0 - std::exp(-slip * x / soil.shear_modulus_m); }) /
           l;
  }

  using Loads = messages::PerWheel<double>;

  double SumResistance(const Loads& loads_N) const {
    double sum = 0.0;
    for (const double load : loads_N) sum += Resistance(load);
    return sum;
  }
  // Pull of six wheels at a common slip, without resistance.
  double Traction(double slip, const Loads& loads_N) const {
    double sum = 0.0;
    for (const double load : loads_N) sum += Share(slip, load) * LargestTraction(load);
    return sum;
  }
  // Slip at which six wheels pull with that force; 1 where they cannot. Where they hold the rover
  // back, it runs ahead of its rims by the same law: negative.
  double SlipForPull(double pull_N, const Loads& loads_N) const {
    if (pull_N < 0.0) return -SlipForPull(-pull_N, loads_N);
    return Bisect(0.0, 1.0, [&](double slip) { return Traction(slip, loads_N) - pull_N; });
  }
};

}  // namespace rockyard::rover
