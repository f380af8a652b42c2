// A rigid wheel on soil: its rut and traction at a slip, as functions of its load, and how far it
// digs in by slipping. The multibody takes WheelSoil, the quasi-static rover WheelSoilTable; both
// take SlipSinkage and ShareTable. Records depend on the tables with their errors: another number
// of nodes is a change of results.
//
// Sinkage, resistance and largest traction T_max are those of wheel_rut_params.h, with its limits.
// Slip (Janosi and Hanamoto 1961, uniform pressure along the contact length l): T = tau T_max with
//   tau = 1 - (1 - e^-u) / u,   u = i l / K,   i = 1 - v / (omega r).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "messages/wheels.h"
#include "rover/wheel_rut_params.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// tau, the share of its largest traction that soil gives to a wheel that slips.
struct ShearShare {
  double value;
  double slope;  // by u
};
// Returns tau(u) = 1 - (1 - e^-u) / u and its derivative, for u >= 0. A call costs about 15 ns.
ShearShare ShareOfRatio(double u);

// ShareOfRatio by cubic interpolation of value and slope: within 1e-7 of tau, in a tenth of the
// time.
class ShareTable {
 public:
  ShareTable();

  // Returns tau(u) and its derivative, for u >= 0. The function stands in the header to be inlined:
  // balances ask for tau a million times in a trial.
  ShearShare At(double u) const;

 private:
  static constexpr int kIntervals = 256;
  static constexpr double kLast = 16.0;  // from here on e^-u is nothing
  std::array<ShearShare, kIntervals + 1> nodes_{};
};

inline ShearShare ShareTable::At(double u) const {
  // tau = 1 - (1 - e^-u) / u, without e^-u.
  if (u >= kLast) return {1.0 - 1.0 / u, 1.0 / (u * u)};
  constexpr double kWidth = kLast / kIntervals;
  const double at = u / kWidth;
  const auto index = static_cast<std::size_t>(at);
  const double s = at - static_cast<double>(index);
  const ShearShare& a = nodes_[index];
  const ShearShare& b = nodes_[index + 1];
  // Hermite's cubic through both values and slopes, and its derivative: with the rise d of the
  // chord and the differences p and q of the slopes from it,
  //   f = a + s (d + (1 - s) ((1 - s) p - s q)).
  const double d = b.value - a.value;
  const double p = kWidth * a.slope - d;
  const double q = kWidth * b.slope - d;
  const double r = 1.0 - s;
  const double value = a.value + s * (d + r * (r * p - s * q));
  const double slope = d + r * (r * p - s * q) + s * (-(r * p - s * q) - r * (p + q));
  return {value, slope / kWidth};
}

// One kind of wheel on one soil.
class WheelSoil : public WheelRut {
 public:
  // Radius and width are positive, m; the soil lies within the bounds of SoilParams::Visit.
  WheelSoil(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m);

  // Returns l / K, the u at a slip of 1; infinite where K is 0.
  double ShearRatioOfFullSlip(double load_N) const;

  // Returns tau, the share of the largest traction that a slip mobilizes.
  double TractionShare(double slip, double load_N) const;

  // Returns i / tau at the slip i >= 0, with tau from the table; its limit at i = 0 is 2 K / l.
  double SlipPerShare(double slip, const Rut& rut, const ShareTable& shares) const;

 private:
  double shear_modulus_m_;  // K
};

// What WheelSoilTable answers to a load.
struct SoilAnswer {
  double sinkage_m;
  double stiffness_N_m;
  double traction_N;  // T_max
  double resistance_N;
  double shear_ratio;  // l / K, the u of a slip of 1
};

// WheelSoil by interpolation, for the quasi-static rover, which asks for every wheel many times.
// The table is linear between nodes that lie evenly in the root of the load, and linear in the slip
// that the wheel has dug in for (SlipSinkage). It is within 1 % of WheelSoil from a hundredth of
// max_N on; loads beyond max_N are taken as max_N. A call costs 10 ns, and twice that with a slip.
class WheelSoilTable {
 public:
  // Makes the table; with `digs` also for wheels that have dug in by slipping, which takes 0.3 ms.
  WheelSoilTable(const WheelSoil& soil, double max_N, bool digs = false);

  // Return the answer to a load, without a slip and for a wheel that has dug in for a slip in
  // [0, 1]; without `digs` every slip counts as 0. They throw std::runtime_error where the load is
  // not a number.
  SoilAnswer At(double load_N) const;
  SoilAnswer At(double load_N, double dug_slip) const;

 private:
  double max_N_;
  // One table for each slip, from 0 to 1; one table, for 0, without `digs`.
  std::vector<std::vector<SoilAnswer>> levels_;
};

// How far the wheels of a rover have dug in by slipping. Every wheel has a slip d in [0, 1] that it
// has dug in for, from which wheel_rut_params.h tells its rut. d follows the slip i of the moment
// over the way s of the rim,
//
//   dd/ds = i (i - d) / L          where it digs in (i > d): i ds is the way that the rim slides,
//   dd/ds = (1 - i) (i - d) / L    where it comes out of its hole: the way that it rolls on.
//
// So a wheel that spins on the spot sinks little by little, and a wheel that stands stays as it is.
// The law of Ding et al. 2010 is of steady slip; the lag is our assumption.
class SlipSinkage {
 public:
  explicit SlipSinkage(const terrain::SlipSinkageParams& params) : params_(params) {}

  bool enabled() const { return params_.enabled; }
  double dug_slip(std::size_t wheel) const { return dug_slip_[wheel]; }

  // Turns a wheel by `rim_way_m` >= 0 at a slip >= 0; a slip above 1 counts as 1.
  void Roll(std::size_t wheel, double slip, double rim_way_m);
  // Puts all wheels on fresh soil, for a rover that stands elsewhere.
  void Clear() { dug_slip_.fill(0.0); }

 private:
  terrain::SlipSinkageParams params_;
  messages::PerWheel<double> dug_slip_{};
};

inline void SlipSinkage::Roll(std::size_t wheel, double slip, double rim_way_m) {
  if (!params_.enabled) return;
  const double i = std::min(slip, 1.0);
  double& d = dug_slip_[wheel];
  const double way_m = rim_way_m * (i > d ? i : 1.0 - i);
  // The equation above, solved for a constant slip.
  d += (i - d) * -std::expm1(-way_m / params_.length_m);
}

}  // namespace rockyard::rover
