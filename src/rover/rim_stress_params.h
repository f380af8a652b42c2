// The stresses of soil on the rim of a rigid wheel that rolls steadily, added up to the forces on
// its axle, by the laws that terrain.ground.soil.law names besides Bekker's (wheel_rut_params.h).
// wheel_law_params.h tabulates them for the rover; results/wheel_soil.md holds them against
// measurements.
//
// The rim of radius r, to the tips of its lugs, meets the soil from the angle theta_1 ahead of its
// lowest point on. A point at the angle theta lies d = r (cos theta - cos theta_1) below the
// surface and moves, at the slip i, with the velocity (1 - cos theta / (1 - i), -sin theta / (1 -
// i)) over that of the axle. With the stresses sigma into the rim and tau along it,
//   W = r b int (sigma cos theta + tau sin theta),  P = r b int (tau cos theta - sigma sin theta),
//   torque = r^2 b int tau.
//
// Laws, with the pressure p(d) under a sinking plate, Bekker's (k_c / b + k_phi) d^n or, from the
// density rho of a granular soil, xi d with xi = rho g (894 mu^3 - 386 mu^2 + 89 mu), mu = tan(phi)
// (Agarwal, Goldman and Kamrin 2023):
//
// wong_reece (Wong and Reece 1967): sigma = p(d) ahead of the angle (0.18 + 0.32 i) theta_1, their
// values for loose sand, and behind it as far ahead; tau = (c + sigma tan phi) (1 - e^(-j / K)),
// j = r (theta_1 - theta - (1 - i) (sin theta_1 - sin theta)).
//
// resistive_force (Li, Zhang and Goldman 2013): stress p(d) (alpha_x, alpha_z), functions of the
// tilt of the surface and of the direction in which it moves, with their generic coefficients.
// Where p is that of a density, forces scale as Slonaker et al. 2017 say: a wheel of L times the
// size with M times the mass under g' goes alike where M g / (rho g L^3) is the same.
//
// intrusion: sigma = p(d) alpha_n of the same functions, so that soil which is sheared bears less,
// and tau = (c' + sigma mu') m, where m in [-1, 1] is alpha_t / alpha_n over its value under a rim
// that slides level, 0.36. mu' is sin(phi) where lugs hold the soil between them, as soil shears on
// soil without changing its volume (Davis 1968), and tan(2 phi / 3) on a smooth rim (Potyondy 1961:
// 0.54 to 0.76 of phi between sand and steel); c' likewise c or two thirds of it. It has no shear
// modulus.
//
// Both of the latter press on the side face of a wheel that moves across: 0.37 p(d), the stress of
// the same functions on an upright plate.
//
// Limits: steady motion on level undisturbed soil, no wave of soil ahead, no rut of other wheels,
// rigid wheels; soil that lugs throw out of the rut does not sink the wheel.
#pragma once

#include <span>
#include <vector>

#include "terrain/soil_params.h"

namespace rockyard::rover {

// The wheel as the soil meets it.
struct RimShape {
  double radius_m = 0.0;  // to the tips of the lugs
  double width_m = 0.0;
  double lug_height_m = 0.0;
  int lug_count = 0;

  bool operator==(const RimShape&) const = default;
};

// What the soil does to a wheel at one slip and one depth.
struct RimForces {
  double load_N = 0.0;   // upward
  double pull_N = 0.0;   // forward, what is left of the traction for others
  double gross_N = 0.0;  // torque over radius
  double side_N = 0.0;   // largest force across the wheel's side face
};

// One kind of wheel on one soil. Immutable.
class RimStress {
 public:
  // The law of the soil is not Bekker's; lengths are positive, and so is gravity.
  RimStress(const terrain::SoilParams& soil, const RimShape& wheel, double gravity_m_s2);

  // Returns the forces on a wheel whose rim meets the soil at the angle entry_rad in (0, pi/2]
  // ahead of its lowest point, at slips in (-1, 1). A slip costs about 0.3 us.
  std::vector<RimForces> At(double entry_rad, std::span<const double> slips) const;
  RimForces At(double entry_rad, double slip) const { return At(entry_rad, {&slip, 1}).front(); }

 private:
  // Stress into the rim and along it, Pa.
  struct Stress {
    double normal_Pa;
    double shear_Pa;
  };
  // A point of the rim, and the pressure under a plate at its depth.
  struct RimPoint {
    double angle_rad, sin, cos;
    double pressure_Pa;
  };
  // rim: speed of the rim over that of the axle.
  Stress Granular(const RimPoint& point, double rim) const;
  Stress WongReece(const RimPoint& point, double entry_rad, double slip) const;
  double Pressure(double depth_m) const;

  terrain::WheelLaw law_;
  double radius_m_;
  double width_m_;
  double modulus_;  // p(d) = modulus d^exponent
  double exponent_;
  double friction_;  // mu'
  double cohesion_Pa_;
  double shear_modulus_m_;
};

}  // namespace rockyard::rover
