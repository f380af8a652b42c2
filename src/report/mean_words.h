// What a report says where the mean of a metric has no interval; JSON values that several result
// files hold.
#pragma once

#include <string>

#include "core/json_value.h"
#include "statistics/metrics.h"
#include "statistics/proportions.h"

namespace rockyard::report {

// Why there is no interval, in a few words: "3 trials differ from 0, needs 10". Empty where there
// is one.
std::string ReasonOf(const statistics::MeanEstimate& estimate);

// A metric over some trials: {count, mean, ci95} and, where it is no rate, {ci_reason (where ci95
// is null), median, median_ci95, min, max, std, usual, share_apart {count, rate, ci95}}: the
// commonest value, and the trials that have another one, exact. ci_method says how ci95 is made:
// wilson, clopper_pearson or skewed_t (statistics/sample_statistics.h); null where there is none.
core::JsonValue MetricJson(const statistics::MetricSummary& summary);

// {count, trials, rate, ci95, ci_method}.
core::JsonValue RateJson(const statistics::Proportion& rate);

// Of summary.json and its like.
inline constexpr int kSchemaVersion = 2;

}  // namespace rockyard::report
