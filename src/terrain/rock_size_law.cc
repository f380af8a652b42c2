#include "terrain/rock_size_law.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace rockyard::terrain {
namespace {

// Returns the integral of x^(power - 1) from low to high: (high^power - low^power) / power. At
// power 0 it is a logarithm; high may be infinite where power < 0.
double PowerIntegral(double power, double low, double high) {
  if (power == 0.0) return std::log(high / low);
  return (std::pow(high, power) - std::pow(low, power)) / power;
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
  return std::clamp(std::pow(number, -1.0 / kMooreExponent), min_m_, max_m_);
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
