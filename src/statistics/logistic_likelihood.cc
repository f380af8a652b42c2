#include "statistics/logistic_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/check.h"

namespace rockyard::statistics {
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
