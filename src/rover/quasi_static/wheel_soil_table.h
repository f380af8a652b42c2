// WheelSoil by interpolation, for callers that ask for every wheel many times.
#pragma once

#include <vector>

#include "rover/wheel_soil.h"

namespace rockyard::rover {

// What the soil answers to a load, see WheelSoil.
struct SoilAnswer {
  double sinkage_m;
  double stiffness_N_m;
  double traction_N;  // the largest
  double resistance_N;
  double shear_ratio;  // contact length over shear modulus; u of a slip of 1
};

// The table is linear between nodes that lie evenly in the root of the load, and linear in the slip
// that the wheel has dug in for (slip_sinkage.h). It is within 1 % of WheelSoil from a hundredth of
// max_N on; loads beyond max_N are taken as max_N. A call costs 10 ns, and twice that with a slip.
class WheelSoilTable {
 public:
  // With `digs` it also knows wheels that have dug in by slipping; making it takes 0.3 ms then.
  WheelSoilTable(const WheelSoil& soil, double max_N, bool digs = false);

  // Throws std::runtime_error where the load is not a number.
  SoilAnswer At(double load_N) const;
  // The same for a wheel that has dug in for a slip in [0, 1]; without `digs` as for 0.
  SoilAnswer At(double load_N, double dug_slip) const;

 private:
  double max_N_;
  // One table after the other, from the slip 0 to 1 where `digs`.
  std::vector<std::vector<SoilAnswer>> levels_;
};

}  // namespace rockyard::rover
