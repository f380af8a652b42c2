#include "campaign/site/rock_fit_laws.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "math/functions.h"
#include "terrain/rock_params.h"

namespace rockyard::campaign {
namespace {

using terrain::kMooreExponent;

// Half of the 95 % quantile of chi squared with one degree of freedom.
constexpr double kLogLikelihoodDrop = 1.9207294;

// Returns where a function with one peak is greatest, by golden section.
double LogCoverOfGreatest(const std::function<double(double)>& value) {
  constexpr double kWidest = 1e-9;
  const double ratio = 1.0 / std::numbers::phi;
  double low = math::Log(GolombekWindowLaw::kLeastCover);
  double high = math::Log(GolombekWindowLaw::kMostCover);
  double left = high - ratio * (high - low);
  double right = low + ratio * (high - low);
  double at_left = value(left);
  double at_right = value(right);
  while (high - low > kWidest) {
    if (at_left < at_right) {
      low = left;
      left = right;
      at_left = at_right;
      right = low + ratio * (high - low);
      at_right = value(right);
    } else {
      high = right;
      right = left;
      at_right = at_left;
      left = high - ratio * (high - low);
      at_left = value(left);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

ClassedWindow::ClassedWindow(const RockWindow& window) : window_(window) {
  constexpr double kNarrowest = 1.2;  // of the last class, largest over smallest diameter
  bounds_m_.push_back(window.min_m);
  for (double from_m = std::numbers::sqrt2 * window.min_m; from_m * kNarrowest < window.max_m;
       from_m *= std::numbers::sqrt2) {
    bounds_m_.push_back(from_m);
  }
  bounds_m_.push_back(window.max_m);
}

void ClassedWindow::Count(double diameter_m, RockCounts& counts) const {
  ++counts.rocks;
  counts.sum_m += diameter_m;
  counts.sum_of_logs += math::Log(diameter_m);
  const auto above = std::upper_bound(bounds_m_.begin(), bounds_m_.end() - 1, diameter_m);
  ++counts.by_class[static_cast<std::size_t>(above - bounds_m_.begin()) - 1];
}

double WindowLaw::Expected(double k, double from_m, double to_m) const {
  return window_.limits().area_m2 * (NumberPerM2(k, from_m) - NumberPerM2(k, to_m));
}

double WindowLaw::Expected(double k) const {
  return Expected(k, window_.limits().min_m, window_.limits().max_m);
}

RockCounts WindowLaw::Simulate(double k, core::RandomStream stream) const {
  RockCounts counts(window_.classes());
  const std::unique_ptr<terrain::RockSizeLaw> sizes = Sizes(k);
  const std::int64_t rocks = core::SamplePoisson(stream, Expected(k));
  for (std::int64_t i = 0; i < rocks; ++i) window_.Count(sizes->Diameter(stream.Uniform()), counts);
  return counts;
}

double WindowLaw::Deviance(double k, const RockCounts& counts) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < window_.classes(); ++i) {
    const double expected = Expected(k, window_.bounds_m()[i], window_.bounds_m()[i + 1]);
    const auto observed = static_cast<double>(counts.by_class[i]);
    if (observed > 0.0) sum += observed * math::Log(observed / expected);
    sum += expected - observed;
  }
  return 2.0 * sum;
}

double MooreWindowLaw::NumberPerM2(double k, double diameter_m) const {
  return terrain::MooreNumberPerM2(k, diameter_m);
}

std::unique_ptr<terrain::RockSizeLaw> MooreWindowLaw::Sizes(double /*k*/) const {
  return std::make_unique<terrain::MooreSizeLaw>(window().limits().min_m, window().limits().max_m);
}

FittedLaw MooreWindowLaw::Fit(const RockCounts& counts) const {
  if (counts.rocks == 0) return {};
  // Of n rocks the most likely k expects n. Its density is k m D^(-m - 1).
  const auto n = static_cast<double>(counts.rocks);
  const double k = n / Expected(1.0);
  return {k, n * math::Log(k * kMooreExponent) - (kMooreExponent + 1.0) * counts.sum_of_logs - n};
}

statistics::Interval MooreWindowLaw::IntervalOf(const FittedLaw& /*fitted*/,
                                                const RockCounts& counts) const {
  const statistics::Interval mean = statistics::PoissonInterval(counts.rocks);
  return {mean.low / Expected(1.0), mean.high / Expected(1.0)};
}

double GolombekWindowLaw::NumberPerM2(double k, double diameter_m) const {
  return terrain::GolombekNumberPerM2(k, diameter_m);
}

std::unique_ptr<terrain::RockSizeLaw> GolombekWindowLaw::Sizes(double k) const {
  return std::make_unique<terrain::GolombekSizeLaw>(k, window().limits().min_m,
                                                    window().limits().max_m);
}

double GolombekWindowLaw::LogLikelihood(double k, const RockCounts& counts) const {
  const double q = terrain::GolombekDecayPerM(k);
  return static_cast<double>(counts.rocks) * math::Log(4.0 / std::numbers::pi * k * q) -
         q * counts.sum_m - 2.0 * counts.sum_of_logs - Expected(k);
}

FittedLaw GolombekWindowLaw::Fit(const RockCounts& counts) const {
  const double k = math::Exp(LogCoverOfGreatest(
      [&](double log_cover) { return LogLikelihood(math::Exp(log_cover), counts); }));
  return {k, LogLikelihood(k, counts)};
}

statistics::Interval GolombekWindowLaw::IntervalOf(const FittedLaw& fitted,
                                                   const RockCounts& counts) const {
  return {EndOfLikely(fitted, kLeastCover, counts), EndOfLikely(fitted, kMostCover, counts)};
}

double GolombekWindowLaw::EndOfLikely(const FittedLaw& fitted, double bound,
                                      const RockCounts& counts) const {
  const auto likely = [&](double cover) {
    return LogLikelihood(cover, counts) > fitted.log_likelihood - kLogLikelihoodDrop;
  };
  if (likely(bound)) return bound;
  double inside = fitted.k;
  double outside = bound;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(inside * outside);
    (likely(middle) ? inside : outside) = middle;
  }
  return outside;
}

}  // namespace rockyard::campaign
