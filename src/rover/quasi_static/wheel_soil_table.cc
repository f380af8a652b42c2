#include "rover/quasi_static/wheel_soil_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rockyard::rover {
namespace {

// Nodes are even in the root of the load because the sinkage of a power law bends most at small
// loads.
constexpr int kIntervals = 128;
// Soil without shear deformation gets a little: half of the traction at a slip of 0.6 %, beyond
// which Newton's method would see a step.
constexpr double kMaxRatio = 300.0;

}  // namespace

WheelSoilTable::WheelSoilTable(const WheelSoil& soil, double max_N) : max_N_(max_N) {
  nodes_.reserve(kIntervals + 1);
  for (int i = 0; i <= kIntervals; ++i) {
    // The first node stands a little above zero, where the stiffness can be infinite.
    const double root = std::max(i, 1) / static_cast<double>(kIntervals);
    const double load_N = root * root * max_N;
    const Rut rut = soil.RutUnder(load_N);
    const double scale = i == 0 ? 0.0 : 1.0;
    nodes_.push_back({scale * rut.sinkage_m, rut.stiffness_N_m, scale * rut.largest_traction_N,
                      scale * rut.resistance_N,
                      std::min(soil.ShearRatioOfFullSlip(load_N), kMaxRatio)});
  }
}

SoilAnswer WheelSoilTable::At(double load_N) const {
  if (std::isnan(load_N)) throw std::runtime_error("a wheel load is not a number");
  // Position among the nodes; loads beyond max_N are taken as max_N.
  const double at = kIntervals * std::sqrt(std::clamp(load_N / max_N_, 0.0, 1.0));
  const int index = std::min(static_cast<int>(at), kIntervals - 1);
  const double s = at - index;
  const SoilAnswer& a = nodes_[static_cast<std::size_t>(index)];
  const SoilAnswer& b = nodes_[static_cast<std::size_t>(index) + 1];
  const auto mix = [s](double from, double to) { return from + s * (to - from); };
  return {mix(a.sinkage_m, b.sinkage_m), mix(a.stiffness_N_m, b.stiffness_N_m),
          mix(a.traction_N, b.traction_N), mix(a.resistance_N, b.resistance_N),
          mix(a.shear_ratio, b.shear_ratio)};
}

}  // namespace rockyard::rover
