// Success against one number: the logistic curve through counts, its band, and where it crosses a
// rate. Sweeps along a numeric axis are fitted by it. No record, verdict or exit code depends on
// the fit: it may be rewritten within the coverage that is stated.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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
  // The same covariance if trials were independent: the inverse of the information.
  std::array<double, 3> model_covariance{};
  std::int64_t clusters = 0;    // 0: trials are independent, and both covariances are equal
  double log_likelihood = 0.0;  // without the binomial coefficients
  // The deviance from the model with a rate of its own for every setting, held against chi-square
  // with so many degrees of freedom (settings less two). The p-value is NaN where none is left; it
  // is only near where settings expect fewer than about five successes or failures. It knows
  // nothing of clusters: settings that share their random numbers scatter less about the curve than
  // it expects, so that it is then too large rather than too small. It is NaN where trials within a
  // setting share a cluster.
  double deviance = 0.0;
  int degrees_of_freedom = 0;
  double p_value = 1.0;
  double slope_ratio = 0.0;    // likelihood ratio of no slope at all
  double slope_p_value = 1.0;  // by that ratio, one degree of freedom
  double lowest_x = 0.0;       // range of the settings
  double highest_x = 0.0;

  double Rate(double x) const;
  // Returns the pointwise band: Wald's interval of the logit, turned back into a rate; with
  // clusters by Student's law with one degree of freedom less than clusters. Coverage is near
  // nominal where the settings around x have some dozens of trials.
  Interval Band(double x, double confidence = kConfidence) const;
};

// Fits by iteratively reweighted least squares (McCullagh and Nelder 1989, section 4.4), which is
// Newton's method on a concave function, halving steps that go too far. Trials are taken as
// independent, within and between settings. The likelihood has a maximum only where outcomes
// overlap (Silvapulle 1981); where they do not, the status says so. A curve shrunk to a finite one
// (Firth 1993) would have its steepness from the penalty and not from the runs. Settings with equal
// x are pooled. Cost: linear in the points, about ten passes.
LogisticFit FitLogistic(std::span<const DosePoint> points, FitScale scale);

// The gradient of the log-likelihood and the Fisher information in two parameters of the line.
struct LikelihoodSlopes {
  double a = 0.0;
  double b = 0.0;
  double aa = 0.0;
  double ab = 0.0;
  double bb = 0.0;
};

// The covariance of a fit whose trials hang together in clusters: those of one index in cells with
// common random numbers, those on one layout of rocks. Trials of different clusters are
// independent.
//
// Keeps for each cluster the slope s and the information A of its log-likelihood: 40 bytes. The
// covariance of the fit is then (Liang and Zeger 1986, Biometrika 73, pp. 13-22, with independence
// as the working correlation; A for the few clusters by Mancl and DeRouen 2001, Biometrics 57, pp.
// 126-134)
//   V (sum over clusters of y y^T) V,   y = (I - A V)^-1 s,   V the covariance of the model.
class ClusterScores {
 public:
  // `fit` must be kFitted, of all trials that are added, and must outlive this.
  explicit ClusterScores(const LogisticFit& fit) : fit_(fit) {}

  void Add(std::size_t cluster, double x, bool success);

  // The fit with the covariance of clusters. A cluster that is met twice within a setting must be
  // told by `shared_within`: the deviance then has no law. Fewer than three clusters say nothing:
  // bands are [0, 1], crossings have no bounds.
  LogisticFit Fit(bool shared_within) const;

 private:
  const LogisticFit& fit_;
  std::vector<LikelihoodSlopes> scores_;
};

// The x at which the fitted curve has a rate, with its profile likelihood interval: every x0 that
// the likelihood ratio test does not reject (one degree of freedom). With clusters the ratio is
// held against chi-square times the variance of the logit at x0 over that of the model (Rotnitzky
// and Jewell 1990, Biometrika 77, pp. 485-497). NaN and no bound where the curve is level. Where
// the slope itself is not significant every x0 passes: the interval is then from -infinity (0 on a
// log scale) to infinity.
struct FitCrossing {
  double rate = 0.5;
  double x = 0.0;
  Interval interval{};
  bool extrapolated = false;  // x lies outside of the settings
};

// Returns the crossing of a rate, 0 < rate < 1; `fit` is of the same points, and fitted. Cost: some
// hundred passes over the points.
FitCrossing FindCrossing(const LogisticFit& fit, std::span<const DosePoint> points, double rate,
                         double confidence = kConfidence);

// A setting on the scale of the fit. From here on: the likelihood of a logistic curve and its
// maximum, for logistic_fit.cc only.
struct Dose {
  double u = 0.0;
  double count = 0.0;
  double trials = 0.0;
};

double Transform(FitScale scale, double x);
double Inverse(FitScale scale, double u);
double Expit(double logit);

// Returns the settings ascending, equal ones pooled, those without trials left out.
std::vector<Dose> PoolDoses(std::span<const DosePoint> points, FitScale scale);

// logit = a + b (u - centre): a and b are nearly independent where the centre is that of the runs.
struct LogitLine {
  double a = 0.0;
  double b = 0.0;
  double centre = 0.0;

  double At(double u) const { return a + b * (u - centre); }
};

LikelihoodSlopes SlopesAt(std::span<const Dose> doses, const LogitLine& line);

// Which parameters a maximum is sought over; the others stay as they are.
enum class FreeParameters { kBoth, kIntercept, kSlope };

// Climbs by Newton's method from `line`, with steps halved that go too far, and returns the
// log-likelihood at its end. There must be a maximum.
double MaximizeLikelihood(std::span<const Dose> doses, FreeParameters free, LogitLine& line);

}  // namespace rockyard::statistics
