// Rows of the comparison that are statistics of one column, by predictive resampling.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/numbers.h"
#include "statistics/compare_rows.h"
#include "statistics/drive_summary.h"
#include "statistics/kolmogorov.h"
#include "statistics/predictive.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

using core::kNaN;
// Statistics that are only shown beside the judged one take fewer replicates.
constexpr std::size_t kSideReduction = 5;
// Pools smaller than this many published sets give more than the nominal false alarms.
constexpr std::size_t kSetsInAGoodPool = 5;

double Smallest(std::span<const double> sorted) { return sorted.front(); }
double Largest(std::span<const double> sorted) { return sorted.back(); }
double Median(std::span<const double> sorted) { return Quantile(sorted, 0.5); }
double Mean(std::span<const double> sorted) { return MomentsOf(sorted).mean(); }

// Each row resamples with a stream of its own that does not move when rows are added (FNV-1a).
core::TrialKey KeyOf(std::string_view id, std::uint64_t seed) {
  std::uint32_t hash = 2166136261u;
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return {.seed = seed, .trial = hash};
}

std::vector<double> PoolOf(const PublishedValue& published, const ScenarioRun& run) {
  const auto column = ColumnIndex(run.schema, published.column);
  return column ? ColumnValues(run.records, *column) : std::vector<double>{};
}

std::string TooFew(const PublishedValue& published, const ScenarioRun& run) {
  return ColumnIndex(run.schema, published.column)
             ? "fewer than two simulated values of " + published.column
             : "the trials have no column " + published.column;
}

SampleStatistic StatisticOf(StatisticKind kind) {
  switch (kind) {
    case StatisticKind::kMinimum:
    case StatisticKind::kLowerBound:
      return Smallest;
    case StatisticKind::kMaximum:
      return Largest;
    default:
      return HalfSampleMode;
  }
}

void SetPrediction(ComparedValue& value, std::span<const double> ascending) {
  value.median = Quantile(ascending, 0.5);
  value.interval = {Quantile(ascending, 0.025), Quantile(ascending, 0.975)};
}

SideStatistic Beside(std::string name, std::vector<double> statistics, double published,
                     double rounding) {
  std::sort(statistics.begin(), statistics.end());
  return {std::move(name),
          Quantile(statistics, 0.5),
          {Quantile(statistics, 0.025), Quantile(statistics, 0.975)},
          std::isfinite(published) ? PredictivePValue(statistics, published, rounding) : kNaN};
}

std::vector<SideStatistic> OtherModes(const PublishedValue& published,
                                      const PredictiveSampler& sampler, std::size_t replicates,
                                      core::TrialKey key) {
  struct Definition {
    const char* name;
    SampleStatistic statistic;
  };
  const Definition definitions[] = {{"histogram mode", HistogramMode},
                                    {"kernel mode", KernelMode},
                                    {"median", Median},
                                    {"mean", Mean}};
  const auto n = static_cast<std::size_t>(published.sample_size);
  std::vector<SideStatistic> beside;
  for (const Definition& d : definitions) {
    beside.push_back(Beside(d.name, PredictiveStatistics(sampler, n, d.statistic, replicates, key),
                            published.value, published.rounding));
  }
  return beside;
}

// What scatters as much as the mode of some hundred values says neither that two laws agree nor
// that they differ.
std::string ModeRemark(std::span<const double> pool) {
  const Interval range = HalfSampleModeRange(pool);
  return fmt::format(
      "a mode is too unsteady to judge by; that of all {}: {:.3g} .. {:.3g} by subsampling, no "
      "coverage claimed",
      pool.size(), range.low, range.high);
}

// Returns the statistic of sets of which the published number of runs arrived, ascending; none
// where StatisticsByArrival has none.
std::vector<double> ByArrival(const PublishedValue& published, const ScenarioRun& run,
                              const SampleStatistic& statistic, const ComparisonOptions& options) {
  std::vector<double> drawn =
      StatisticsByArrival(published, run, statistic, options.replicates / kSideReduction,
                          KeyOf(published.id + ".arrived", options.seed));
  std::sort(drawn.begin(), drawn.end());
  return drawn;
}

// Share of sets whose p-values, ascending, call them consistent with an exponential law, `others`
// more that are consistent counted in.
double ConsistentShare(std::span<const double> p_values, double others) {
  const auto inconsistent =
      std::upper_bound(p_values.begin(), p_values.end(), kExponentialLevel) - p_values.begin();
  const double all = others + static_cast<double>(p_values.size());
  return (all - static_cast<double>(inconsistent)) / all;
}

