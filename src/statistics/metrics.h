// The numbers that people ask of drives, each defined here (the table: metric_table.cc) and nowhere
// else, but for what navigators count for themselves, which the columns of their records define.
// Summaries, sweeps, comparisons of runs, baselines and `rockyard metrics` take them from
// here. Baselines hold the names, and values as MetricValues gives them: a check leaves out a name
// that it does not know (its exit code is then 4 at best), and takes another definition for a
// change of the build.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "statistics/proportions.h"
#include "statistics/sample_statistics.h"
#include "truth/record.h"

namespace rockyard::statistics {

enum class MetricKind {
  kRate,  // of each trial 0 or 1
  kMean,  // of each trial a number
};

enum class MetricTrials {
  kAll,      // every trial without a simulator fault
  kArrived,  // of these, declared successes (goal_reached and false_goal)
};

// How the value of a trial is made.
enum class MetricSource {
  kOutcome,   // 1 if the outcome is in `outcomes`
  kCause,     // 1 if it ended for one of `causes`
  kColumn,    // the first column
  kQuotient,  // the first column over the second
  kPositive,  // 1 if the first column is above 0
};

struct Metric {
  std::string name;
  std::string unit;
  std::string definition;  // one sentence
  MetricKind kind = MetricKind::kMean;
  MetricTrials trials = MetricTrials::kAll;
  MetricSource source = MetricSource::kColumn;
  std::array<std::string, 2> columns{};  // of the record
  std::uint32_t outcomes = 0;            // one bit for each, kOutcome only
  std::uint32_t causes = 0;              // one bit for each, kCause only
  // Differences below max(margin, relative_margin |mean|) do not matter, unless a user says
  // otherwise: default of the equivalence tests, a convention and no result.
  double margin = 0.0;
  double relative_margin = 0.0;
  // Values from which on the mean gets an interval (sample_statistics.h).
  std::int64_t fewest_for_mean = kFewestForMean;
};

// Returns the metrics of all drives, in the order of reports.
std::span<const Metric> Metrics();

// Returns the metrics of records with these columns: Metrics(), then one for each column of what a
// navigator counts for itself (truth::IsOwnColumn), of its name. That is a mean over all trials;
// trials that another navigator drove have no value.
std::vector<Metric> MetricsOf(const truth::RecordSchema& schema);

// Returns the metric of that name: one of Metrics(), or that of a navigator's own value. The unit
// and the definition of the latter stand in the schema, and are empty where it lacks the column: a
// baseline may have been made with a plugin that counted something else. nullopt where there is
// none.
std::optional<Metric> FindMetric(std::string_view name, const truth::RecordSchema& schema = {});

// Returns the difference below which a metric whose mean is `mean` counts as unchanged, in the
// metric's unit. It is always above 0: where neither margin says anything (a mean of 0), any
// difference matters.
double DefaultMargin(const Metric& metric, double mean);

// Returns how many values a mean of this column of records, or a mean difference, needs for an
// interval: the most that a metric of the column needs, kNeverForMean if one never has an interval.
std::int64_t FewestForMean(std::string_view column);

// Returns one value for each record, in their order; NaN where the trial does not count or has no
// finite value. It is nullopt where the schema lacks a column. Cost: linear.
std::optional<std::vector<double>> MetricValues(const Metric& metric,
                                                const truth::RecordSchema& schema,
                                                std::span<const truth::Record> records);

// A metric over some trials. What is undefined is NaN.
struct MetricSummary {
  Metric metric;
  std::int64_t count = 0;  // trials with a value
  double mean = 0.0;       // the rate, of a rate
  double deviation = 0.0;  // unbiased standard deviation
  // Rates: as asked for, exact where events are few (RateMethod). Means: that of `estimate`.
  Interval interval;
  IntervalMethod method = IntervalMethod::kWilson;  // by which that of a rate was made
  MeanEstimate estimate;                            // why a mean has no interval; of a rate nothing
  double median = 0.0;                              // NaN of a rate
  Interval median_interval;  // of order statistics, exact for any law; NaN below six values
  double min = 0.0;
  double max = 0.0;
};

// Summarizes one metric. `groups` tells which values hang together (DependentGroups); all are
// independent where it is empty. Dependent values have no interval of the median, which knows
// independent ones only.
MetricSummary SummarizeMetric(const Metric& metric, std::span<const double> values,
                              double confidence = kConfidence,
                              IntervalMethod method = IntervalMethod::kWilson,
                              std::span<const std::size_t> groups = {});

// Summarizes every metric of MetricsOf whose columns the schema has. With `outcome`, it is over
// trials that ended so (rates of outcomes are then left out).
std::vector<MetricSummary> SummarizeMetrics(const truth::RecordSchema& schema,
                                            std::span<const truth::Record> records,
                                            IntervalMethod method = IntervalMethod::kWilson,
                                            std::optional<truth::TrialOutcome> outcome = {});

}  // namespace rockyard::statistics
