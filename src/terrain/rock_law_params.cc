#include <numbers>

#include "math/functions.h"
#include "terrain/rock_params.h"

namespace rockyard::terrain {
namespace {

// Returns E2(x) = exp(-x) - x E1(x), x > 0.
double SecondExponentialIntegral(double x) {
  // Further on the difference would lose all digits.
  if (x < 2.0) return math::Exp(-x) - x * math::ExponentialIntegral(x);
  // exp(-x) / (x + 2 - 1 2 / (x + 4 - 2 3 / (x + 6 - ...))): the even part of the continued
  // fraction of Abramowitz and Stegun 1964, 5.1.22. 48 terms are good to 1e-15 at
  // x = 2, where it converges worst.
  constexpr int kTerms = 48;
  double below = x + 2.0 * (kTerms + 1);
  for (int i = kTerms; i >= 1; --i) below = x + 2.0 * i - i * (i + 1.0) / below;
  return math::Exp(-x) / below;
}

}  // namespace

double MooreNumberPerM2(double k_per_m2, double diameter_m) {
  return k_per_m2 * math::Pow(diameter_m, -kMooreExponent);
}

double GolombekDecayPerM(double cover) { return 1.79 + 0.152 / cover; }

double GolombekDensity(double cover, double diameter_m) {
  const double q = GolombekDecayPerM(cover);
  return 4.0 / std::numbers::pi * cover * q * math::Exp(-q * diameter_m) /
         (diameter_m * diameter_m);
}

double GolombekNumberPerM2(double cover, double diameter_m) {
  const double q = GolombekDecayPerM(cover);
  return 4.0 / std::numbers::pi * cover * q * SecondExponentialIntegral(q * diameter_m) /
         diameter_m;
}

RockFieldKind RockFieldParams::RandomKind() const {
  if (kind != RockFieldKind::kListed) return kind;
  switch (listed.rest) {
    case RestOfRocks::kNone:
      break;
    case RestOfRocks::kMoore:
      return RockFieldKind::kMoore;
    case RestOfRocks::kGolombek:
      return RockFieldKind::kGolombek;
  }
  return RockFieldKind::kNone;
}

double RockFieldParams::RocksPerM2() const {
  switch (RandomKind()) {
    case RockFieldKind::kNone:
    case RockFieldKind::kListed:
      return 0.0;
    case RockFieldKind::kMoore:
      return MooreNumberPerM2(k_per_m2, min_diameter_m) -
             MooreNumberPerM2(k_per_m2, max_diameter_m);
    case RockFieldKind::kGolombek:
      return GolombekNumberPerM2(cover, min_diameter_m) -
             GolombekNumberPerM2(cover, max_diameter_m);
    case RockFieldKind::kUniformCount:
      return static_cast<double>(count) / (count_area_length_m * count_area_width_m);
  }
  return 0.0;
}

double RockFieldParams::LawCover() const {
  const auto moore = [this](double diameter_m) {
    // The integral of pi D^2 / 4 over the law from that diameter on.
    return 0.25 * std::numbers::pi * kMooreExponent / (kMooreExponent - 2.0) * diameter_m *
           diameter_m * MooreNumberPerM2(k_per_m2, diameter_m);
  };
  const auto golombek = [this](double diameter_m) {
    return cover * math::Exp(-GolombekDecayPerM(cover) * diameter_m);
  };
  switch (RandomKind()) {
    case RockFieldKind::kMoore:
      return moore(min_diameter_m) - moore(max_diameter_m);
    case RockFieldKind::kGolombek:
      return golombek(min_diameter_m) - golombek(max_diameter_m);
    case RockFieldKind::kNone:
    case RockFieldKind::kListed:
    case RockFieldKind::kUniformCount:
      break;
  }
  return 0.0;
}

double RockFieldParams::ReferenceRocksPerM2() const {
  RockFieldParams reference = *this;
  reference.k_per_m2 = k_reference_per_m2;
  reference.cover = cover_reference;
  return reference.RocksPerM2();
}

}  // namespace rockyard::terrain
