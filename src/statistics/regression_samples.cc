#include "statistics/regression_samples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace rockyard::statistics {
namespace {

std::vector<double> Finite(std::span<const double> values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double x) { return std::isfinite(x); });
  return finite;
}

// Each pair of tests: a change (exact), and equivalence within the margin (score).
void TestRate(const RegressionSamples& samples, RegressionRow& row) {
  if (row.paired) {
    const PairedCounts counts = CountPairs(samples);
    row.p_value = McNemarExactPValue(counts.only_first, counts.only_second);
    row.interval = DifferenceInterval(counts, 0.95);
    row.equivalence_p_value = EquivalencePValue(counts, row.margin);
  } else {
    const ContingencyTable table = CountGroups(samples);
    row.p_value = FisherExactPValue(table);
    row.interval = DifferenceInterval(table, 0.95);
    row.equivalence_p_value = EquivalencePValue(table, row.margin);
  }
}

// TOST by Student's law; where few pairs differ the standard error says too little, and their
// number decides.
double MeanEquivalence(const RegressionSamples& samples, const MeanDifference& means,
                       const RegressionRow& row) {
  if (row.paired) {
    const Spread spread = SpreadOf(samples);
    if (spread.differing < kMinDiffering) {
      return SparseEquivalencePValue(samples.count(), spread.differing, row.margin, spread.range);
    }
  }
  const double p_value = EquivalencePValue(means, row.margin);
  if (means.standard_error > 0.0) return p_value;
  // Nothing scatters: agreement by accident is what is left to rule out.
  return std::max(p_value, SparseEquivalencePValue(samples.count(), 0, row.margin, 0.0));
}

void TestMean(const RegressionSamples& samples, RegressionRow& row) {
  const MeanDifference means = MeansOf(samples, row.paired);
  row.interval = DifferenceInterval(means, 0.95);
  // Too few values for Welch's test: the row stays inconclusive.
  if (!row.paired && samples.count() < kMinValues) return;
  row.p_value = ChangePValue(means);
  row.equivalence_p_value = MeanEquivalence(samples, means, row);
}

}  // namespace

RegressionSamples TakeSamples(bool paired, std::span<const double> baseline,
                              std::span<const double> run) {
  const std::size_t trials = std::min(baseline.size(), run.size());
  RegressionSamples samples;
  if (!paired) {
    // As many values from both sides: Welch's test keeps its level for skewed values only so.
    samples = {Finite(baseline.first(trials)), Finite(run.first(trials))};
    const std::size_t count = std::min(samples.baseline.size(), samples.run.size());
    samples.baseline.resize(count);
    samples.run.resize(count);
    return samples;
  }
  for (std::size_t i = 0; i < trials; ++i) {
    if (!std::isfinite(baseline[i]) || !std::isfinite(run[i])) continue;
    samples.baseline.push_back(baseline[i]);
    samples.run.push_back(run[i]);
  }
  return samples;
}

MeanDifference MeansOf(const RegressionSamples& samples, bool paired) {
  if (!paired) return WelchMeans(samples.baseline, samples.run);
  std::vector<double> differences(samples.run.size());
  std::transform(samples.run.begin(), samples.run.end(), samples.baseline.begin(),
                 differences.begin(), std::minus<>());
  return PairedMeans(differences);
}

PairedCounts CountPairs(const RegressionSamples& samples) {
  PairedCounts counts;
  for (std::size_t i = 0; i < samples.run.size(); ++i) {
    counts.Add(samples.baseline[i] > 0.0, samples.run[i] > 0.0);
  }
  return counts;
}

ContingencyTable CountGroups(const RegressionSamples& samples) {
  const auto successes = [](const std::vector<double>& values) {
    return static_cast<std::int64_t>(
        std::count_if(values.begin(), values.end(), [](double x) { return x > 0.0; }));
  };
  const std::int64_t first = successes(samples.baseline);
  const std::int64_t second = successes(samples.run);
  return {first, samples.count() - first, second, samples.count() - second};
}

Spread SpreadOf(const RegressionSamples& samples) {
  Spread spread;
  if (samples.empty()) return spread;
  for (std::size_t i = 0; i < samples.run.size(); ++i) {
    if (samples.baseline[i] != samples.run[i]) ++spread.differing;
  }
  const auto [low_1, high_1] =
      std::minmax_element(samples.baseline.begin(), samples.baseline.end());
  const auto [low_2, high_2] = std::minmax_element(samples.run.begin(), samples.run.end());
  spread.range = std::max(*high_1, *high_2) - std::min(*low_1, *low_2);
  return spread;
}

void TestSamples(const RegressionSamples& samples, RegressionRow& row) {
  if (samples.empty()) return;
  if (row.metric->kind == MetricKind::kRate) {
    TestRate(samples, row);
  } else {
    TestMean(samples, row);
  }
}

}  // namespace rockyard::statistics
