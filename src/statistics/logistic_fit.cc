#include "statistics/logistic_fit.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "core/check.h"
#include "core/numbers.h"
#include "core/random.h"

namespace rockyard::statistics {

namespace {

// P(chi-square with that many degrees of freedom > statistic).
double ChiSquareTail(double statistic, int degrees_of_freedom) {
  return boost::math::cdf(boost::math::complement(
      boost::math::chi_squared(static_cast<double>(degrees_of_freedom)), statistic));
}

using core::kInfinity;
using core::kNaN;
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
  // Nothing but failures, or nothing but successes.
  if (first_success > last_success || first_failure > last_failure) return FitStatus::kNoContrast;
  // A maximum exists only if neither outcome lies wholly on one side of the other (Silvapulle
  // 1981).
  const bool overlap = first_success < last_failure && first_failure < last_success;
  return overlap ? FitStatus::kFitted : FitStatus::kSeparated;
}

// 2 sum (O ln(O/E)) over successes and failures of every setting: twice the log-likelihood that a
// rate of its own for every setting would gain.
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

// Inverse of the information, with the intercept moved from the centre c to u = 0, a_0 = a - b c:
// var(a_0) = var(a) - 2 c cov(a, b) + c^2 var(b), cov(a_0, b) = cov(a, b) - c var(b).
std::array<double, 3> Covariance(const LikelihoodSlopes& s, double centre) {
  const double determinant = s.aa * s.bb - s.ab * s.ab;
  const double aa = s.bb / determinant;
  const double ab = -s.ab / determinant;
  const double bb = s.aa / determinant;
  return {aa - 2.0 * centre * ab + centre * centre * bb, ab - centre * bb, bb};
}

// Variance of the logit at u, (1, u) V (1, u)'.
double VarianceAt(const std::array<double, 3>& covariance, double u) {
  return std::max(0.0, covariance[0] + 2.0 * u * covariance[1] + u * u * covariance[2]);
}

double QuantileOf(const LogisticFit& fit, double confidence) {
  const double tail = 0.5 + 0.5 * confidence;
  // Wald's normal law, or Student's with a degree of freedom less than clusters.
  if (fit.clusters == 0) return core::NormalQuantile(tail);
  if (fit.clusters < 3) return kInfinity;
  return boost::math::quantile(boost::math::students_t(static_cast<double>(fit.clusters) - 1.0),
                               tail);
}

// How much more clusters scatter the logit at u than independent trials would.
double ExcessAt(const LogisticFit& fit, double u) {
  if (fit.clusters == 0) return 1.0;
  return VarianceAt(fit.covariance, u) / VarianceAt(fit.model_covariance, u);
}

// How much less likely the runs are if the curve has the rate of `logit` at u0: likelihood ratio.
double RatioAt(std::span<const Dose> doses, double best, double logit, double u0) {
  // The curve through (u0, logit): its intercept at the centre u0 is fixed, its slope free.
  LogitLine line{logit, 0.0, u0};
  return 2.0 * (best - MaximizeLikelihood(doses, FreeParameters::kSlope, line));
}

// One end of the interval, on the scale of the fit. Requires a ratio above the bound far away.
double CrossingEnd(std::span<const Dose> doses, const LogisticFit& fit, double logit,
                   double estimate, double bound, double direction) {
  const auto inside = [&](double u) {
    return RatioAt(doses, fit.log_likelihood, logit, u) <= bound * ExcessAt(fit, u);
  };
  constexpr int kDoublings = 60;
  constexpr int kHalvings = 60;
  // Outwards in doubling steps until the ratio exceeds the bound, then bisection between the last
  // two.
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
                  .model_covariance = {kNaN, kNaN, kNaN},
                  .log_likelihood = kNaN,
                  .deviance = kNaN,
                  .p_value = kNaN,
                  .slope_ratio = kNaN,
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
  fit.model_covariance = fit.covariance;
  fit.deviance = Deviance(doses, line);
  fit.degrees_of_freedom = static_cast<int>(doses.size()) - 2;
  if (fit.degrees_of_freedom > 0) {
    fit.p_value = ChiSquareTail(fit.deviance, fit.degrees_of_freedom);
  }
  // Likelihood ratio against the fit without a slope, chi-square with one degree of freedom
  // (Wilks).
  fit.slope_ratio = 2.0 * std::max(0.0, fit.log_likelihood - without_slope);
  fit.slope_p_value = ChiSquareTail(fit.slope_ratio, 1);
  return fit;
}

double LogisticFit::Rate(double x) const { return Expit(intercept + slope * Transform(scale, x)); }

Interval LogisticFit::Band(double x, double confidence) const {
  const double u = Transform(scale, x);
  const double logit = intercept + slope * u;
  if (clusters > 0 && clusters < 3) return {0.0, 1.0};
  // logit +- z sqrt((1, u) V (1, u)'), turned back into rates.
  const double half = QuantileOf(*this, confidence) * std::sqrt(VarianceAt(covariance, u));
  return {Expit(logit - half), Expit(logit + half)};
}

void ClusterScores::Add(std::size_t cluster, double x, bool success) {
  if (cluster >= scores_.size()) scores_.resize(cluster + 1);
  const double u = Transform(fit_.scale, x);
  const double rate = fit_.Rate(x);
  const double excess = (success ? 1.0 : 0.0) - rate;
  const double weight = rate * (1.0 - rate);
  LikelihoodSlopes& score = scores_[cluster];
  score.a += excess;
  score.b += excess * u;
  score.aa += weight;
  score.ab += weight * u;
  score.bb += weight * u * u;
}

LogisticFit ClusterScores::Fit(bool shared_within) const {
  EXPECT(fit_.status == FitStatus::kFitted);
  const auto& [aa, ab, bb] = fit_.model_covariance;
  double clusters = 0.0;
  std::array<double, 3> sums{};
  for (const LikelihoodSlopes& score : scores_) {
    // A number without trials is no cluster.
    if (score.aa <= 0.0) continue;
    clusters += 1.0;
    // (I - A V) y = s.
    const double m_aa = 1.0 - (score.aa * aa + score.ab * ab);
    const double m_ab = -(score.aa * ab + score.ab * bb);
    const double m_ba = -(score.ab * aa + score.bb * ab);
    const double m_bb = 1.0 - (score.ab * ab + score.bb * bb);
    const double determinant = m_aa * m_bb - m_ab * m_ba;
    const double y_a = (m_bb * score.a - m_ab * score.b) / determinant;
    const double y_b = (m_aa * score.b - m_ba * score.a) / determinant;
    // V y, and the sum over clusters of (V y)(V y)'.
    const double a = aa * y_a + ab * y_b;
    const double b = ab * y_a + bb * y_b;
    sums[0] += a * a;
    sums[1] += a * b;
    sums[2] += b * b;
  }
  LogisticFit fit = fit_;
  fit.clusters = static_cast<std::int64_t>(clusters);
  if (shared_within) fit.p_value = kNaN;
  if (clusters < 3.0) {
    fit.covariance = {kInfinity, 0.0, kInfinity};
    fit.slope_p_value = 1.0;
    return fit;
  }
  fit.covariance = sums;
  // As for crossings, whose interval has two ends where a level curve is rejected.
  // Cells whose trials are equal have none, and a scatter of rounding.
  constexpr double kRounding = 1e-12;
  fit.slope_p_value = 1.0;
  if (fit.covariance[2] <= kRounding * fit.model_covariance[2]) return fit;
  const boost::math::students_t law(clusters - 1.0);
  // The likelihood ratio in the units of the clusters' scatter: its root as Student's t.
  const double t = std::sqrt(fit.slope_ratio * fit.model_covariance[2] / fit.covariance[2]);
  fit.slope_p_value = 2.0 * boost::math::cdf(boost::math::complement(law, t));
  return fit;
}

FitCrossing FindCrossing(const LogisticFit& fit, std::span<const DosePoint> points, double rate,
                         double confidence) {
  EXPECT(fit.status == FitStatus::kFitted);
  EXPECT(rate > 0.0 && rate < 1.0);
  const std::vector<Dose> doses = PoolDoses(points, fit.scale);
  const double logit = Logit(rate);
  // intercept + slope u = logit(rate).
  const double u = (logit - fit.intercept) / fit.slope;  // not finite where the curve is level
  const double z = QuantileOf(fit, confidence);
  FitCrossing crossing{.rate = rate, .x = std::isfinite(u) ? Inverse(fit.scale, u) : kNaN};
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

namespace {

constexpr int kMaxSteps = 200;
constexpr double kConverged = 1e-15;  // relative gain of log-likelihood

// ln(1 + e^z) without overflow.
double SoftPlus(double z) { return std::max(z, 0.0) + std::log1p(std::exp(-std::fabs(z))); }

// log L = sum k eta - n ln(1 + e^eta), without the binomial coefficients, eta the logit.
double LogLikelihood(std::span<const Dose> doses, const LogitLine& line) {
  double sum = 0.0;
  for (const Dose& dose : doses) {
    const double logit = line.At(dose.u);
    sum += dose.count * logit - dose.trials * SoftPlus(logit);
  }
  return sum;
}

// Newton's step: information I times step = gradient. For both parameters a 2 x 2 system.
LogitLine StepOf(const LikelihoodSlopes& s, FreeParameters free) {
  if (free == FreeParameters::kIntercept) return {s.a / s.aa, 0.0};
  if (free == FreeParameters::kSlope) return {0.0, s.b / s.bb};
  const double determinant = s.aa * s.bb - s.ab * s.ab;
  return {(s.bb * s.a - s.ab * s.b) / determinant, (s.aa * s.b - s.ab * s.a) / determinant};
}

}  // namespace

double Transform(FitScale scale, double x) { return scale == FitScale::kLog ? std::log(x) : x; }

double Inverse(FitScale scale, double u) { return scale == FitScale::kLog ? std::exp(u) : u; }

double Expit(double logit) { return 1.0 / (1.0 + std::exp(-logit)); }

std::vector<Dose> PoolDoses(std::span<const DosePoint> points, FitScale scale) {
  std::map<double, Dose> pooled;
  for (const DosePoint& point : points) {
    EXPECT(point.count >= 0 && point.count <= point.trials);
    EXPECT(scale == FitScale::kLinear || point.x > 0.0);
    if (point.trials == 0) continue;
    Dose& dose = pooled[Transform(scale, point.x)];
    dose.count += static_cast<double>(point.count);
    dose.trials += static_cast<double>(point.trials);
  }
  std::vector<Dose> doses;
  for (auto& [u, dose] : pooled) {
    dose.u = u;
    doses.push_back(dose);
  }
  return doses;
}

LikelihoodSlopes SlopesAt(std::span<const Dose> doses, const LogitLine& line) {
  LikelihoodSlopes s;
  for (const Dose& dose : doses) {
    // With p = expit(eta): gradient sum (k - n p)(1, v), information sum n p (1 - p) (1, v)(1, v)'.
    const double v = dose.u - line.centre;
    const double rate = Expit(line.At(dose.u));
    const double excess = dose.count - dose.trials * rate;
    const double weight = dose.trials * rate * (1.0 - rate);
    s.a += excess;
    s.b += excess * v;
    s.aa += weight;
    s.ab += weight * v;
    s.bb += weight * v * v;
  }
  return s;
}

double MaximizeLikelihood(std::span<const Dose> doses, FreeParameters free, LogitLine& line) {
  double best = LogLikelihood(doses, line);
  for (int step = 0; step < kMaxSteps; ++step) {
    const LogitLine move = StepOf(SlopesAt(doses, line), free);
    double share = 1.0;
    double next = -std::numeric_limits<double>::infinity();
    LogitLine tried = line;
    // log L is concave, so a short enough part of Newton's step never lowers it.
    for (; share > 1e-10; share *= 0.5) {
      tried.a = line.a + share * move.a;
      tried.b = line.b + share * move.b;
      next = LogLikelihood(doses, tried);
      if (next >= best) break;
    }
    if (!(next >= best)) return best;
    const double gain = next - best;
    line = tried;
    best = next;
    if (gain <= kConverged * (1.0 + std::fabs(best))) return best;
  }
  return best;
}

}  // namespace rockyard::statistics