// Power against the alternatives of kAlternativeShiftDeviations: the least of them counts.
std::function<double(double)> PowerOf(const PublishedValue& published, const Moments& pool,
                                      const std::vector<double>& drawn) {
  const double shift = kAlternativeShiftDeviations * pool.standard_deviation();
  const double limit = published.lower_limit;
  const double excess = pool.mean() - limit;  // infinite without a limit
  if (!std::isfinite(excess) || !(excess > 0.0)) {
    return [drawn, shift](double level) { return ShiftPower(drawn, shift, level); };
  }
  return [drawn, shift, limit, factor = 1.0 + shift / excess](double level) {
    return std::min(ShiftPower(drawn, shift, level), ScalePower(drawn, limit, factor, level));
  };
}

// Differences of a statistic between samples of the two published sizes.
std::vector<double> Offsets(const PredictiveSampler& first, std::size_t n_first,
                            const PredictiveSampler& second, std::size_t n_second,
                            const SampleStatistic& statistic, std::size_t replicates,
                            core::TrialKey key) {
  // Both samples are independent: streams of their own.
  const core::TrialKey other_key{.seed = key.seed, .trial = key.trial + 1};
  std::vector<double> offsets = PredictiveStatistics(first, n_first, statistic, replicates, key);
  const std::vector<double> other =
      PredictiveStatistics(second, n_second, statistic, replicates, other_key);
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] -= other[i];
  return offsets;
}

// Largest true distance to the goal at which a trial declared arrival.
double EffectiveTolerance(const ScenarioRun& run) {
  const auto column = ColumnIndex(run.schema, "true_goal_distance_m");
  double largest = kNaN;
  if (!column) return largest;
  for (const truth::Record& record : run.records) {
    if (!truth::DeclaredSuccess(record.outcome) || *column >= record.values.size()) continue;
    largest = std::fmax(largest, record.values[*column]);
  }
  return largest;
}

}  // namespace

Row CompareSampleStatistic(const PublishedValue& published, const ScenarioRun& run,
                           const ComparisonOptions& options) {
  const std::vector<double> pool = PoolOf(published, run);
  if (pool.size() < 2) return NotJudged(published, TooFew(published, run));
  const PredictiveSampler sampler(pool, published.lower_limit);
  const SampleStatistic statistic = StatisticOf(published.statistic);
  const core::TrialKey key = KeyOf(published.id, options.seed);
  const auto n = static_cast<std::size_t>(published.sample_size);
  std::vector<double> drawn = PredictiveStatistics(sampler, n, statistic, options.replicates, key);
  std::sort(drawn.begin(), drawn.end());
  Row row;
  ComparedValue& value = row.value;
  value.published = published;
  value.pool = static_cast<std::int64_t>(pool.size());
  value.pool_value = statistic(sampler.pool());
  SetPrediction(value, drawn);
  const bool mode = published.statistic == StatisticKind::kMode;
  if (mode) {
    value.remark = ModeRemark(pool);
    value.beside = OtherModes(published, sampler, options.replicates / kSideReduction, key);
  } else {
    value.p_value = PredictivePValue(drawn, published.value, published.rounding);
  }
  // The verdict stands; the remark says how far to trust it.
  if (!mode && pool.size() < kSetsInAGoodPool * n) {
    value.remark =
        fmt::format("only {} simulated trials: use {} or more", pool.size(), kSetsInAGoodPool * n);
  }
  std::vector<double> by_arrival = ByArrival(published, run, statistic, options);
  if (!by_arrival.empty()) {
    value.beside.push_back(Beside(ArrivalsName(published), std::move(by_arrival), published.value,
                                  published.rounding));
  }
  // Without power a row is in no family and has no verdict.
  if (!mode) row.power = PowerOf(published, MomentsOf(pool), drawn);
  return row;
}

// The statement "consistent with an exponential law" is an event; its p-value is the probability
// that a set of the published size, drawn from the simulation, would be called consistent as well.
// It can contradict the simulation but holds no number that could confirm it: without a rejection
// there is no outcome that would have been one, and the power is 0.
Row CompareExponentialTail(const PublishedValue& published, const ScenarioRun& run,
                           const ComparisonOptions& options) {
  const std::vector<double> pool = PoolOf(published, run);
  if (pool.size() < 2) return NotJudged(published, TooFew(published, run));
  const PredictiveSampler sampler(pool);
  const auto n = static_cast<std::size_t>(published.sample_size);
  // n values have n - 1 excesses over their minimum.
  const std::vector<double> null = ExponentialNullLaw(n - 1, options.replicates, options.seed);
  const SampleStatistic p_of = [&](std::span<const double> sample) {
    return BootstrapPValue(null, ExponentialStatistic(sample));
  };
  std::vector<double> p_values =
      PredictiveStatistics(sampler, n, p_of, options.replicates, KeyOf(published.id, options.seed));
  std::sort(p_values.begin(), p_values.end());
  Row row;
  ComparedValue& value = row.value;
  value.published = published;
  value.pool = static_cast<std::int64_t>(pool.size());
  SetPrediction(value, p_values);
  // The published set is counted as one more that looks exponential.
  value.p_value = ConsistentShare(p_values, 1.0);
  const double consistent = ConsistentShare(p_values, 0.0);
  const std::size_t side = options.replicates / kSideReduction;
  const TestResult all = ExponentialTailTest(pool, options.seed, 0, side);
  const TestResult beyond = ExponentialTailTest(pool, options.seed, pool.size() / 2, side);
  value.pool_value = all.p_value;
  value.remark = fmt::format(
      "{:.0f} % of simulated sets of {} are consistent at {:.2g}; all {} together: p {:.2g}, "
      "beyond their median: p {:.2g}",
      100.0 * consistent, n, kExponentialLevel, pool.size(), all.p_value, beyond.p_value);
  const std::vector<double> by_arrival = ByArrival(published, run, p_of, options);
  if (!by_arrival.empty()) {
    SideStatistic beside = Beside(ArrivalsName(published), by_arrival, kNaN, 0.0);
    beside.p_value = ConsistentShare(by_arrival, 1.0);
    value.beside.push_back(std::move(beside));
  }
  const double p_value = value.p_value;
  row.power = [p_value](double level) { return p_value <= level ? 1.0 - kExponentialLevel : 0.0; };
  return row;
}

