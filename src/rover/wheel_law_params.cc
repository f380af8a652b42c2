#include "rover/wheel_law_params.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/functions.h"

namespace rockyard::rover {
namespace {

using terrain::WheelLaw;

// Slip that stands for 1, at which a law of steady motion has no meaning.
constexpr double kSpins = 0.99;
// Slip at which the form of the traction is fitted.
constexpr double kFitted = 0.1;
// Angles at which the law is evaluated: from here to the level of the axle, even in their
// logarithm.
constexpr int kAngles = 22;
constexpr double kLeastAngle_rad = 0.02;
constexpr double kMostAngle_rad = 1.5;
// Ratios u of a slip of 1 that the fit chooses from.
constexpr double kLeastRatio = 0.5;
constexpr double kMostRatio = 300.0;
constexpr int kRatios = 48;

double Mix(double from, double to, double s) { return from + s * (to - from); }

// One depth of a wheel at one slip: what changes little with the load.
struct Node {
  double log_load;
  double log_sinkage;
  double pull, gross;  // over the load
  double side;         // over the load and the sinkage
};

// A law of stresses at one slip, by the logarithm of the load.
class SlipCurve {
 public:
  // Adds a deeper wheel. One that bears no more than the last is left out: it pushes itself up.
  void Add(double sinkage_m, const RimForces& forces) {
    const double log_load = math::Log(std::max(forces.load_N, 1e-12));
    if (!nodes_.empty() && log_load <= nodes_.back().log_load) return;
    const double inverse = 1.0 / forces.load_N;
    nodes_.push_back({log_load, math::Log(sinkage_m), inverse * forces.pull_N,
                      inverse * forces.gross_N, inverse * forces.side_N / sinkage_m});
  }

  // What a load meets; loads that come in rising order are found at once.
  struct Point {
    double sinkage_m, stiffness_N_m;
    double pull_N, gross_N, side_N;
  };
  Point At(double load_N) {
    const double log_load = math::Log(load_N);
    while (at_ + 2 < nodes_.size() && nodes_[at_ + 1].log_load < log_load) ++at_;
    const Node& a = nodes_[at_];
    const Node& b = nodes_[at_ + 1];
    // Loads below the first node and beyond the deepest follow their power laws; the forces of a
    // wheel that is deeper than its axle are those at the axle.
    const double s = (log_load - a.log_load) / (b.log_load - a.log_load);
    const double inside = std::clamp(s, 0.0, 1.0);
    const double sinkage_m = math::Exp(Mix(a.log_sinkage, b.log_sinkage, s));
    const double slope = (b.log_load - a.log_load) / (b.log_sinkage - a.log_sinkage);
    return {sinkage_m, slope * load_N / sinkage_m, load_N * Mix(a.pull, b.pull, inside),
            load_N * Mix(a.gross, b.gross, inside),
            load_N * sinkage_m * Mix(a.side, b.side, inside)};
  }

 private:
  std::vector<Node> nodes_;
  std::size_t at_ = 0;
};

// Finds the ratio u with which tau(u i) / tau(u) at the fitted slip is a given share.
class RatioFit {
 public:
  explicit RatioFit(const ShareTable& shares) {
    for (int i = 0; i <= kRatios; ++i) {
      const double u = kLeastRatio * math::Pow(kMostRatio / kLeastRatio, i / double{kRatios});
      ratio_[static_cast<std::size_t>(i)] = u;
      share_[static_cast<std::size_t>(i)] = shares.At(kFitted * u).value / shares.At(u).value;
    }
  }
  double Of(double share) const {
    const auto above = std::lower_bound(share_.begin() + 1, share_.end() - 1, share);
    const auto i = static_cast<std::size_t>(above - share_.begin());
    const double s = (share - share_[i - 1]) / (share_[i] - share_[i - 1]);
    return Mix(ratio_[i - 1], ratio_[i], std::clamp(s, 0.0, 1.0));
  }

