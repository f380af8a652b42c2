// The rut of a rigid wheel in soil: sinkage, motion resistance and largest traction by the wheel's
// load. Both fidelities, and the condition that the soil holds a braked rover on its slope, go by
// it.
//
// Sinkage (Bekker 1969; Wong 2008 sec. 2.5): plates sink under the pressure p = k z^n with
// k = k_c / b + k_phi, and a wheel of diameter D and width b carries
//   W(z) = (3 - n) / 3 * b k sqrt(D) z^(n + 1/2).
// Resistance, by the work of compacting a rut: R = b k z^(n + 1) / (n + 1).
// Largest traction (Mohr and Coulomb): T_max = b l c + W tan(phi), with the contact length
// l = (D / 2) acos(1 - 2 z / D) of a wheel in its rut.
//
// Slip sinkage (terrain.ground.soil.slip_sinkage; Ding, Gao, Deng and Tao 2010): under a wheel that
// has dug in for the slip i the exponent is n = n_0 + n_1 i, with k as before, so that the wheel
// sinks deeper under the same load, and R grows with z. T_max stays that of the rut without slip:
// here the law differs from Ding's, in which the longer contact also pulls more. Sand that has been
// dug away has failed already, and a wheel that pulled better the deeper it dug would never be
// embedded.
//
// Limits: steady state; level cut through the rut, no bulldozing wave ahead of it, no ruts left by
// wheels ahead; z well below D (the formula's own limit is about D / 6).
#pragma once

#include "terrain/soil_params.h"

namespace rockyard::rover {

// What a wheel meets under one load.
struct Rut {
  double load_N = 0.0;
  double sinkage_m = 0.0;
  double stiffness_N_m = 0.0;  // slope dN / dz of the load over the sinkage
  double resistance_N = 0.0;
  double contact_length_m = 0.0;
  double largest_traction_N = 0.0;
};

// The law of the rut for one kind of wheel in one soil.
class WheelRut {
 public:
  // Radius and width are positive, m; the soil lies within the bounds of SoilParams::Visit.
  WheelRut(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m);

  // Returns what the wheel meets under a load > 0. All fields but the stiffness grow with the load.
  // A call costs about 60 ns.
  Rut RutUnder(double load_N) const;
  // Returns the rut of a wheel that has dug in for a slip in [0, 1]: deeper, with more resistance.
  // Slip deepens it no further than to the wheel's radius, where the axle meets the ground. Must
  // stay: at a slip of 0, and with slip sinkage off, it has the bits of RutUnder(load_N).
  Rut RutUnder(double load_N, double dug_slip) const;

  // These return single fields of the rut, for a load >= 0.
  double Sinkage_m(double load_N) const;
  double Resistance_N(double load_N) const;
  double ContactLength_m(double load_N) const;
  double LargestTraction_N(double load_N) const;

 private:
  double width_m_;
  double diameter_m_;
  double exponent_;      // n_0
  double per_slip_;      // n_1; 0: slip does not dig in
  double modulus_;       // b k, N/m^(n+1)
  double load_factor_;   // W(z) / z^(n + 1/2)
  double cohesion_Pa_;   // c
  double tan_friction_;  // tan(phi)
};

}  // namespace rockyard::rover
