#include "statistics/attribution.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/check.h"
#include "core/numbers.h"
#include "statistics/clustered_rate.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {
namespace {

std::size_t Combinations(std::size_t functions) { return std::size_t{1} << functions; }

Combination Bit(std::size_t i) { return Combination{1} << i; }

double Factorial(std::size_t n) { return std::tgamma(static_cast<double>(n) + 1.0); }

// One trial's value of a contrast: the sum of the weights of the combinations in which it failed.
double ValueOf(const FactorialFailures& failures, const Contrast& contrast, std::size_t trial) {
  double value = 0.0;
  for (std::size_t c = 0; c < contrast.weights.size(); ++c) {
    if (failures.failed[c][trial] != 0) value += contrast.weights[c];
  }
  return value;
}

}  // namespace

Contrast ShapleyShare(std::size_t functions, std::size_t i) {
  EXPECT(i < functions && functions <= kMaxFunctions);
  Contrast contrast{std::vector<double>(Combinations(functions))};
  for (Combination set = 0; set < contrast.weights.size(); ++set) {
    if ((set & Bit(i)) != 0) continue;
    const auto size = static_cast<std::size_t>(std::popcount(set));
    // Shapley 1953: |S|! (k - |S| - 1)! / k!, of v(S + i) - v(S) = P(fail with S) - P(fail with S +
    // i).
    const double weight = Factorial(size) * Factorial(functions - size - 1) / Factorial(functions);
    contrast.weights[set] += weight;
    contrast.weights[set | Bit(i)] -= weight;
  }
  return contrast;
}

Contrast FactorialEffect(std::size_t functions, Combination set) {
  EXPECT(set > 0 && set < Combinations(functions) && functions <= kMaxFunctions);
  Contrast contrast{std::vector<double>(Combinations(functions))};
  const double scale = 2.0 / static_cast<double>(Combinations(functions));
  for (Combination c = 0; c < contrast.weights.size(); ++c) {
    // The product of signs over `set`: minus for each function of it that is as flown.
    const bool even = std::popcount(set & ~c) % 2 == 0;
    contrast.weights[c] = even ? scale : -scale;
  }
  return contrast;
}

Contrast Removed(std::size_t functions, Combination set) {
  EXPECT(set < Combinations(functions) && functions <= kMaxFunctions);
  Contrast contrast{std::vector<double>(Combinations(functions))};
  // P(fail as flown) less P(fail with `set` perfect).
  contrast.weights[0] += 1.0;
  contrast.weights[set] -= 1.0;
  return contrast;
}

Estimate Estimated(const FactorialFailures& failures, const Contrast& contrast, double confidence) {
  EXPECT(contrast.weights.size() == failures.failed.size());
  const std::size_t trials = failures.failed.front().size();
  if (trials == 0) {
    using core::kNaN;
    return {kNaN, {-1.0, 1.0}};
  }
  SignedValues values{.n = static_cast<double>(trials)};
  ClusteredValues clustered;
  for (std::size_t t = 0; t < trials; ++t) {
    const double value = ValueOf(failures, contrast, t);
    values.sum += value;
    values.squares += value * value;
    if (!failures.clusters.empty()) clustered.Add(failures.clusters[t], value);
  }
  // Dependent trials enter as the fewer independent ones that say as much.
  return {values.sum / values.n,
          AgrestiMinInterval(failures.clusters.empty() ? values : clustered.Effective(confidence),
                             confidence)};
}

Attribution Attribute(const FactorialFailures& failures, double confidence) {
  const std::size_t k = failures.functions.size();
  EXPECT(k >= 1 && k <= kMaxFunctions && failures.failed.size() == Combinations(k));
  const auto all = static_cast<Combination>(Combinations(k) - 1);
  Attribution result;
  result.functions = failures.functions;
  result.trials = failures.failed.front().size();
  EXPECT(failures.clusters.empty() || failures.clusters.size() == result.trials);
  for (const std::vector<std::uint8_t>& failed : failures.failed) {
    EXPECT(failed.size() == result.trials);
    result.failures.push_back(RateOfTrials(std::vector<double>(failed.begin(), failed.end()),
                                           failures.clusters, confidence));
  }
  const auto estimate = [&](const Contrast& contrast) {
    return Estimated(failures, contrast, confidence);
  };
  for (std::size_t i = 0; i < k; ++i) {
    // v(all) - v(all without i): what i removes as the last one.
    Contrast last = Removed(k, all);
    const Contrast others = Removed(k, all & ~Bit(i));
    for (std::size_t c = 0; c < last.weights.size(); ++c) last.weights[c] -= others.weights[c];
    result.shares.push_back({failures.functions[i], estimate(ShapleyShare(k, i)),
                             estimate(Removed(k, Bit(i))), estimate(last)});
    result.sum_of_firsts += result.shares.back().first.value;
  }
  result.removed = estimate(Removed(k, all));
  result.remainder = result.failures.back();
  for (Combination set = 1; set <= all; ++set) {
    result.effects.push_back({set, estimate(FactorialEffect(k, set))});
  }
  std::stable_sort(result.effects.begin(), result.effects.end(),
                   [](const EffectOfSet& a, const EffectOfSet& b) {
                     return std::popcount(a.set) < std::popcount(b.set);
                   });
  return result;
}

std::string NameOf(Combination set, std::span<const std::string> functions,
                   std::string_view separator) {
  std::string name;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    if ((set & Bit(i)) == 0) continue;
    if (!name.empty()) name += separator;
    name += functions[i];
  }
  return name.empty() ? "as flown" : name;
}

}  // namespace rockyard::statistics
