#include "rover/wheel_soil.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rockyard::rover {
namespace {

// Below this u the closed form loses digits to cancellation; the series u/2 - u^2/6 has an error of
// u^3 / 24.
constexpr double kSeries = 1e-4;

// Intervals of the load; nodes are even in its root because the sinkage of a power law bends most
// at small loads.
constexpr int kIntervals = 128;
// Largest l / K: soil without shear deformation gets a little of it, half of the traction at a slip
// of 0.6 %, as Newton's method would see a step at any less.
constexpr double kMaxRatio = 300.0;

// Intervals of the slip that a wheel has dug in for: from one to the next the sinkage changes by a
// sixth, which is linear within 0.4 %.
constexpr int kDugIntervals = 16;

double Mix(double from, double to, double s) { return from + s * (to - from); }

SoilAnswer Mix(const SoilAnswer& a, const SoilAnswer& b, double s) {
  return {Mix(a.sinkage_m, b.sinkage_m, s), Mix(a.stiffness_N_m, b.stiffness_N_m, s),
          Mix(a.traction_N, b.traction_N, s), Mix(a.resistance_N, b.resistance_N, s),
          Mix(a.shear_ratio, b.shear_ratio, s)};
}

std::vector<SoilAnswer> MakeNodes(const WheelSoil& soil, double max_N, double dug_slip) {
  std::vector<SoilAnswer> nodes;
  nodes.reserve(kIntervals + 1);
  for (int i = 0; i <= kIntervals; ++i) {
    // Stiffness can be infinite at load zero: that of the first node is taken at a load a little
    // above it.
    const double root = std::max(i, 1) / static_cast<double>(kIntervals);
    const double load_N = root * root * max_N;
    const Rut rut = soil.RutUnder(load_N, dug_slip);
    const double scale = i == 0 ? 0.0 : 1.0;
    nodes.push_back({scale * rut.sinkage_m, rut.stiffness_N_m, scale * rut.largest_traction_N,
                     scale * rut.resistance_N,
                     std::min(soil.ShearRatioOfFullSlip(load_N), kMaxRatio)});
  }
  return nodes;
}

}  // namespace

ShearShare ShareOfRatio(double u) {
  if (u < kSeries) return {u * (0.5 - u / 6.0), 0.5 - u / 3.0};
  // tau = 1 - (1 - e^-u) / u and, by the quotient rule, tau' = ((1 - e^-u) / u - e^-u) / u.
  const double loss = std::expm1(-u);  // e^-u - 1
  const double rest = -loss / u;
  return {1.0 - rest, (rest - loss - 1.0) / u};
}

ShareTable::ShareTable() {
  for (int i = 0; i <= kIntervals; ++i) {
    nodes_[static_cast<std::size_t>(i)] = ShareOfRatio(kLast * i / kIntervals);
  }
}

WheelSoil::WheelSoil(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m)
    : WheelRut(soil, wheel_radius_m, wheel_width_m), shear_modulus_m_(soil.shear_modulus_m) {}

double WheelSoil::ShearRatioOfFullSlip(double load_N) const {
  return ContactLength_m(load_N) / shear_modulus_m_;
}

double WheelSoil::TractionShare(double slip, double load_N) const {
  if (slip <= 0.0) return 0.0;
  // K = 0: the soil shears without deformation, so any slip mobilizes all of its strength.
  if (shear_modulus_m_ == 0.0) return 1.0;
  return ShareOfRatio(slip * ShearRatioOfFullSlip(load_N)).value;
}

double WheelSoil::SlipPerShare(double slip, const Rut& rut, const ShareTable& shares) const {
  if (shear_modulus_m_ == 0.0) return 0.0;
  const double ratio = shear_modulus_m_ / rut.contact_length_m;
  // u = i l / K; tau tends to u / 2, so i / tau to 2 K / l.
  const double u = slip / ratio;
  return u == 0.0 ? 2.0 * ratio : slip / shares.At(u).value;
}

WheelSoilTable::WheelSoilTable(const WheelSoil& soil, double max_N, bool digs) : max_N_(max_N) {
  levels_.push_back(MakeNodes(soil, max_N, 0.0));
  for (int level = 1; digs && level <= kDugIntervals; ++level) {
    levels_.push_back(MakeNodes(soil, max_N, level / static_cast<double>(kDugIntervals)));
  }
}

SoilAnswer WheelSoilTable::At(double load_N) const { return At(load_N, 0.0); }

SoilAnswer WheelSoilTable::At(double load_N, double dug_slip) const {
  // Not a number would pass the clamp below and index the table anywhere.
  if (std::isnan(load_N)) throw std::runtime_error("a wheel load is not a number");
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

}  // namespace rockyard::rover
