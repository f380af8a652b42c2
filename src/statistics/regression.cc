#include "statistics/regression.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/check.h"
#include "statistics/equivalence.h"
#include "statistics/moments.h"
#include "statistics/multiple_testing.h"
#include "statistics/quantiles.h"
#include "statistics/sample_size.h"

namespace rockyard::statistics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// What both sides say of one metric: trial by trial where they are paired.
struct Samples {
  std::vector<double> baseline;
  std::vector<double> run;
};

Samples TakeSamples(bool paired, std::span<const double> baseline, std::span<const double> run) {
  Samples samples;
  if (!paired) {
    std::copy_if(baseline.begin(), baseline.end(), std::back_inserter(samples.baseline),
                 [](double x) { return std::isfinite(x); });
    std::copy_if(run.begin(), run.end(), std::back_inserter(samples.run),
                 [](double x) { return std::isfinite(x); });
    return samples;
  }
  const std::size_t common = std::min(baseline.size(), run.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (!std::isfinite(baseline[i]) || !std::isfinite(run[i])) continue;
    samples.baseline.push_back(baseline[i]);
    samples.run.push_back(run[i]);
  }
  return samples;
}

MeanDifference MeansOf(const Samples& samples, bool paired) {
  if (!paired) return WelchMeans(samples.baseline, samples.run);
  std::vector<double> differences(samples.run.size());
  std::transform(samples.run.begin(), samples.run.end(), samples.baseline.begin(),
                 differences.begin(), std::minus<>());
  return PairedMeans(differences);
}

PairedCounts CountPairs(const Samples& samples) {
  PairedCounts counts;
  for (std::size_t i = 0; i < samples.run.size(); ++i) {
    counts.Add(samples.baseline[i] > 0.0, samples.run[i] > 0.0);
  }
  return counts;
}

ContingencyTable CountGroups(const Samples& samples) {
  const auto successes = [](const std::vector<double>& values) {
    return static_cast<std::int64_t>(std::count(values.begin(), values.end(), 1.0));
  };
  const std::int64_t first = successes(samples.baseline);
  const std::int64_t second = successes(samples.run);
  return {first, static_cast<std::int64_t>(samples.baseline.size()) - first, second,
          static_cast<std::int64_t>(samples.run.size()) - second};
}

template <typename Difference>
void Test(const Difference& difference, RegressionRow& row) {
  row.interval = DifferenceInterval(difference, 0.95);
  row.equivalence_p_value = EquivalencePValue(difference, row.margin);
}

void TestRate(const Samples& samples, RegressionRow& row) {
  if (row.paired) {
    const PairedCounts counts = CountPairs(samples);
    row.p_value = McNemarExactPValue(counts.only_first, counts.only_second);
    Test(counts, row);
  } else {
    const ContingencyTable table = CountGroups(samples);
    row.p_value = FisherExactPValue(table);
    Test(table, row);
  }
}

double NormalQuantile(double p) { return boost::math::quantile(boost::math::normal(), p); }

// Paired: so many discordant pairs more one way than the other; and where hardly any pair is
// discordant, as many as the exact test needs at least.
double SeenRateShift(const Samples& samples, const RegressionRow& row, double power) {
  const double reach = NormalQuantile(1.0 - 0.5 * row.level) + NormalQuantile(power);
  const auto n_1 = static_cast<double>(samples.baseline.size());
  const auto n_2 = static_cast<double>(samples.run.size());
  if (row.paired) {
    const PairedCounts counts = CountPairs(samples);
    const auto discordant = static_cast<double>(counts.only_first + counts.only_second);
    const double least = std::ceil(1.0 - std::log2(row.level));
    return std::min(1.0, std::max(reach * std::sqrt(discordant), least) / n_1);
  }
  const ContingencyTable table = CountGroups(samples);
  const double rate =
      (static_cast<double>(table.success_1 + table.success_2) + 1.0) / (n_1 + n_2 + 2.0);
  return std::min(1.0, reach * std::sqrt(rate * (1.0 - rate) * (1.0 / n_1 + 1.0 / n_2)));
}

