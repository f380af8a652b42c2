#include "vision/cylinder/cylinder_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "math/angles.h"
#include "vision/cylinder/fit_problem.h"

namespace rockyard::vision {
namespace {

constexpr int kOrientations = 48;
// Local minima over the orientations that are refined.
constexpr std::size_t kMostStarts = 5;
// A cost so many times the least is not refined.
constexpr double kFarAbove = 4.0;
constexpr double kOtherOrientation_rad = math::DegToRad(25.0);
constexpr int kMostSteps = 12;
constexpr double kMostDamping = 1e3;
// Of the squared residuals: this, or this share of a hundredth of them.
constexpr double kConverged = 1e-2;
constexpr int kRadius = 4;  // of the unknowns
// A radius that is the cylinder's, and one that is free, over it.
constexpr double kFixedRadius_sd = 1e-4;
constexpr double kFreeRadius_sd = 1.0;

using FitInformation = Eigen::Matrix<double, 6, 6>;

struct FitState {
  FitUnknowns unknowns = FitUnknowns::Zero();
  double squares = std::numeric_limits<double>::infinity();
  FitInformation information = FitInformation::Identity();
  FitProblem::Evaluation evaluation;  // at the unknowns
};

// Forward derivatives of the residuals; of a fixed radius that of its prior alone. Nothing where a
// step leaves what can be imaged.
std::optional<Eigen::MatrixXd> Derivatives(const FitProblem& problem, const FitUnknowns& unknowns,
                                           const Eigen::VectorXd& residuals, double radius_sd) {
  const FitUnknowns steps = problem.Steps();
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(residuals.size(), steps.size());
  for (int i = 0; i < steps.size(); ++i) {
    if (i == kRadius && radius_sd == kFixedRadius_sd) {
      derivatives(residuals.size() - 1, i) = 1.0 / radius_sd;
      continue;
    }
    FitUnknowns step = FitUnknowns::Zero();
    step[i] = steps[i];
    const auto ahead = problem.Evaluate(unknowns + step, radius_sd);
    if (!ahead) return std::nullopt;
    derivatives.col(i) = (ahead->residuals - residuals) / steps[i];
  }
  return derivatives;
}

// Gauss-Newton with Levenberg's damping from a start.
FitState RefinedFrom(const FitProblem& problem, const FitUnknowns& start, double radius_sd) {
  FitState state;
  state.unknowns = start;
  auto evaluation = problem.Evaluate(start, radius_sd);
  if (!evaluation) return state;
  double damping = 1e-3;
  std::optional<Eigen::MatrixXd> derivatives;
  for (int i = 0; i < kMostSteps && damping < kMostDamping; ++i) {
    if (!derivatives) {
      derivatives = Derivatives(problem, state.unknowns, evaluation->residuals, radius_sd);
      if (!derivatives) return state;
      state.information = derivatives->transpose() * *derivatives;
      state.squares = evaluation->residuals.squaredNorm();
    }
    FitInformation damped = state.information;
    damped.diagonal() *= 1.0 + damping;
    const FitUnknowns gradient = derivatives->transpose() * evaluation->residuals;
    const FitUnknowns next = state.unknowns - damped.ldlt().solve(gradient);
    auto there = next.allFinite() ? problem.Evaluate(next, radius_sd) : std::nullopt;
    const double squares =
        there ? there->residuals.squaredNorm() : std::numeric_limits<double>::infinity();
    if (squares >= state.squares) {
      damping *= 10.0;
      continue;
    }
    const bool converged = state.squares - squares < kConverged * std::max(1.0, 0.01 * squares);
    state.unknowns = next;
    state.squares = squares;
    evaluation = std::move(there);
    damping = std::max(0.1 * damping, 1e-6);
    if (converged) break;
    derivatives.reset();
  }
  state.evaluation = std::move(*evaluation);
  return state;
}

FitUnknowns AtOrientation(double orientation_rad) {
  FitUnknowns unknowns = FitUnknowns::Zero();
  unknowns[2] = orientation_rad;
  return unknowns;
}

struct Hypothesis {
  FitState state;
  double colour_misfit = 0.0;
  double cost = std::numeric_limits<double>::infinity();
};

// The starts: orientations whose cost is no larger than that of both neighbours and not far above
// the least, best first.
std::vector<double> StartsOf(const FitProblem& problem, const LogRatios& light) {
  std::array<double, kOrientations> costs{};
  const auto orientation = [](std::size_t i) {
    return 2.0 * std::numbers::pi * static_cast<double>(i) / kOrientations;
  };
  for (std::size_t i = 0; i < kOrientations; ++i) {
    const auto evaluation = problem.Evaluate(AtOrientation(orientation(i)), kFixedRadius_sd);
    costs.at(i) = evaluation ? evaluation->residuals.squaredNorm() +
                                   problem.ColourMisfitOf(*evaluation, light)
                             : std::numeric_limits<double>::infinity();
  }
  const double most = kFarAbove * *std::min_element(costs.begin(), costs.end());
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < kOrientations; ++i) {
    const double before = costs.at((i + kOrientations - 1) % kOrientations);
    const double after = costs.at((i + 1) % kOrientations);
    if (costs.at(i) <= most && costs.at(i) <= before && costs.at(i) <= after &&
        std::isfinite(costs.at(i))) {
      minima.push_back(i);
    }
  }
  std::sort(minima.begin(), minima.end(),
            [&](std::size_t a, std::size_t b) { return costs.at(a) < costs.at(b); });
  if (minima.size() > kMostStarts) minima.resize(kMostStarts);
  std::vector<double> starts;
  starts.reserve(minima.size());
  for (const std::size_t i : minima) starts.push_back(orientation(i));
  return starts;
}

std::vector<Hypothesis> HypothesesOf(const FitProblem& problem, const LogRatios& light) {
  std::vector<Hypothesis> hypotheses;
  for (const double start_rad : StartsOf(problem, light)) {
    Hypothesis hypothesis;
    hypothesis.state = RefinedFrom(problem, AtOrientation(start_rad), kFixedRadius_sd);
    if (!std::isfinite(hypothesis.state.squares)) continue;
    hypothesis.colour_misfit = problem.ColourMisfitOf(hypothesis.state.evaluation, light);
    hypothesis.cost = hypothesis.state.squares + hypothesis.colour_misfit;
    hypotheses.push_back(hypothesis);
  }
  std::sort(hypotheses.begin(), hypotheses.end(),
            [](const Hypothesis& a, const Hypothesis& b) { return a.cost < b.cost; });
  return hypotheses;
}

// What orientations near the best one that are nearly as likely add to its variance, rad^2: their
// squared distances, weighted by likelihoods. `factor` is that of all variances.
double SpreadOf(const std::vector<Hypothesis>& hypotheses, double factor) {
  const Hypothesis& best = hypotheses.front();
  double weights = 0.0;
  double spread = 0.0;
  for (const Hypothesis& other : hypotheses) {
    const double turn_rad = math::WrapAngle(other.state.unknowns[2] - best.state.unknowns[2]);
    if (std::abs(turn_rad) > kOtherOrientation_rad) continue;
    const double weight = std::exp(0.5 * (best.cost - other.cost) / factor);
    weights += weight;
    spread += weight * turn_rad * turn_rad;
  }
  return spread / weights;
}

double MarginOf(const std::vector<Hypothesis>& hypotheses) {
  const Hypothesis& best = hypotheses.front();
  for (const Hypothesis& other : hypotheses) {
    const double turn_rad = math::WrapAngle(other.state.unknowns[2] - best.state.unknowns[2]);
    if (std::abs(turn_rad) > kOtherOrientation_rad) return other.cost - best.cost;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::optional<CylinderFit> FitCylinder(const ColourPair& pair, const EyeGeometry& eyes,
                                       const ColourCylinder& cylinder, const RegionPair& candidate,
                                       const LogRatios& light, const RobustFinderParams& params) {
  const FitProblem problem(pair, eyes, cylinder, candidate, params);
  const std::vector<Hypothesis> hypotheses = HypothesesOf(problem, light);
  if (hypotheses.empty()) return std::nullopt;
  const Hypothesis& best = hypotheses.front();
  CylinderFit fit;
  fit.place = problem.PlaceOf(best.state.unknowns);
  fit.place.orientation_rad = math::WrapAngle(fit.place.orientation_rad);
  fit.cost = best.cost;
  fit.misfit = best.state.squares / problem.samples();
  fit.colour_misfit = best.colour_misfit;
  fit.margin = MarginOf(hypotheses);
  fit.height_m = problem.height_m();
  const double factor = std::max(fit.misfit, 1.0);
  fit.covariance = factor * best.state.information.inverse().topLeftCorner<4, 4>();
  fit.covariance(2, 2) += SpreadOf(hypotheses, factor);
  const FitState free = RefinedFrom(problem, best.state.unknowns, kFreeRadius_sd);
  const CylinderPlace free_place = problem.PlaceOf(free.unknowns);
  fit.free_depth_m = (free_place.p_LT_L - eyes.centre_L).dot(eyes.forward_L);
  fit.radius_ratio = 1.0 + free.unknowns[4];
  fit.radius_ratio_sd = std::sqrt(factor * free.information.inverse()(4, 4));
  return fit;
}

}  // namespace rockyard::vision
