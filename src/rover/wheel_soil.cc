#include "rover/wheel_soil.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rockyard::rover {
namespace {

// Intervals of the load; nodes are even in its root because the sinkage of a power law bends most
// at small loads.
constexpr int kIntervals = 128;
// Largest l / K: soil without shear deformation gets a little of it, half of the traction at a slip
// of 0.6 %, as Newton's method would see a step at any less.
constexpr double kMaxRatio = 300.0;

// Intervals of the slip that a wheel has dug in for: from one to the next the sinkage changes by a
// sixth, which is linear within 0.4 %.
constexpr int kDugIntervals = 16;

std::vector<SoilAnswer> MakeNodes(const WheelOnSoil& soil, double max_N, double dug_slip) {
  std::vector<SoilAnswer> nodes;
  nodes.reserve(kIntervals + 1);
  for (int i = 0; i <= kIntervals; ++i) {
    // Stiffness can be infinite at load zero: that of the first node is taken at a load a little
    // above it.
    const double root = std::max(i, 1) / static_cast<double>(kIntervals);
    SoilAnswer node = soil.Under(root * root * max_N, dug_slip);
    if (i == 0) node.sinkage_m = node.traction_N = node.resistance_N = 0.0;
    node.shear_ratio = std::min(node.shear_ratio, kMaxRatio);
    nodes.push_back(node);
  }
  return nodes;
}

}  // namespace

double SlipPerShare(double slip, double shear_ratio, const ShareTable& shares) {
  // K = 0: the soil shears without deformation, so any slip mobilizes all of its strength.
  if (std::isinf(shear_ratio)) return 0.0;
  // tau tends to u / 2, so i / tau to 2 over the shear ratio.
  const double u = slip * shear_ratio;
  return u == 0.0 ? 2.0 / shear_ratio : slip / shares.At(u).value;
}

WheelSoilTable::WheelSoilTable(const WheelOnSoil& soil, double max_N) : soil_(soil), max_N_(max_N) {
  if (soil.IsTable()) return;
  levels_.push_back(MakeNodes(soil, max_N, 0.0));
  for (int level = 1; soil.digs() && level <= kDugIntervals; ++level) {
    levels_.push_back(MakeNodes(soil, max_N, level / static_cast<double>(kDugIntervals)));
  }
}

SoilAnswer WheelSoilTable::At(double load_N, double dug_slip) const {
  // Not a number would pass the clamp below and index the table anywhere.
  if (std::isnan(load_N)) throw std::runtime_error("a wheel load is not a number");
  if (soil_.IsTable()) return soil_.Under(load_N, dug_slip);
  // Position among the nodes; loads beyond max_N are taken as max_N.
  const double at = kIntervals * std::sqrt(std::clamp(load_N / max_N_, 0.0, 1.0));
  const int index = std::min(static_cast<int>(at), kIntervals - 1);
  const double s = at - index;
  const auto in_level = [index, s](const std::vector<SoilAnswer>& nodes) {
    return Mix(nodes[static_cast<std::size_t>(index)], nodes[static_cast<std::size_t>(index) + 1],
               s);
  };
  if (dug_slip == 0.0 || levels_.size() == 1) return in_level(levels_.front());
  const double level = kDugIntervals * std::min(dug_slip, 1.0);
  const auto below = static_cast<std::size_t>(std::min(static_cast<int>(level), kDugIntervals - 1));
  return Mix(in_level(levels_[below]), in_level(levels_[below + 1]),
             level - static_cast<double>(below));
}

SlipSinkage::SlipSinkage(const terrain::SoilParams& soil, const WheelOnSoil& wheel,
                         double wheel_radius_m, double load_N)
    : enabled_(wheel.digs()),
      by_stress_(soil.law != terrain::WheelLaw::kBekker),
      length_m_(soil.slip_sinkage.length_m) {
  // The chord from the foremost contact to the lowest point of the rim: r sin(theta_1), with
  // z = r (1 - cos(theta_1)).
  const double sinkage_m = std::min(wheel.Under(load_N, 0.0).sinkage_m, wheel_radius_m);
  if (by_stress_) length_m_ = std::sqrt(sinkage_m * (2.0 * wheel_radius_m - sinkage_m));
}

}  // namespace rockyard::rover
