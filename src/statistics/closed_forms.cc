#include "statistics/closed_forms.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/check.h"
#include "statistics/straight_drift.h"

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
  constexpr double kMaxSteps = 1e4;
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
      return ExactMoments({inputs[0], inputs[1], inputs[2], inputs[3]}).along_m;
    case Formula::kDriftAcross:
      return ExactMoments({inputs[0], inputs[1], inputs[2], inputs[3]}).across_m;
    case Formula::kNone:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rockyard::statistics