 private:
  std::array<double, kRatios + 1> ratio_{};
  std::array<double, kRatios + 1> share_{};
};

}  // namespace

SoilAnswer Mix(const SoilAnswer& a, const SoilAnswer& b, double s) {
  return {Mix(a.sinkage_m, b.sinkage_m, s),     Mix(a.stiffness_N_m, b.stiffness_N_m, s),
          Mix(a.traction_N, b.traction_N, s),   Mix(a.resistance_N, b.resistance_N, s),
          Mix(a.shear_ratio, b.shear_ratio, s), Mix(a.side_N, b.side_N, s)};
}

RimShape RimShapeOf(const RoverGeometryParams& params) {
  return {params.wheel_radius_m, params.wheel_width_m, params.lug_height_m,
          static_cast<int>(params.lug_count)};
}

RimStressTable::RimStressTable(const RimStress& stress, const RimShape& wheel, double max_N)
    : max_N_(max_N) {
  // The levels, and behind them the slip that the form of the traction is fitted at.
  std::array<double, kLevels + 2> slips{};
  for (int level = 0; level <= kLevels; ++level) {
    const double root = level / double{kLevels};
    slips[static_cast<std::size_t>(level)] = std::min(root * root, kSpins);
  }
  slips.back() = kFitted;
  std::array<SlipCurve, kLevels + 2> curves;
  for (int i = 0; i <= kAngles; ++i) {
    const double entry_rad =
        kLeastAngle_rad * math::Pow(kMostAngle_rad / kLeastAngle_rad, i / double{kAngles});
    const std::vector<RimForces> forces = stress.At(entry_rad, slips);
    for (std::size_t k = 0; k < curves.size(); ++k) {
      curves[k].Add(wheel.radius_m * (1.0 - math::Cos(entry_rad)), forces[k]);
    }
  }
  const RatioFit fit(shares_);
  for (std::size_t node = 0; node <= kLoads; ++node) {
    // The first node is that of a load a little above zero, where stiffness may be infinite.
    const double root = static_cast<double>(std::max<std::size_t>(node, 1)) / kLoads;
    const double load_N = root * root * max_N;
    const double spinning_N = curves[kLevels].At(load_N).gross_N;
    const double ratio = fit.Of(curves.back().At(load_N).gross_N / std::max(spinning_N, 1e-12));
    const double largest_N = std::max(spinning_N, 0.0) / shares_.At(ratio).value;
    const double scale = node == 0 ? 0.0 : 1.0;
    for (std::size_t level = 0; level <= kLevels; ++level) {
      const SlipCurve::Point at = curves[level].At(load_N);
      levels_[level][node] = {
          scale * at.sinkage_m, at.stiffness_N_m, scale * largest_N, -scale * at.pull_N, ratio,
          scale * at.side_N};
    }
  }
}

SoilAnswer RimStressTable::At(double load_N, double dug_slip) const {
  const double at = kLoads * std::sqrt(std::clamp(load_N / max_N_, 0.0, 1.0));
  const auto node = static_cast<std::size_t>(std::min(static_cast<int>(at), kLoads - 1));
  const double s = at - static_cast<double>(node);
  // Levels are even in the root of the slip; between two of them answers are linear in the slip.
  const double slip = std::clamp(dug_slip, 0.0, 1.0);
  const auto level =
      static_cast<std::size_t>(std::min(static_cast<int>(kLevels * std::sqrt(slip)), kLevels - 1));
  const auto below = static_cast<double>(level);
  const double share = (slip * kLevels * kLevels - below * below) / (2.0 * below + 1.0);
  const Level& low = levels_[level];
  const Level& high = levels_[level + 1];
  SoilAnswer answer =
      Mix(Mix(low[node], low[node + 1], s), Mix(high[node], high[node + 1], s), share);
  const double traction_N = answer.traction_N * shares_.At(answer.shear_ratio * slip).value;
  answer.resistance_N = std::max(traction_N + answer.resistance_N, 0.0);
  return answer;
}

WheelOnSoil::WheelOnSoil(const Case& of)
    : of_(of),
      rut_(of.soil, of.wheel.radius_m, of.wheel.width_m),
      digs_(of.soil.law != WheelLaw::kBekker || of.soil.slip_sinkage.enabled) {
  if (of.soil.law == WheelLaw::kBekker) return;
  stress_ = std::make_shared<RimStressTable>(RimStress(of.soil, of.wheel, of.gravity_m_s2),
                                             of.wheel, of.max_N);
}

SoilAnswer WheelOnSoil::Under(double load_N, double dug_slip) const {
  if (stress_ != nullptr) return stress_->At(load_N, dug_slip);
  const Rut rut = rut_.RutUnder(load_N, dug_slip);
  return {rut.sinkage_m,
          rut.stiffness_N_m,
          rut.largest_traction_N,
          rut.resistance_N,
          rut.contact_length_m / of_.soil.shear_modulus_m,
          0.0};
}

}  // namespace rockyard::rover
