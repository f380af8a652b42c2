#include "rover/wheel_soil.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
WheelSoil::WheelSoil(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m)
    : WheelRut(soil, wheel_radius_m, wheel_width_m), shear_modulus_m_(soil.shear_modulus_m) {}

double WheelSoil::ShearRatioOfFullSlip(double load_N) const {
  return ContactLength_m(load_N) / shear_modulus_m_;
}

double WheelSoil::TractionShare(double slip, double load_N) const {
  if (slip <= 0.0) return 0.0;
  // K = 0: the soil shears without deformation, so any slip mobilizes all of its strength.
  if (shear_modulus_m_ == 0.0) return 1.0;
  return ShareOfRatio(slip * ShearRatioOfFullSlip(load_N)).value;
}

double WheelSoil::Slip(double tau, double load_N) const {
  if (tau <= 0.0 || load_N <= 0.0) return 0.0;
  // More than full slip mobilizes: the wheel spins on the spot.
  if (tau >= TractionShare(1.0, load_N)) return 1.0;
  // i = u K / l.
  return std::min(1.0, shear_modulus_m_ / ContactLength_m(load_N) * ShearRatio(tau));
}

double WheelSoil::SlipPerShare(double slip, const Rut& rut, const ShareTable& shares) const {
  if (shear_modulus_m_ == 0.0) return 0.0;
  const double ratio = shear_modulus_m_ / rut.contact_length_m;
  // u = i l / K; tau tends to u / 2, so i / tau to 2 K / l.
  const double u = slip / ratio;
  return u == 0.0 ? 2.0 * ratio : slip / shares.At(u).value;
}

}  // namespace rockyard::rover
