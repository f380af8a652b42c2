// A rigid wheel on soil: its rut and traction at a slip, as functions of its load.
//
// Sinkage, resistance and largest traction T_max are those of wheel_rut_params.h.
// Slip (Janosi and Hanamoto 1961, uniform pressure along l): T = tau T_max with
//   tau = 1 - (1 - e^-u) / u,   u = i l / K,   i = 1 - v / (omega r).
//
// Limits: those of the rut.
#pragma once

#include "rover/shear_curve.h"
#include "rover/wheel_rut_params.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// One kind of wheel on one soil.
class WheelSoil : public WheelRut {
 public:
  // Radius and width are positive, m; the soil lies within the bounds of its Visit.
  WheelSoil(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m);

  // Returns l / K, the u at a slip of 1; infinite where K is 0.
  double ShearRatioOfFullSlip(double load_N) const;

  // Slip returns the slip in [0, 1] that mobilizes the share tau of the largest traction: 1 where
  // the wheel spins on the spot. TractionShare is its inverse: the share that a slip mobilizes.
  double Slip(double tau, double load_N) const;
  double TractionShare(double slip, double load_N) const;

  // Returns i / tau at the slip i >= 0, with tau from the table; its limit at i = 0 is 2 K / l.
  double SlipPerShare(double slip, const Rut& rut, const ShareTable& shares) const;

 private:
  double shear_modulus_m_;  // K
};

}  // namespace rockyard::rover
