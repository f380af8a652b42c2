// A rigid wheel on soil: sinkage, motion resistance, traction and slip as functions of its load.
//
// Sinkage (Bekker 1969; Wong 2008 sec. 2.5): plates sink under the pressure p = k z^n with
// k = k_c / b + k_phi, and a wheel of diameter D and width b carries
//   W(z) = (3 - n) / 3 * b k sqrt(D) z^(n + 1/2).
// Resistance, by the work of compacting a rut: R = b k z^(n + 1) / (n + 1).
// Largest traction (Mohr and Coulomb): T_max = b l c + W tan(phi), with the contact length
// l = (D / 2) acos(1 - 2 z / D) of a wheel in its rut.
// Slip (Janosi and Hanamoto 1961, uniform pressure along l): T = tau T_max with
//   tau = 1 - (1 - e^-u) / u,   u = i l / K,   i = 1 - v / (omega r).
//
// Limits: steady state; level cut through the rut, no bulldozing wave ahead of it, no ruts left by
// wheels ahead, no sinkage by slip; z well below D (the formula's own limit is about D / 6).
#pragma once

#include "terrain/soil_params.h"

namespace rockyard::rover {

// What a wheel meets under one load.
struct Rut {
  double load_N = 0.0;
  double sinkage_m = 0.0;
  // The slope dN / dz of the load over the sinkage.
  double stiffness_N_m = 0.0;
  double resistance_N = 0.0;
  double contact_length_m = 0.0;
  double largest_traction_N = 0.0;
};

// One kind of wheel on one soil.
class WheelSoil {
 public:
  // Radius and width are positive, m; the soil lies within the bounds of its Visit.
  WheelSoil(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m);

  // Returns all that the wheel meets under a load > 0. All fields but the stiffness grow with the
  // load. A call costs about 60 ns.
  Rut RutUnder(double load_N) const;
  // Returns the load at which the wheel sinks by z >= 0: the inverse of Sinkage_m.
  double Load_N(double sinkage_m) const;

  // These return single fields of the rut, for a load >= 0.
  double Sinkage_m(double load_N) const;
  double Resistance_N(double load_N) const;
  double ContactLength_m(double load_N) const;
  double LargestTraction_N(double load_N) const;
  // Returns l / K, the u at a slip of 1; infinite where K is 0.
  double ShearRatioOfFullSlip(double load_N) const;

  // Slip returns the slip in [0, 1] that mobilizes the share tau of the largest traction: 1 where
  // the wheel spins on the spot. TractionShare is its inverse: the share that a slip mobilizes.
  double Slip(double tau, double load_N) const;
  double TractionShare(double slip, double load_N) const;

  // Returns i / tau at the slip i >= 0; its limit at i = 0 is 2 K / l.
  double SlipPerShare(double slip, const Rut& rut) const;

 private:
  double width_m_;
  double diameter_m_;
  double exponent_;         // n
  double modulus_;          // b k, N/m^(n+1)
  double load_factor_;      // W(z) / z^(n + 1/2)
  double cohesion_Pa_;      // c
  double tan_friction_;     // tan(phi)
  double shear_modulus_m_;  // K
};

// tau and its derivative by u.
struct ShearShare {
  double value;
  double slope;
};
// Returns tau(u) = 1 - (1 - e^-u) / u and its derivative, for u >= 0. A call costs about 15 ns.
ShearShare ShareOfRatio(double u);

// Returns u at the share tau in [0, 1): the inverse of tau = 1 - (1 - e^-u) / u. A call costs about
// 20 ns.
double ShearRatio(double tau);

}  // namespace rockyard::rover
