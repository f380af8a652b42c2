// Success against one number: the logistic curve through counts, its band, and where it crosses a
// rate.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "statistics/proportions.h"

namespace rockyard::statistics {

enum class FitScale { kLinear, kLog };

// Runs at one setting x; positive where the scale is a logarithm.
struct DosePoint {
  double x = 0.0;
  std::int64_t count = 0;   // successes
  std::int64_t trials = 0;  // points without trials are left out
};

enum class FitStatus {
  kFitted,
  kTooFewPoints,  // fewer than two settings with trials
  kNoContrast,    // nothing but successes, or nothing but failures
  kSeparated,     // no setting at which outcomes overlap: the steepest curve is the likeliest
};

// logit P(success) = intercept + slope u, with u = x or u = ln x, by maximum likelihood. All
// numbers are NaN unless fitted.
struct LogisticFit {
  FitStatus status = FitStatus::kTooFewPoints;
  FitScale scale = FitScale::kLinear;
  double intercept = 0.0;
  double slope = 0.0;
  std::array<double, 3> covariance{};  // var(intercept), cov(intercept, slope), var(slope)
  double log_likelihood = 0.0;         // without the binomial coefficients
  // Against the model with a rate of its own for every setting, as chi-square with so many degrees
  // of freedom (settings less two). p is NaN where none is left; it is only near where settings
  // expect fewer than about five successes or failures.
  double deviance = 0.0;
  int degrees_of_freedom = 0;
  double p_value = 1.0;
  double slope_p_value = 1.0;  // of no slope at all: likelihood ratio, one degree of freedom
  double lowest_x = 0.0;       // range of the settings
  double highest_x = 0.0;

  double Rate(double x) const;
  // Pointwise: Wald's interval of the logit, turned back into a rate. Coverage is near nominal
  // where the settings around x have some dozens of trials.
  Interval Band(double x, double confidence = 0.95) const;
};

// Iteratively reweighted least squares (McCullagh and Nelder 1989, section 4.4), which is Newton's
// method on a concave function, halving steps that go too far. Trials are taken as independent,
// within and between settings. The likelihood has a maximum only where outcomes overlap (Silvapulle
// 1981); where they do not, this says so instead of shrinking to a finite curve (Firth 1993): the
// steepness would then come from the penalty and not from the runs. Settings with equal x are
// pooled. Cost: linear in the points, about ten passes.
LogisticFit FitLogistic(std::span<const DosePoint> points, FitScale scale);

// The x at which the fitted curve has a rate, with its profile likelihood interval: every x0 that
// the likelihood ratio test does not reject (one degree of freedom). Where the slope itself is not
// significant every x0 passes: the interval is then from -infinity (0 on a log scale) to infinity.
struct FitCrossing {
  double rate = 0.5;
  double x = 0.0;
  Interval interval{};
  bool extrapolated = false;  // x lies outside of the settings
};

// 0 < rate < 1; `fit` of the same points, fitted. Cost: some hundred passes over the points.
FitCrossing FindCrossing(const LogisticFit& fit, std::span<const DosePoint> points, double rate,
                         double confidence = 0.95);

}  // namespace rockyard::statistics
