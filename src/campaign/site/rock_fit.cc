#include "campaign/site/rock_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "campaign/site/rock_fit_laws.h"
#include "core/error.h"
#include "core/random.h"

namespace rockyard::campaign {
namespace {

constexpr std::int64_t kFewestRocks = 5;
// Of each of two tests of a law, so that both together refute a true one in 5 %.
constexpr double kRefuted = 0.025;

// How many of the catalogues that one law makes are as far off, in either way, as the one seen.
struct Bootstrap {
  int as_far_in_classes = 0;
  int as_much_against = 0;
};

Bootstrap Simulated(const WindowLaw& law, const WindowLaw& other, const RockCounts& seen,
                    std::uint64_t seed, std::uint32_t substream, int samples) {
  const FittedLaw fitted = law.Fit(seen);
  const double far = law.Deviance(fitted.k, seen);
  const double against = other.Fit(seen).log_likelihood - fitted.log_likelihood;
  Bootstrap result;
  for (int i = 0; i < samples; ++i) {
    const RockCounts counts = law.Simulate(
        fitted.k, {{seed, static_cast<std::uint32_t>(i)}, core::Purpose::kBootstrap, substream});
    const FittedLaw again = law.Fit(counts);
    result.as_far_in_classes += law.Deviance(again.k, counts) >= far ? 1 : 0;
    result.as_much_against +=
        other.Fit(counts).log_likelihood - again.log_likelihood >= against ? 1 : 0;
  }
  return result;
}

LawFit FitLaw(const WindowLaw& law, const WindowLaw& other, const RockCounts& seen,
              std::uint64_t seed, std::uint32_t substream, int samples) {
  const FittedLaw fitted = law.Fit(seen);
  const Bootstrap bootstrap = Simulated(law, other, seen, seed, substream, samples);
  const auto p = [samples](int as_far) { return (1.0 + as_far) / (1.0 + samples); };
  LawFit fit;
  fit.k = fitted.k;
  fit.interval = law.IntervalOf(fitted, seen);
  fit.log_likelihood = fitted.log_likelihood;
  fit.fit_p = p(bootstrap.as_far_in_classes);
  fit.against_p = p(bootstrap.as_much_against);
  return fit;
}

bool IsRefuted(const LawFit& fit) { return std::min(fit.fit_p, fit.against_p) < kRefuted; }

// The p-value of both tests of a law together.
double BothP(const LawFit& fit) { return std::min(1.0, 2.0 * std::min(fit.fit_p, fit.against_p)); }

std::string Sentence(const RockFit& fit) {
  const std::string ps = fmt::format("p {:.3g} and {:.3g}", BothP(fit.moore), BothP(fit.golombek));
  switch (fit.verdict) {
    case LawVerdict::kBoth:
      return fmt::format(
          "Moore's law and Golombek's both fit ({}): these {} rocks cannot tell them apart; a "
          "larger "
          "area or a wider range of sizes may.",
          ps, fit.rocks);
    case LawVerdict::kMoore:
      return fmt::format("Moore's law fits, Golombek's does not ({}).", ps);
    case LawVerdict::kGolombek:
      return fmt::format("Golombek's law fits, Moore's does not ({}).", ps);
    case LawVerdict::kNeither:
      break;
  }
  return fmt::format(
      "Neither Moore's law nor Golombek's fits ({}): look at the classes; a catalogue that is not "
      "complete lacks its smallest rocks.",
      ps);
}

void RequireWindow(const RockWindow& window) {
  if (window.area_m2 > 0.0 && std::isfinite(window.area_m2) && window.min_m > 0.0 &&
      window.max_m > window.min_m && std::isfinite(window.max_m)) {
    return;
  }
  throw core::UserError("rocks", "need an area above 0 and diameters from above 0 to a larger one",
                        "give the area of the catalogue and the diameters between which it is "
                        "complete");
}

}  // namespace

RockFit FitRockLaws(std::span<const double> diameters_m, const RockWindow& window,
                    std::uint64_t seed, int samples) {
  RequireWindow(window);
  const ClassedWindow classes(window);
  RockCounts seen(classes.classes());
  for (const double diameter_m : diameters_m) {
    if (diameter_m >= window.min_m && diameter_m < window.max_m) classes.Count(diameter_m, seen);
  }
  if (seen.rocks < kFewestRocks) {
    throw core::UserError(
        "rocks",
        fmt::format("{} of {} have diameters from {:g} to below {:g} m, too few to fit a law to",
                    seen.rocks, diameters_m.size(), window.min_m, window.max_m),
        fmt::format("give at least {} rocks, or a wider range in which the catalogue is complete",
                    kFewestRocks));
  }
  const MooreWindowLaw moore(classes);
  const GolombekWindowLaw golombek(classes);
  RockFit fit;
  fit.window = window;
  fit.rocks = seen.rocks;
  fit.left_out = static_cast<std::int64_t>(diameters_m.size()) - seen.rocks;
  fit.catalogues = samples;
  fit.moore = FitLaw(moore, golombek, seen, seed, 0, samples);
  fit.golombek = FitLaw(golombek, moore, seen, seed, 1, samples);
  constexpr double kNear = 1e-6;  // of a bound, as a share
  fit.golombek.at_bound = fit.golombek.k < GolombekWindowLaw::kLeastCover * (1.0 + kNear) ||
                          fit.golombek.k > GolombekWindowLaw::kMostCover * (1.0 - kNear);
  const auto cover = [&](const WindowLaw& law, double k) {
    return 0.25 * std::numbers::pi * law.Expected(k) / window.area_m2 *
           law.Sizes(k)->MeanPower(2.0);
  };
  fit.moore.expected_cover = cover(moore, fit.moore.k);
  fit.golombek.expected_cover = cover(golombek, fit.golombek.k);
  for (std::size_t i = 0; i < classes.classes(); ++i) {
    const double from_m = classes.bounds_m()[i];
    const double to_m = classes.bounds_m()[i + 1];
    fit.classes.push_back({from_m, to_m, seen.by_class[i],
                           statistics::PoissonInterval(seen.by_class[i]),
                           moore.Expected(fit.moore.k, from_m, to_m),
                           golombek.Expected(fit.golombek.k, from_m, to_m)});
  }
  const bool no_moore = IsRefuted(fit.moore);
  const bool no_golombek = IsRefuted(fit.golombek);
  fit.verdict = no_moore && no_golombek ? LawVerdict::kNeither
                : no_golombek           ? LawVerdict::kMoore
                : no_moore              ? LawVerdict::kGolombek
                                        : LawVerdict::kBoth;
  fit.sentence = Sentence(fit);
  return fit;
}

}  // namespace rockyard::campaign
