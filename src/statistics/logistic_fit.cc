#include "statistics/logistic_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/distributions.h"
#include "statistics/goodness_of_fit.h"
#include "statistics/logistic_likelihood.h"

namespace rockyard::statistics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
double Logit(double rate) { return std::log(rate / (1.0 - rate)); }

double WeightedMean(std::span<const Dose> doses) {
  double sum = 0.0;
  double trials = 0.0;
  for (const Dose& dose : doses) {
    sum += dose.u * dose.trials;
    trials += dose.trials;
  }
  return sum / trials;
}

FitStatus StatusOf(std::span<const Dose> doses) {
  if (doses.size() < 2) return FitStatus::kTooFewPoints;
  // Doses ascend, so that the first and the last of each outcome bound it.
  double first_success = kInfinity;
  double last_success = -kInfinity;
  double first_failure = kInfinity;
  double last_failure = -kInfinity;
  for (const Dose& dose : doses) {
    if (dose.count > 0.0) {
      first_success = std::min(first_success, dose.u);
      last_success = dose.u;
    }
    if (dose.count < dose.trials) {
      first_failure = std::min(first_failure, dose.u);
      last_failure = dose.u;
    }
  }
  if (first_success > last_success || first_failure > last_failure) return FitStatus::kNoContrast;
  const bool overlap = first_success < last_failure && first_failure < last_success;
  return overlap ? FitStatus::kFitted : FitStatus::kSeparated;
}

double Deviance(std::span<const Dose> doses, const LogitLine& line) {
  const auto term = [](double observed, double expected) {
    return observed > 0.0 ? observed * std::log(observed / expected) : 0.0;
  };
  double sum = 0.0;
  for (const Dose& dose : doses) {
    const double logit = line.At(dose.u);
    sum += term(dose.count, dose.trials * Expit(logit));
    sum += term(dose.trials - dose.count, dose.trials * Expit(-logit));
  }
  return std::max(0.0, 2.0 * sum);  // rounding, where the curve meets every rate
}

// Inverse of the information, with the intercept moved from the centre to u = 0.
std::array<double, 3> Covariance(const LikelihoodSlopes& s, double centre) {
  const double determinant = s.aa * s.bb - s.ab * s.ab;
  const double aa = s.bb / determinant;
  const double ab = -s.ab / determinant;
  const double bb = s.aa / determinant;
  return {aa - 2.0 * centre * ab + centre * centre * bb, ab - centre * bb, bb};
}

double NormalOf(double confidence) { return core::NormalQuantile(0.5 + 0.5 * confidence); }

// How much less likely the runs are if the curve has the rate of `logit` at u0: likelihood ratio.
double RatioAt(std::span<const Dose> doses, double best, double logit, double u0) {
  LogitLine line{logit, 0.0, u0};
  return 2.0 * (best - MaximizeLikelihood(doses, FreeParameters::kSlope, line));
}

// One end of the interval, on the scale of the fit. Requires a ratio above the bound far away.
double CrossingEnd(std::span<const Dose> doses, const LogisticFit& fit, double logit,
                   double estimate, double bound, double direction) {
  const auto inside = [&](double u) {
    return RatioAt(doses, fit.log_likelihood, logit, u) <= bound;
  };
  constexpr int kDoublings = 60;
  constexpr int kHalvings = 60;
  double reach = 0.01 * (doses.back().u - doses.front().u);
  int doubled = 0;
  while (inside(estimate + direction * reach)) {
    if (++doubled > kDoublings) return direction * kInfinity;
    reach *= 2.0;
  }
  double in = doubled == 0 ? 0.0 : 0.5 * reach;
  double out = reach;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (in + out);
    (inside(estimate + direction * middle) ? in : out) = middle;
  }
  return estimate + direction * 0.5 * (in + out);
}

}  // namespace

LogisticFit FitLogistic(std::span<const DosePoint> points, FitScale scale) {
  const std::vector<Dose> doses = PoolDoses(points, scale);
  LogisticFit fit{.status = StatusOf(doses),
                  .scale = scale,
                  .intercept = kNaN,
                  .slope = kNaN,
                  .covariance = {kNaN, kNaN, kNaN},
                  .log_likelihood = kNaN,
                  .deviance = kNaN,
                  .p_value = kNaN,
                  .slope_p_value = kNaN,
                  .lowest_x = kNaN,
                  .highest_x = kNaN};
  if (!doses.empty()) {
    fit.lowest_x = Inverse(scale, doses.front().u);
    fit.highest_x = Inverse(scale, doses.back().u);
  }
  if (fit.status != FitStatus::kFitted) return fit;
  LogitLine line{0.0, 0.0, WeightedMean(doses)};
  const double without_slope = MaximizeLikelihood(doses, FreeParameters::kIntercept, line);
  fit.log_likelihood = MaximizeLikelihood(doses, FreeParameters::kBoth, line);
  fit.intercept = line.a - line.b * line.centre;
  fit.slope = line.b;
  fit.covariance = Covariance(SlopesAt(doses, line), line.centre);
  fit.deviance = Deviance(doses, line);
  fit.degrees_of_freedom = static_cast<int>(doses.size()) - 2;
  if (fit.degrees_of_freedom > 0) {
    fit.p_value = ChiSquareTail(fit.deviance, fit.degrees_of_freedom);
  }
  fit.slope_p_value = ChiSquareTail(2.0 * std::max(0.0, fit.log_likelihood - without_slope), 1);
  return fit;
}

double LogisticFit::Rate(double x) const { return Expit(intercept + slope * Transform(scale, x)); }

Interval LogisticFit::Band(double x, double confidence) const {
  const double u = Transform(scale, x);
  const double logit = intercept + slope * u;
  const double variance = covariance[0] + 2.0 * u * covariance[1] + u * u * covariance[2];
  const double half = NormalOf(confidence) * std::sqrt(std::max(0.0, variance));
  return {Expit(logit - half), Expit(logit + half)};
}

FitCrossing FindCrossing(const LogisticFit& fit, std::span<const DosePoint> points, double rate,
                         double confidence) {
  EXPECT(fit.status == FitStatus::kFitted);
  EXPECT(rate > 0.0 && rate < 1.0);
  const std::vector<Dose> doses = PoolDoses(points, fit.scale);
  const double logit = Logit(rate);
  const double u = (logit - fit.intercept) / fit.slope;
  const double z = NormalOf(confidence);
  FitCrossing crossing{.rate = rate, .x = Inverse(fit.scale, u)};
  crossing.extrapolated = !(crossing.x >= fit.lowest_x && crossing.x <= fit.highest_x);
  double low = -kInfinity;
  double high = kInfinity;
  // Without a significant slope no x0 is rejected, however far away.
  if (fit.slope_p_value < 1.0 - confidence) {
    low = CrossingEnd(doses, fit, logit, u, z * z, -1.0);
    high = CrossingEnd(doses, fit, logit, u, z * z, 1.0);
  }
  crossing.interval = {Inverse(fit.scale, low), Inverse(fit.scale, high)};
  return crossing;
}

}  // namespace rockyard::statistics
