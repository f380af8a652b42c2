#include "terrain/rock_size_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::terrain {
namespace {

// Returns the integral of x^(power - 1) from low to high: (high^power - low^power) / power. At
// power 0 it is a logarithm; high may be infinite where power < 0.
double PowerIntegral(double power, double low, double high) {
  if (power == 0.0) return math::Log(high / low);
  return (math::Pow(high, power) - math::Pow(low, power)) / power;
}

}  // namespace

MooreSizeLaw::MooreSizeLaw(double min_m, double max_m)
    : min_m_(min_m),
      max_m_(max_m),
      // N(D) of the law with k = 1 at both bounds: k cancels in the distribution of sizes.
      number_at_min_(MooreNumberPerM2(1.0, min_m)),
      number_at_max_(MooreNumberPerM2(1.0, max_m)) {
  EXPECT(min_m > 0.0 && max_m > min_m);
}

double MooreSizeLaw::Diameter(double probability) const {
  // Cdf(D) = (N(D_0) - N(D)) / (N(D_0) - N(D_1)) with N(D) = D^-m, solved for D. Rounding may leave
  // the range by the last digit, hence the clamp.
  const double number = number_at_min_ - probability * (number_at_min_ - number_at_max_);
  return std::clamp(math::Pow(number, -1.0 / kMooreExponent), min_m_, max_m_);
}

double MooreSizeLaw::Cdf(double diameter_m) const {
  const double number = MooreNumberPerM2(1.0, std::clamp(diameter_m, min_m_, max_m_));
  return (number_at_min_ - number) / (number_at_min_ - number_at_max_);
}

double MooreSizeLaw::MeanPower(double power) const {
  // Density m D^(-m - 1) / (N_0 - N_1), times D^power.
  return kMooreExponent * PowerIntegral(power - kMooreExponent, min_m_, max_m_) /
         (number_at_min_ - number_at_max_);
}

GolombekSizeLaw::GolombekSizeLaw(double cover, double min_m, double max_m)
    : cover_(cover),
      decay_per_m_(GolombekDecayPerM(cover)),
      min_m_(min_m),
      max_m_(max_m),
      number_at_min_(GolombekNumberPerM2(cover, min_m)),
      number_at_max_(GolombekNumberPerM2(cover, max_m)) {
  EXPECT(cover > 0.0 && min_m > 0.0 && max_m > min_m);
}

double GolombekSizeLaw::Diameter(double probability) const {
  const double number = number_at_min_ - probability * (number_at_min_ - number_at_max_);
  // Newton on ln N(D) = ln number over x = ln D. There ln N is concave, as the density
  // exp(-q e^x - x) is log-concave: from above the root every step goes towards it, and a step
  // from below that leaves the bracket is halved instead.
  constexpr int kMaxSteps = 100;
  constexpr double kTolerance = 1e-9;  // the step after it is of its square
  double low = math::Log(min_m_);
  double high = math::Log(max_m_);
  double x = low;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double diameter_m = math::Exp(x);
    const double at = GolombekNumberPerM2(cover_, diameter_m);
    (at > number ? low : high) = x;
    const double step =
        math::Log(at / number) * at / (diameter_m * GolombekDensity(cover_, diameter_m));
    if (std::abs(step) < kTolerance) {
      x += step;
      break;
    }
    const bool within = x + step > low && x + step < high;
    x = within ? x + step : 0.5 * (low + high);
  }
  return std::clamp(math::Exp(x), min_m_, max_m_);
}

double GolombekSizeLaw::Cdf(double diameter_m) const {
  const double number = GolombekNumberPerM2(cover_, std::clamp(diameter_m, min_m_, max_m_));
  return (number_at_min_ - number) / (number_at_min_ - number_at_max_);
}

double GolombekSizeLaw::MeanPower(double power) const {
  EXPECT(power >= 0.0 && power == std::floor(power));
  if (power == 0.0) return 1.0;
  // Density c exp(-q D) / D^2, c = 4 k q / pi / (N_0 - N_1).
  const double q = decay_per_m_;
  const double c = 4.0 / std::numbers::pi * cover_ * q / (number_at_min_ - number_at_max_);
  if (power == 1.0)
    return c * (math::ExponentialIntegral(q * min_m_) - math::ExponentialIntegral(q * max_m_));
  // J(m) = integral of D^m exp(-q D) = [-D^m exp(-q D)] / q + m / q J(m - 1), by parts.
  double integral = 0.0;
  for (double m = 0.0; m <= power - 2.0; m += 1.0) {
    integral = (math::Pow(min_m_, m) * math::Exp(-q * min_m_) -
                math::Pow(max_m_, m) * math::Exp(-q * max_m_) + m * integral) /
               q;
  }
  return c * integral;
}

UniformSizeLaw::UniformSizeLaw(double min_m, double max_m) : min_m_(min_m), max_m_(max_m) {
  EXPECT(min_m > 0.0 && max_m >= min_m);
}

double UniformSizeLaw::Diameter(double probability) const {
  return min_m_ + probability * (max_m_ - min_m_);
}

double UniformSizeLaw::Cdf(double diameter_m) const {
  // A single size: a step.
  if (max_m_ == min_m_) return diameter_m < min_m_ ? 0.0 : 1.0;
  return std::clamp((diameter_m - min_m_) / (max_m_ - min_m_), 0.0, 1.0);
}

double UniformSizeLaw::MeanPower(double power) const {
  // All rocks have one size; the density 1 / (max - min) does not exist.
  if (max_m_ == min_m_) return math::Pow(min_m_, power);
  return PowerIntegral(power + 1.0, min_m_, max_m_) / (max_m_ - min_m_);
}

std::unique_ptr<RockSizeLaw> MakeSizeLaw(const RockFieldParams& params) {
  switch (params.RandomKind()) {
    case RockFieldKind::kNone:
    case RockFieldKind::kListed:
      break;
    case RockFieldKind::kMoore:
      return std::make_unique<MooreSizeLaw>(params.min_diameter_m, params.max_diameter_m);
    case RockFieldKind::kGolombek:
      return std::make_unique<GolombekSizeLaw>(params.cover, params.min_diameter_m,
                                               params.max_diameter_m);
    case RockFieldKind::kUniformCount:
      return std::make_unique<UniformSizeLaw>(params.uniform_min_diameter_m,
                                              params.uniform_max_diameter_m);
  }
  return nullptr;
}

std::unique_ptr<RockSizeLaw> MakeReferenceSizeLaw(const RockFieldParams& params) {
  RockFieldParams reference = params;
  reference.cover = params.cover_reference;
  return MakeSizeLaw(reference);
}

}  // namespace rockyard::terrain
