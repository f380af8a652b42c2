#include "statistics/closed_forms.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/check.h"

namespace rockyard::statistics {

// 1 - (1 - p)^n, without loss of digits where p is small.
double AnyOf(double p, double n) { return -std::expm1(n * std::log1p(-p)); }

double NetRate(double step_m, double speed_m_s, double scan_time_s) {
  // Each step takes step / speed to drive and a scan at rest.
  return step_m / (step_m / speed_m_s + scan_time_s);
}

double RangeResolution(double pitch_rad, double range_m, double baseline_m) {
  // R = b / (pitch n) at a disparity of n pixels, so one pixel stands for dR = pitch R^2 / b
  // (Matthies 1995 eq. 2, differentiated).
  return pitch_rad * range_m * range_m / baseline_m;
}

double PowerLaw(double k, double size, double exponent) { return k * std::pow(size, -exponent); }

double PowerLawCover(double k, double diameter, double exponent) {
  EXPECT(exponent > 2.0);
  // The integral of pi/4 d^2 over -dN, N = k d^-m.
  return 0.25 * std::numbers::pi * exponent / (exponent - 2.0) *
         PowerLaw(k, diameter, exponent - 2.0);
}

DriftDeviation DeviationOf(const StraightDrift& drift) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const std::int64_t steps = std::llround(drift.distance_m / drift.step_m);
  const double length_variance = drift.distance_variance_m2_per_m * drift.step_m;
  const double turn_variance =
      drift.heading_variance_deg2_per_m * drift.step_m * kRadPerDeg * kRadPerDeg;
  const double s = drift.step_m;
  double mean_x = 0.0;
  double square_x = 0.0;
  double square_y = 0.0;
  // x = sum d_i cos(phi_i), y = sum d_i sin(phi_i); phi_i is a sum of i normal turns, of variance
  // V_i = i q. For i <= j: cos cos and sin sin are (cos(phi_i - phi_j) +- cos(phi_i + phi_j)) / 2,
  // whose arguments have the variances V_j - V_i and V_j + 3 V_i; E[cos] of a normal angle of
  // variance V is exp(-V/2).
  for (std::int64_t i = 0; i < steps; ++i) {
    const double v_i = static_cast<double>(i) * turn_variance;
    mean_x += s * std::exp(-0.5 * v_i);
    for (std::int64_t j = i; j < steps; ++j) {
      const double v_j = static_cast<double>(j) * turn_variance;
      const double difference = std::exp(-0.5 * (v_j - v_i));
      const double sum = std::exp(-0.5 * (v_j + 3.0 * v_i));
      // Pairs of different steps count twice.
      const double weight = i == j ? 0.5 * (s * s + length_variance) : s * s;
      square_x += weight * (difference + sum);
      square_y += weight * (difference - sum);
    }
  }
  return {std::sqrt(square_x - mean_x * mean_x), std::sqrt(square_y)};
}

std::size_t FormulaArity(Formula formula) {
  switch (formula) {
    case Formula::kAnyOf:
    case Formula::kQuotient:
      return 2;
    case Formula::kNetRate:
    case Formula::kRangeResolution:
    case Formula::kPowerLaw:
    case Formula::kPowerLawCover:
      return 3;
    case Formula::kDriftAlong:
    case Formula::kDriftAcross:
      return 4;
    case Formula::kNone:
    case Formula::kSum:
    case Formula::kProduct:
      break;
  }
  return 0;
}

bool InDomain(Formula formula, std::span<const double> inputs) {
  constexpr double kMaxSteps = 1e4;  // the cost grows with their square
  switch (formula) {
    case Formula::kPowerLawCover:
      return inputs[1] > 0.0 && inputs[2] > 2.0;
    case Formula::kDriftAlong:
    case Formula::kDriftAcross:
      return inputs[0] > 0.0 && inputs[1] > 0.0 && inputs[1] <= kMaxSteps * inputs[0] &&
             inputs[2] >= 0.0 && inputs[3] >= 0.0;
    default:
      return true;
  }
}

double Evaluate(Formula formula, std::span<const double> inputs) {
  EXPECT(FormulaArity(formula) == 0 || FormulaArity(formula) == inputs.size());
  switch (formula) {
    case Formula::kAnyOf:
      return AnyOf(inputs[0], inputs[1]);
    case Formula::kSum:
      return std::accumulate(inputs.begin(), inputs.end(), 0.0);
    case Formula::kProduct:
      return std::accumulate(inputs.begin(), inputs.end(), 1.0, std::multiplies<>());
    case Formula::kQuotient:
      return inputs[0] / inputs[1];
    case Formula::kNetRate:
      return NetRate(inputs[0], inputs[1], inputs[2]);
    case Formula::kRangeResolution:
      return RangeResolution(inputs[0], inputs[1], inputs[2]);
    case Formula::kPowerLaw:
      return PowerLaw(inputs[0], inputs[1], inputs[2]);
    case Formula::kPowerLawCover:
      return PowerLawCover(inputs[0], inputs[1], inputs[2]);
    case Formula::kDriftAlong:
      return DeviationOf({inputs[0], inputs[1], inputs[2], inputs[3]}).along_m;
    case Formula::kDriftAcross:
      return DeviationOf({inputs[0], inputs[1], inputs[2], inputs[3]}).across_m;
    case Formula::kNone:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rockyard::statistics