double SeenMeanShift(const MeanDifference& means, double level, double power) {
  if (!means.known()) return kNaN;
  const boost::math::students_t law(means.degrees_of_freedom);
  return (boost::math::quantile(law, 1.0 - 0.5 * level) + boost::math::quantile(law, power)) *
         means.standard_error;
}

double SeenShift(const Samples& samples, const RegressionRow& row, double power) {
  if (samples.baseline.empty() || samples.run.empty()) return kNaN;
  return row.metric->kind == MetricKind::kRate
             ? SeenRateShift(samples, row, power)
             : SeenMeanShift(MeansOf(samples, row.paired), row.level, power);
}

RegressionRow MakeRow(const RegressionCell& cell, const BaselineMetric& baseline,
                      const Metric& metric, const Samples& samples) {
  RegressionRow row{.cell = cell.name, .metric = &metric, .paired = cell.paired};
  row.margin = baseline.margin;
  row.baseline_count = static_cast<std::int64_t>(samples.baseline.size());
  row.run_count = static_cast<std::int64_t>(samples.run.size());
  row.baseline_mean = MomentsOf(samples.baseline).mean();
  row.run_mean = MomentsOf(samples.run).mean();
  row.difference = row.run_mean - row.baseline_mean;
  if (metric.kind == MetricKind::kRate) {
    TestRate(samples, row);
  } else {
    const MeanDifference means = MeansOf(samples, cell.paired);
    row.p_value = ChangePValue(means);
    Test(means, row);
  }
  return row;
}

void Judge(const RegressionOptions& options, RegressionRow& row) {
  if (row.holm_p_value <= options.alpha) {
    row.verdict = RegressionVerdict::kChanged;
  } else if (row.equivalence_p_value <= options.equivalence_alpha) {
    row.verdict = RegressionVerdict::kEquivalent;
  }
}

void AddPower(const Samples& samples, RegressionRow& row) {
  row.seen_80 = SeenShift(samples, row, 0.8);
  row.seen_90 = SeenShift(samples, row, 0.9);
  if (!std::isfinite(row.seen_80)) return;
  const double ratio = row.seen_80 / row.margin;
  const double needed =
      static_cast<double>(std::min(row.baseline_count, row.run_count)) * ratio * ratio;
  row.trials_for_margin =
      std::llround(std::min(std::ceil(needed), static_cast<double>(kMostTrials)));
}

}  // namespace

std::int64_t RegressionResult::Count(RegressionVerdict verdict) const {
  return std::count_if(rows.begin(), rows.end(),
                       [&](const RegressionRow& row) { return row.verdict == verdict; });
}

RegressionResult CheckRegression(std::span<const RegressionCell> cells,
                                 const RegressionOptions& options) {
  RegressionResult result{.options = options, .rows = {}};
  std::vector<Samples> samples;
  for (const RegressionCell& cell : cells) {
    EXPECT(cell.run.size() == cell.baseline.size());
    for (std::size_t i = 0; i < cell.baseline.size(); ++i) {
      const Metric* metric = FindMetric(cell.baseline[i].name);
      if (metric == nullptr) continue;
      Samples both = TakeSamples(cell.paired, cell.baseline[i].values, cell.run[i]);
      if (both.baseline.empty() && both.run.empty()) continue;
      result.rows.push_back(MakeRow(cell, cell.baseline[i], *metric, both));
      samples.push_back(std::move(both));
    }
  }
  std::vector<double> p_values;
  for (const RegressionRow& row : result.rows) p_values.push_back(row.p_value);
  const std::vector<double> adjusted = HolmAdjust(p_values);
  const std::vector<double> levels = HolmLevels(p_values, options.alpha);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    result.rows[i].holm_p_value = adjusted[i];
    result.rows[i].level = levels[i];
    AddPower(samples[i], result.rows[i]);
    Judge(options, result.rows[i]);
  }
  return result;
}

int ExitCode(const RegressionResult& result) {
  if (result.Count(RegressionVerdict::kChanged) > 0) return 1;
  const bool unsure = result.rows.empty() || result.Count(RegressionVerdict::kInconclusive) > 0;
  return unsure ? 4 : 0;
}

double RoundForBaseline(double value) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr) : kNaN;
}

}  // namespace rockyard::statistics
