#include "vision/cylinder/fit_descent.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/check.h"
#include "math/decompositions.h"

namespace rockyard::vision {
namespace {

constexpr double kMostDamping = 1e3;
constexpr double kLeastDamping = 1e-6;
constexpr double kFirstDamping = 1e-3;
// Of the squared residuals: this, or this share of a hundredth of them.
constexpr double kConverged = 1e-2;
constexpr int kRadius = 4;  // of the unknowns
// A radius that is the cylinder's, and one that is free, over it.
constexpr double kFixedRadius_sd = 1e-4;
constexpr double kFreeRadius_sd = 1.0;

// Forward derivatives of the residuals; of a radius that stays that of its prior alone, which comes
// last. Nothing where a step leaves what can be imaged.
std::optional<Eigen::MatrixXd> Derivatives(const FitProblem& problem, const FitUnknowns& unknowns,
                                           const Eigen::VectorXd& residuals, FitRadius radius) {
  const FitUnknowns steps = problem.Steps();
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(residuals.size(), steps.size());
  for (int i = 0; i < steps.size(); ++i) {
    if (i == kRadius && radius == FitRadius::kFixed) {
      derivatives(residuals.size() - 1, i) = 1.0 / kFixedRadius_sd;
      continue;
    }
    FitUnknowns step = FitUnknowns::Zero();
    step[i] = steps[i];
    const auto ahead = problem.Evaluate(unknowns + step, RadiusDeviation(radius));
    if (!ahead) return std::nullopt;
    derivatives.col(i) = (ahead->residuals - residuals) / steps[i];
  }
  return derivatives;
}

// Towards the minimum of the linear problem.
FitUnknowns DampedStep(const FitInformation& information, const FitUnknowns& gradient,
                       double damping) {
  FitInformation damped = information;
  damped.diagonal() *= 1.0 + damping;
  return -math::SolveSymmetric(damped, gradient);
}

}  // namespace

double RadiusDeviation(FitRadius radius) {
  return radius == FitRadius::kFree ? kFreeRadius_sd : kFixedRadius_sd;
}

FitState DescendFrom(const FitProblem& problem, const FitUnknowns& start, FitRadius radius,
                     int most_steps) {
  EXPECT(most_steps >= 1);
  FitState state;
  state.unknowns = start;
  auto evaluation = problem.Evaluate(start, RadiusDeviation(radius));
  if (!evaluation) return state;
  double damping = kFirstDamping;
  std::optional<Eigen::MatrixXd> derivatives;
  for (int i = 0; i < most_steps && damping < kMostDamping; ++i) {
    if (!derivatives) {
      derivatives = Derivatives(problem, state.unknowns, evaluation->residuals, radius);
      if (!derivatives) break;
      state.information = derivatives->transpose() * *derivatives;
      state.squares = evaluation->residuals.squaredNorm();
    }
    const FitUnknowns gradient = derivatives->transpose() * evaluation->residuals;
    const FitUnknowns next = state.unknowns + DampedStep(state.information, gradient, damping);
    auto there = next.allFinite() ? problem.Evaluate(next, RadiusDeviation(radius)) : std::nullopt;
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
    damping = std::max(0.1 * damping, kLeastDamping);
    if (converged) break;
    derivatives.reset();
  }
  state.evaluation = std::move(*evaluation);
  return state;
}

}  // namespace rockyard::vision
