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

// The table is linear between nodes that lie evenly in the root of the load. It is within 1 % of
// WheelSoil from a hundredth of max_N on; loads beyond max_N are taken as max_N. A call costs 10
// ns.
class WheelSoilTable {
 public:
  WheelSoilTable(const WheelSoil& soil, double max_N);

  // Throws std::runtime_error where the load is not a number.
  SoilAnswer At(double load_N) const;

 private:
  double max_N_;
  std::vector<SoilAnswer> nodes_;
};

}  // namespace rockyard::rover
