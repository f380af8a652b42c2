// The rows of the comparison with published values, by statistic, before Holm's procedure. Only
// published_comparison.cc asks for them; the compare_*.cc make them. Rows that resample one
// column draw by a key made of their id, so that a row that is added moves no other's p-value but
// Holm's.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/random.h"
#include "statistics/predictive.h"
#include "statistics/proportions.h"
#include "statistics/published_comparison.h"

namespace rockyard::statistics {

struct Row {
  ComparedValue value;
  // The power at a level; empty for a row that is decided (or left open) without a p-value.
  std::function<double(double)> power;
  // The two-sided interval of the simulated value at a confidence; empty for a row that is not
  // judged by a tolerance.
  std::function<Interval(double)> interval;
};

// Counts of outcomes, of negative values, and kinds of failure. compare_counts.cc
Row CompareOutcomeCount(const PublishedValue& published, const ScenarioRun& run,
                        const ComparisonOptions& options);
Row CompareNegativeCount(const PublishedValue& published, const ScenarioRun& run);
Row CompareFailureKinds(const PublishedValue& published, const ScenarioRun& run);

// Statistics of one column. compare_samples.cc
Row CompareSampleStatistic(const PublishedValue& published, const ScenarioRun& run,
                           const ComparisonOptions& options);
Row CompareExponentialTail(const PublishedValue& published, const ScenarioRun& run,
                           const ComparisonOptions& options);
Row CompareLowerBound(const PublishedValue& published, const ScenarioRun& run,
                      const ComparisonOptions& options);
Row CompareMedianOffset(const PublishedValue& published, const ScenarioRun& run,
                        const ScenarioRun& other, const ComparisonOptions& options);

// The next two are about sets of which exactly PublishedValue::arrived runs arrived and the others
// did not, as the simulation predicts them. StatisticsByArrival returns the statistic of each set,
// NegativesByArrival the law of the count of negative values. Both return nothing where the
// publication does not say how many arrived, or where fewer than two simulated runs ended in a way
// in which runs of the set did. compare_arrivals.cc
std::vector<double> StatisticsByArrival(const PublishedValue& published, const ScenarioRun& run,
                                        const SampleStatistic& statistic, std::size_t replicates,
                                        core::TrialKey key);
std::optional<CountLaw> NegativesByArrival(const PublishedValue& published, const ScenarioRun& run);

// "39 arrivals of 40".
std::string ArrivalsName(const PublishedValue& published);

// A row that says why there is nothing to judge.
Row NotJudged(const PublishedValue& published, std::string remark);

// Values with a tolerance (HasTolerance). compare_tolerances.cc
Row CompareTolerance(const PublishedValue& published, const ScenarioRun& run);
Row CompareComputed(const PublishedValue& published);

}  // namespace rockyard::statistics
