// A rigid wheel on soil: its traction at a slip, the answers of the soil as a table, and how far it
// digs in by slipping. The multibody takes WheelOnSoil (wheel_law_params.h) as it is, the
// quasi-static rover WheelSoilTable; both take SlipSinkage and ShareTable. Records depend on the
// tables with their errors: another number of nodes is a change of results.
//
// Slip (Janosi and Hanamoto 1961, uniform pressure along the contact length l): T = tau T_max with
//   tau = 1 - (1 - e^-u) / u,   u = i l / K,   i = 1 - v / (omega r).
#pragma once

#include <algorithm>
#include <vector>

#include "math/functions.h"
#include "messages/wheels.h"
#include "rover/shear_share_params.h"
#include "rover/wheel_law_params.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// Returns i / tau at the slip i >= 0, for soil whose u at a slip of 1 is the shear ratio; its limit
// at i = 0 is 2 over the shear ratio.
double SlipPerShare(double slip, double shear_ratio, const ShareTable& shares);

// WheelOnSoil by interpolation, for the quasi-static rover, which asks for every wheel many times.
// The table is linear between nodes that lie evenly in the root of the load, and linear in the slip
// that the wheel has dug in for (SlipSinkage). It is within 1 % of the law from a hundredth of
// max_N on; loads beyond max_N are taken as max_N. A call costs 10 ns, and twice that with a slip.
class WheelSoilTable {
 public:
  // Makes the table; where wheels dig in by slipping, also for such, which takes 0.3 ms.
  WheelSoilTable(const WheelOnSoil& soil, double max_N);

  // Returns the answer to a load of a wheel that has dug in for a slip in [0, 1]. Throws
  // std::runtime_error where the load is not a number.
  SoilAnswer At(double load_N, double dug_slip) const;

  const WheelOnSoil& soil() const { return soil_; }

 private:
  WheelOnSoil soil_;
  double max_N_;
  // Bekker's law: one table for each slip, from 0 to 1; one table, for 0, where it does not dig.
  std::vector<std::vector<SoilAnswer>> levels_;
};

// How far the wheels of a rover have dug in by slipping. Every wheel has a slip d in [0, 1] that it
// has dug in for, from which the law tells its sinkage and resistance. d follows the slip i of the
// moment over the way s of the rim,
//
//   dd/ds = w (i - d) / L          where it digs in (i > d),
//   dd/ds = (1 - i) (i - d) / L    where it comes out of its hole: the way that it rolls on.
//
// By Ding's law w = i: i ds is the way that the rim slides, and L is slip_sinkage.length_m. By laws
// of stresses w = 1, and L is the length of the contact under the mean load: how much soil bears
// depends on how it moves, and after that way the rim has moved all of it so. So a wheel that spins
// on the spot sinks little by little, and a wheel that stands stays as it is. The laws are of
// steady slip; the lag is our assumption.
class SlipSinkage {
 public:
  // wheel, load_N: a wheel of the rover on that soil, and its mean load.
  SlipSinkage(const terrain::SoilParams& soil, const WheelOnSoil& wheel, double wheel_radius_m,
              double load_N);

  bool enabled() const { return enabled_; }
  double dug_slip(std::size_t wheel) const { return dug_slip_[wheel]; }

  // Returns the slip that a wheel will have dug in for when it has turned by `rim_way_m` >= 0 at a
  // slip >= 0; a slip above 1 counts as 1.
  double After(std::size_t wheel, double slip, double rim_way_m) const;
  // Turns a wheel so.
  void Roll(std::size_t wheel, double slip, double rim_way_m) {
    dug_slip_[wheel] = After(wheel, slip, rim_way_m);
  }
  // Lets a wheel have dug in for a slip >= 0; one above 1 counts as 1.
  void Set(std::size_t wheel, double slip) { dug_slip_[wheel] = std::min(slip, 1.0); }
  // Returns L.
  double length_m() const { return length_m_; }
  // Puts all wheels on fresh soil, for a rover that stands elsewhere.
  void Clear() { dug_slip_.fill(0.0); }

 private:
  bool enabled_;
  bool by_stress_;
  double length_m_;  // L
  messages::PerWheel<double> dug_slip_{};
};

inline double SlipSinkage::After(std::size_t wheel, double slip, double rim_way_m) const {
  const double d = dug_slip_[wheel];
  if (!enabled_) return d;
  const double i = std::min(slip, 1.0);
  const double way_m = rim_way_m * (i <= d ? 1.0 - i : by_stress_ ? 1.0 : i);
  // The equation above, solved for a constant slip.
  return d + (i - d) * -math::Expm1(-way_m / length_m_);
}

}  // namespace rockyard::rover