// Geometry, not chance: a run that ends within the tolerance of the goal cannot have driven less
// than the straight distance minus the tolerance. Either it holds or it does not.
Row CompareLowerBound(const PublishedValue& published, const ScenarioRun& run,
                      const ComparisonOptions& options) {
  const auto column = ColumnIndex(run.schema, published.column);
  if (!column) return NotJudged(published, TooFew(published, run));
  std::vector<truth::Record> arrived;
  std::copy_if(run.records.begin(), run.records.end(), std::back_inserter(arrived),
               [](const truth::Record& r) { return truth::DeclaredSuccess(r.outcome); });
  const std::vector<double> pool = ColumnValues(arrived, *column);
  if (pool.size() < 2) return NotJudged(published, TooFew(published, run));
  const bool given = std::isfinite(run.goal_tolerance_m);
  const double tolerance = given ? run.goal_tolerance_m : EffectiveTolerance(run);
  if (!std::isfinite(tolerance)) return NotJudged(published, "the goal tolerance is not known");
  // Straight distance less tolerance.
  const double bound = published.value - tolerance;
  const PredictiveSampler sampler(pool, bound);
  std::vector<double> drawn =
      PredictiveStatistics(sampler, static_cast<std::size_t>(published.sample_size), Smallest,
                           options.replicates / kSideReduction, KeyOf(published.id, options.seed));
  std::sort(drawn.begin(), drawn.end());
  Row row;
  ComparedValue& value = row.value;
  value.published = published;
  value.pool = static_cast<std::int64_t>(pool.size());
  value.pool_value = sampler.pool().front();
  SetPrediction(value, drawn);
  constexpr double kRounding = 1e-6;
  value.verdict = value.pool_value >= bound - kRounding ? Verdict::kHolds : Verdict::kDiffers;
  value.remark = fmt::format("bound {:.3g} less tolerance {:.3g}{}: {:.3f}; smallest of {}: {:.3f}",
                             published.value, tolerance, given ? "" : " (from the trials)", bound,
                             pool.size(), value.pool_value);
  return row;
}

Row CompareMedianOffset(const PublishedValue& published, const ScenarioRun& run,
                        const ScenarioRun& other, const ComparisonOptions& options) {
  const std::vector<double> pool = PoolOf(published, run);
  const std::vector<double> other_pool = PoolOf(published, other);
  if (pool.size() < 2) return NotJudged(published, TooFew(published, run));
  if (other_pool.size() < 2) return NotJudged(published, TooFew(published, other));
  const PredictiveSampler first(pool);
  const PredictiveSampler second(other_pool);
  const auto n = static_cast<std::size_t>(published.sample_size);
  const auto m = static_cast<std::size_t>(published.other_sample_size);
  const core::TrialKey key = KeyOf(published.id, options.seed);
  const std::size_t replicates = options.replicates / kSideReduction;
  Row row;
  ComparedValue& value = row.value;
  value.published = published;
  value.pool = static_cast<std::int64_t>(pool.size());
  // A statement without a size: the prediction is shown and not judged.
  value.pool_value = Median(first.pool()) - Median(second.pool());
  std::vector<double> offsets = Offsets(first, n, second, m, Median, replicates, key);
  std::sort(offsets.begin(), offsets.end());
  SetPrediction(value, offsets);
  value.beside.push_back(Beside(
      "offset of minima", Offsets(first, n, second, m, Smallest, replicates, key), kNaN, 0.0));
  const TestResult curves = KolmogorovSmirnov(pool, other_pool);
  value.remark = fmt::format("no size published; simulated curves differ by D {:.3f}, p {:.2g}",
                             curves.statistic, curves.p_value);
  return row;
}

}  // namespace rockyard::statistics
