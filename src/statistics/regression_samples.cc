#include "statistics/regression_samples.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <iterator>

#include "core/numbers.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

using core::kNaN;

std::vector<double> Finite(std::span<const double> values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double x) { return std::isfinite(x); });
  return finite;
}

// Tests a rate for a change (exact) and for equivalence within the margin (score).
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

// Returns the p-value of TOST by Student's law; where few pairs differ the standard error says too
// little, and their number decides.
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

// Smallest shift up to `most` with this power; NaN where none has it.
template <typename PowerOf>
double SmallestShift(double most, double power, const PowerOf& power_of) {
  constexpr double kPrecision = 1e-4;
  // Power grows with the shift: bisection.
  if (most <= 0.0 || power_of(most) < power) return kNaN;
  double low = 0.0;
  double high = most;
  while (high - low > kPrecision) {
    const double middle = 0.5 * (low + high);
    (power_of(middle) >= power ? high : low) = middle;
  }
  return high;
}

// Returns the share of pairs in which one given side alone succeeded, taken as equal for both
// sides.
double Background(const RegressionSamples& samples) {
  const PairedCounts counts = CountPairs(samples);
  return 0.5 * static_cast<double>(counts.only_first + counts.only_second) /
         static_cast<double>(counts.pairs());
}

// The smallest shift of paired rates that McNemar's test would have seen.
double SeenPairShift(const RegressionSamples& samples, double level, double power) {
  const double background = Background(samples);
  // The shift comes on top of the discordance that was seen, half of it either way.
  return SmallestShift(1.0 - 2.0 * background, power, [&](double shift) {
    return McNemarPower(samples.count(), {background, background + shift}, level);
  });
}

// The baseline's rate, moved the way that has more room, which is the harder one to see.
RatePair Moved(const RegressionSamples& samples, double shift) {
  const auto rate =
      static_cast<double>(CountGroups(samples).success_1) / static_cast<double>(samples.count());
  return {rate, std::clamp(rate > 0.5 ? rate - shift : rate + shift, 0.0, 1.0)};
}

// The smallest shift of a mean that Student's test would have seen, with the scatter at hand.
double SeenMeanShift(const MeanDifference& means, double level, double power) {
  if (!means.known()) return kNaN;
  const boost::math::students_t law(means.degrees_of_freedom);
  // A true difference of (t_(1 - level/2) + t_power) standard errors is rejected with that power.
  return (boost::math::quantile(law, 1.0 - 0.5 * level) + boost::math::quantile(law, power)) *
         means.standard_error;
}

std::int64_t TrialsForRate(const RegressionSamples& samples, const RegressionRow& row) {
  if (row.margin >= 1.0) return 1;
  if (!row.paired)
    return TrialsForFisherFormula(Moved(samples, row.margin), row.level, kNeededPower);
  const double background = std::min(Background(samples), 0.5 * (1.0 - row.margin));
  return TrialsForMcNemar({background, background + row.margin}, row.level, kNeededPower);
}

// Returns the trials with which a shift of the margin would be seen; at least as many as Welch's
// test needs, or as pairs that hardly differ need to show equivalence.
std::int64_t TrialsForMean(const RegressionSamples& samples, const RegressionRow& row,
                           double equivalence_alpha) {
  const double ratio =
      SeenMeanShift(MeansOf(samples, row.paired), row.level, kNeededPower) / row.margin;
  if (!std::isfinite(ratio)) return 0;
  // The standard error falls with the root of n: n (seen / margin)^2 trials see the margin.
  double needed = static_cast<double>(samples.count()) * ratio * ratio;
  const Spread spread = SpreadOf(samples);
  if (!row.paired) {
    needed = std::max(needed, static_cast<double>(kMinValues));
  } else if (spread.differing < kMinDiffering && row.margin < spread.range) {
    // No differing pair among n: (1 - margin/range)^n <= alpha.
    needed = std::max(needed, std::log(equivalence_alpha) / std::log1p(-row.margin / spread.range));
  }
  return std::llround(std::min(std::ceil(needed), static_cast<double>(kMaxTrials)));
}

// Standard deviation between trials, of both sides: root of the mean of their variances.
double PooledDeviation(const RegressionSamples& samples) {
  return std::sqrt(0.5 *
                   (MomentsOf(samples.baseline).variance() + MomentsOf(samples.run).variance()));
}

void FillMean(const RegressionSamples& samples, double equivalence_alpha, RegressionRow& row) {
  row.trials_for_margin = TrialsForMean(samples, row, equivalence_alpha);
  if (!row.paired && samples.count() < kMinValues) return;
  row.to_see = std::max(row.margin, kShiftThatMatters * PooledDeviation(samples));
  const Spread spread = SpreadOf(samples);
  if (row.paired && spread.differing < kMinDiffering) {
    // Student's law says nothing of so few differences.
    row.sees_enough = SparseEquivalencePValue(samples.count(), spread.differing, row.to_see,
                                              spread.range) <= equivalence_alpha;
    return;
  }
  const MeanDifference means = MeansOf(samples, row.paired);
  // Without scatter the law of the difference is unknown: nothing can be said to be seen.
  if (means.standard_error == 0.0) return;
  row.seen_80 = SeenMeanShift(means, row.level, kNeededPower);
  row.seen_90 = SeenMeanShift(means, row.level, 0.9);
  row.sees_enough = row.seen_80 <= row.to_see;
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
  if (row.metric.kind == MetricKind::kRate) {
    TestRate(samples, row);
  } else {
    TestMean(samples, row);
  }
}

// Returns the smallest shift of the rates of two groups that Fisher's test would have seen; large
// groups by its normal formula.
double RegressionPower::SeenGroupShift(const RegressionSamples& samples, double level,
                                       double power) {
  if (samples.count() > kMaxExactFisher) {
    return SmallestShift(1.0, power, [&](double shift) {
      const std::int64_t needed = TrialsForFisherFormula(Moved(samples, shift), level, power);
      return needed <= samples.count() ? 1.0 : 0.0;
    });
  }
  FisherTest& test =
      tests_.try_emplace({samples.count(), level}, samples.count(), level).first->second;
  const double rate = Moved(samples, 0.0).first;
  return SmallestShift(std::max(rate, 1.0 - rate), power,
                       [&](double shift) { return test.Power(Moved(samples, shift)); });
}

double RegressionPower::SeenRateShift(const RegressionSamples& samples, const RegressionRow& row,
                                      double power) {
  return row.paired ? SeenPairShift(samples, row.level, power)
                    : SeenGroupShift(samples, row.level, power);
}

void RegressionPower::Fill(const RegressionSamples& samples, double equivalence_alpha,
                           RegressionRow& row) {
  row.seen_80 = row.seen_90 = kNaN;
  if (samples.empty()) return;
  row.metric.kind == MetricKind::kRate ? FillRate(samples, row)
                                       : FillMean(samples, equivalence_alpha, row);
}

void RegressionPower::FillRate(const RegressionSamples& samples, RegressionRow& row) {
  row.to_see = row.margin;
  row.seen_80 = SeenRateShift(samples, row, kNeededPower);
  row.seen_90 = SeenRateShift(samples, row, 0.9);
  row.sees_enough = row.seen_80 <= row.to_see;
  row.trials_for_margin = TrialsForRate(samples, row);
}

}  // namespace rockyard::statistics
