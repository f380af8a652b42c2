#include "terrain/rock_size_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"

namespace rockyard::terrain {
namespace {

// Integral of x^(power - 1) from low to high.
double PowerIntegral(double power, double low, double high) {
  if (power == 0.0) return std::log(high / low);
  return (std::pow(high, power) - std::pow(low, power)) / power;
}

}  // namespace

double MooreCoveredFraction(double k_per_m2, double low_m, double high_m) {
  EXPECT(low_m > 0.0 && high_m >= low_m);
  return 0.25 * std::numbers::pi * k_per_m2 * kMooreExponent *
         PowerIntegral(2.0 - kMooreExponent, low_m, high_m);
}

MooreSizeLaw::MooreSizeLaw(double min_m, double max_m)
    : min_m_(min_m),
      max_m_(max_m),
      number_at_min_(MooreNumberPerM2(1.0, min_m)),
      number_at_max_(MooreNumberPerM2(1.0, max_m)) {
  EXPECT(min_m > 0.0 && max_m > min_m);
}

double MooreSizeLaw::Diameter(double probability) const {
  const double number = number_at_min_ - probability * (number_at_min_ - number_at_max_);
  return std::clamp(std::pow(number, -1.0 / kMooreExponent), min_m_, max_m_);
}

double MooreSizeLaw::Cdf(double diameter_m) const {
  const double number = MooreNumberPerM2(1.0, std::clamp(diameter_m, min_m_, max_m_));
  return (number_at_min_ - number) / (number_at_min_ - number_at_max_);
}

double MooreSizeLaw::MeanPower(double power) const {
  return kMooreExponent * PowerIntegral(power - kMooreExponent, min_m_, max_m_) /
         (number_at_min_ - number_at_max_);
}

UniformSizeLaw::UniformSizeLaw(double min_m, double max_m) : min_m_(min_m), max_m_(max_m) {
  EXPECT(min_m > 0.0 && max_m >= min_m);
}

double UniformSizeLaw::Diameter(double probability) const {
  return min_m_ + probability * (max_m_ - min_m_);
}

double UniformSizeLaw::Cdf(double diameter_m) const {
  if (max_m_ == min_m_) return diameter_m < min_m_ ? 0.0 : 1.0;
  return std::clamp((diameter_m - min_m_) / (max_m_ - min_m_), 0.0, 1.0);
}

double UniformSizeLaw::MeanPower(double power) const {
  if (max_m_ == min_m_) return std::pow(min_m_, power);
  return PowerIntegral(power + 1.0, min_m_, max_m_) / (max_m_ - min_m_);
}

std::unique_ptr<RockSizeLaw> MakeSizeLaw(const RockFieldParams& params) {
  switch (params.kind) {
    case RockFieldKind::kNone:
    case RockFieldKind::kListed:
      break;
    case RockFieldKind::kMoore:
      return std::make_unique<MooreSizeLaw>(params.min_diameter_m, params.max_diameter_m);
    case RockFieldKind::kUniformCount:
      return std::make_unique<UniformSizeLaw>(params.uniform_min_diameter_m,
                                              params.uniform_max_diameter_m);
  }
  return nullptr;
}

}  // namespace rockyard::terrain
