#include "rover/wheel_rut_params.h"

#include <algorithm>
#include <cmath>

#include "math/functions.h"

namespace rockyard::rover {

WheelRut::WheelRut(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m)
    : width_m_(wheel_width_m),
      diameter_m_(2.0 * wheel_radius_m),
      exponent_(soil.sinkage_exponent),
      per_slip_(soil.slip_sinkage.enabled ? soil.slip_sinkage.exponent_per_slip : 0.0),
      // b k = b (k_c / b + k_phi) = k_c + b k_phi, N/m^(n+1).
      modulus_(soil.cohesive_modulus_N_per_mn1 + wheel_width_m * soil.frictional_modulus_N_per_mn2),
      // Bekker 1969: N = (3 - n)/3 b k sqrt(D) z^(n + 1/2), without the power of z.
      load_factor_((3.0 - exponent_) / 3.0 * modulus_ * std::sqrt(diameter_m_)),
      cohesion_Pa_(soil.cohesion_Pa),
      tan_friction_(math::Tan(soil.friction_angle_rad)) {}

Rut WheelRut::RutUnder(double load_N) const {
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
  rut.contact_length_m = 0.5 * diameter_m_ * math::Acos(1.0 - depth);
  // Mohr and Coulomb over the contact area b l: T_max = b l c + N tan(phi).
  rut.largest_traction_N = width_m_ * rut.contact_length_m * cohesion_Pa_ + load_N * tan_friction_;
  return rut;
}

Rut WheelRut::RutUnder(double load_N, double dug_slip) const {
  Rut rut = RutUnder(load_N);
  // Records depend on it: without slip sinkage the bits are those of the law without slip.
  if (per_slip_ * dug_slip == 0.0) return rut;
  // Ding et al. 2010: n = n_0 + n_1 i, in Bekker's N = (3 - n)/3 b k sqrt(D) z^(n + 1/2) and
  // R = b k z^(n + 1)/(n + 1). Contact length and traction stay.
  const double n = exponent_ + per_slip_ * dug_slip;
  const double load_factor = (3.0 - n) / 3.0 * modulus_ * std::sqrt(diameter_m_);
  const double z_m = math::Pow(load_N / load_factor, 1.0 / (n + 0.5));
  rut.sinkage_m = std::min(z_m, std::max(rut.sinkage_m, 0.5 * diameter_m_));
  rut.stiffness_N_m = (n + 0.5) * load_N / rut.sinkage_m;
  rut.resistance_N = modulus_ * math::Pow(rut.sinkage_m, n + 1.0) / (n + 1.0);
  return rut;
}

double WheelRut::Sinkage_m(double load_N) const {
  // Bekker's law solved for z.
  return math::Pow(load_N / load_factor_, 1.0 / (exponent_ + 0.5));
}

double WheelRut::Resistance_N(double load_N) const { return RutUnder(load_N).resistance_N; }

double WheelRut::ContactLength_m(double load_N) const { return RutUnder(load_N).contact_length_m; }

double WheelRut::LargestTraction_N(double load_N) const {
  return RutUnder(load_N).largest_traction_N;
}

}  // namespace rockyard::rover
