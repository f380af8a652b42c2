#include "vision/cylinder/fit_descent.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <optional>
#include <utility>

#include "core/check.h"

namespace rockyard::vision {
namespace {

constexpr double kMostDamping = 1e3;
constexpr double kLeastDamping = 1e-6;
constexpr double kFirstDamping = 1e-3;
// Of the squared residuals: this, or this share of a hundredth of them.
constexpr double kConverged = 1e-2;
constexpr int kOrientation = 2;  // of the unknowns
constexpr int kRadius = 4;
// A radius that is the cylinder's, and one that is free, over it.
constexpr double kFixedRadius_sd = 1e-4;
constexpr double kFreeRadius_sd = 1.0;

bool Moves(int unknown, FitFreedom freedom) {
  if (unknown == kOrientation) return freedom != FitFreedom::kPlace;
  return unknown != kRadius || freedom == FitFreedom::kRadius;
}

// Forward derivatives of the residuals; of a radius that stays that of its prior alone, which comes
// last, and of a theta that stays none. Nothing where a step leaves what can be imaged.
std::optional<Eigen::MatrixXd> Derivatives(const FitProblem& problem, const FitUnknowns& unknowns,
                                           const Eigen::VectorXd& residuals, FitFreedom freedom) {
  const FitUnknowns steps = problem.Steps();
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(residuals.size(), steps.size());
  for (int i = 0; i < steps.size(); ++i) {
    if (!Moves(i, freedom)) {
      if (i == kRadius) derivatives(residuals.size() - 1, i) = 1.0 / kFixedRadius_sd;
      continue;
    }
    FitUnknowns step = FitUnknowns::Zero();
    step[i] = steps[i];
    const auto ahead = problem.Evaluate(unknowns + step, RadiusDeviation(freedom));
    if (!ahead) return std::nullopt;
    derivatives.col(i) = (ahead->residuals - residuals) / steps[i];
  }
  return derivatives;
}

// Towards the minimum of the linear problem; a theta without derivatives stays.
FitUnknowns DampedStep(const FitInformation& information, const FitUnknowns& gradient,
                       double damping) {
  FitInformation damped = information;
  damped.diagonal() *= 1.0 + damping;
  if (damped(kOrientation, kOrientation) == 0.0) damped(kOrientation, kOrientation) = 1.0;
  return -damped.ldlt().solve(gradient);
}

}  // namespace

double RadiusDeviation(FitFreedom freedom) {
  return freedom == FitFreedom::kRadius ? kFreeRadius_sd : kFixedRadius_sd;
}

FitState DescendFrom(const FitProblem& problem, const FitUnknowns& start, FitFreedom freedom,
                     int most_steps) {
  EXPECT(most_steps >= 1);
  FitState state;
  state.unknowns = start;
  auto evaluation = problem.Evaluate(start, RadiusDeviation(freedom));
  if (!evaluation) return state;
  double damping = kFirstDamping;
  std::optional<Eigen::MatrixXd> derivatives;
  for (int i = 0; i < most_steps && damping < kMostDamping; ++i) {
    if (!derivatives) {
      derivatives = Derivatives(problem, state.unknowns, evaluation->residuals, freedom);
      if (!derivatives) break;
      state.information = derivatives->transpose() * *derivatives;
      state.squares = evaluation->residuals.squaredNorm();
    }
    const FitUnknowns gradient = derivatives->transpose() * evaluation->residuals;
    const FitUnknowns next = state.unknowns + DampedStep(state.information, gradient, damping);
    auto there = next.allFinite() ? problem.Evaluate(next, RadiusDeviation(freedom)) : std::nullopt;
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
