#include "rover/wheel_soil.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
namespace {

// Below this u the closed form loses digits to cancellation; the series u/2 - u^2/6 has an error of
// u^3 / 24.
constexpr double kSeries = 1e-4;

}  // namespace

ShearShare ShareOfRatio(double u) {
  if (u < kSeries) return {u * (0.5 - u / 6.0), 0.5 - u / 3.0};
  // tau = 1 - (1 - e^-u) / u and, by the quotient rule, tau' = ((1 - e^-u) / u - e^-u) / u.
  const double loss = std::expm1(-u);  // e^-u - 1
  const double rest = -loss / u;
  return {1.0 - rest, (rest - loss - 1.0) / u};
}

double ShearRatio(double tau) {
  if (tau <= 0.0) return 0.0;
  // tau(u) is concave and increasing, so Newton from the left of the root stays there and converges
  // monotonically. Both starts are left of it: tau <= u / 2, and tau <= 1 - e^-u gives u = (1 -
  // e^-u) / (1 - tau) >= tau / (1 - tau).
  double u = std::max(2.0 * tau, tau / (1.0 - tau));
  for (int i = 0; i < 30; ++i) {
    const ShearShare share = ShareOfRatio(u);
    const double step = (tau - share.value) / share.slope;
    u += step;
    if (std::abs(step) <= 1e-12 * u) break;
  }
  return u;
}

WheelSoil::WheelSoil(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m)
    : width_m_(wheel_width_m),
      diameter_m_(2.0 * wheel_radius_m),
      exponent_(soil.sinkage_exponent),
      // b k = b (k_c / b + k_phi) = k_c + b k_phi, N/m^(n+1).
      modulus_(soil.cohesive_modulus_N_per_mn1 + wheel_width_m * soil.frictional_modulus_N_per_mn2),
      // Bekker 1969: N = (3 - n)/3 b k sqrt(D) z^(n + 1/2); this is all of it but the power of z.
      load_factor_((3.0 - exponent_) / 3.0 * modulus_ * std::sqrt(diameter_m_)),
      cohesion_Pa_(soil.cohesion_Pa),
      tan_friction_(std::tan(soil.friction_angle_rad)),
      shear_modulus_m_(soil.shear_modulus_m) {}

Rut WheelSoil::RutUnder(double load_N) const {
  Rut rut;
  rut.load_N = load_N;
  rut.sinkage_m = Sinkage_m(load_N);
  // dN/dz of the power law N ~ z^(n + 1/2).
  rut.stiffness_N_m = (exponent_ + 0.5) * load_N / rut.sinkage_m;
  // R = b k z^(n + 1) / (n + 1), with z^(n + 1) = N / load_factor * sqrt(z), which spares a second
  // power.
  rut.resistance_N =
      modulus_ / load_factor_ * load_N * std::sqrt(rut.sinkage_m) / (exponent_ + 1.0);
  // Chord of the level cut through the rut: the wheel meets the soil over the angle acos(1 - 2 z /
  // D) from the foremost contact to its lowest point. Deeper than D / 2 it stays at a quarter of
  // the rim.
  const double depth = std::min(2.0 * rut.sinkage_m / diameter_m_, 1.0);
  rut.contact_length_m = 0.5 * diameter_m_ * std::acos(1.0 - depth);
  // Mohr and Coulomb over the contact area b l: T_max = b l c + N tan(phi).
  rut.largest_traction_N = width_m_ * rut.contact_length_m * cohesion_Pa_ + load_N * tan_friction_;
  return rut;
}

double WheelSoil::Load_N(double sinkage_m) const {
  return load_factor_ * std::pow(sinkage_m, exponent_ + 0.5);
}

double WheelSoil::Sinkage_m(double load_N) const {
  // Bekker's law solved for z.
  return std::pow(load_N / load_factor_, 1.0 / (exponent_ + 0.5));
}

double WheelSoil::Resistance_N(double load_N) const { return RutUnder(load_N).resistance_N; }

double WheelSoil::ContactLength_m(double load_N) const { return RutUnder(load_N).contact_length_m; }

double WheelSoil::LargestTraction_N(double load_N) const {
  return RutUnder(load_N).largest_traction_N;
}

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

double WheelSoil::SlipPerShare(double slip, const Rut& rut) const {
  if (shear_modulus_m_ == 0.0) return 0.0;
  const double ratio = shear_modulus_m_ / rut.contact_length_m;
  // u = i l / K; tau tends to u / 2, so i / tau to 2 K / l.
  const double u = slip / ratio;
  return u == 0.0 ? 2.0 * ratio : slip / ShareOfRatio(u).value;
}

}  // namespace rockyard::rover
