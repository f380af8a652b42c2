// What a set of drive trials says, in numbers. summary.json, the terminal, the cells of a sweep and
// the report page all take theirs from here, so that they agree. No record depends on it;
// comparisons with published values take columns by ColumnIndex and ColumnValues.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "statistics/metrics.h"
#include "statistics/proportions.h"
#include "truth/end_cause.h"
#include "truth/record.h"

namespace rockyard::statistics {

// One column over the trials that it covers. All NaN where no finite value exists.
struct ColumnSummary {
  std::string name;
  std::string unit;
  std::int64_t count = 0;  // finite values
  double min = 0.0;
  double p05 = 0.0;
  double median = 0.0;
  double mean = 0.0;
  double mode = 0.0;      // half-sample mode
  Interval mode_range{};  // by subsampling, no coverage claimed
  double p95 = 0.0;
  double max = 0.0;
  double std = 0.0;  // unbiased
};

// The values stand in the order of the trials.
ColumnSummary SummarizeColumn(std::string name, std::string unit, std::span<const double> values);

struct DriveSummary {
  std::int64_t planned = 0;
  std::int64_t completed = 0;   // records given, faults included
  std::int64_t faults = 0;      // simulator faults: in no rate and in no column
  Proportion declared_success;  // goal_reached and false_goal
  Proportion true_success;      // goal_reached
  Proportion ended_by_limit;    // neither arrived nor failed (truth::IsLimit)
  bool shared_layouts = false;  // trials share rocks, which every interval allows for
  std::array<std::int64_t, truth::kTrialOutcomeNames.size()> outcomes{};
  std::array<std::int64_t, truth::kEndCauses.size()> causes{};  // of records that tell theirs
  // The first trial that its navigator ended by a fault, with what it said.
  struct FirstFault {
    std::uint64_t trial = 0;
    std::string detail;
  };
  std::optional<FirstFault> first_navigator_fault;
  // Every column of the schema over all trials without a fault, in the schema's order; but
  // "path_ratio", last, is that metric's (over declared successes), whatever the schema has.
  std::vector<ColumnSummary> columns;
  std::vector<MetricSummary> metrics;  // over all trials
  // The same metrics over the trials that ended in one way each; empty where none did.
  std::array<std::vector<MetricSummary>, truth::kTrialOutcomeNames.size()> metrics_by_outcome;

  std::int64_t outcome(truth::TrialOutcome kind) const {
    return outcomes[static_cast<std::size_t>(kind)];
  }
  // Returns the bounds of the rate of declared success that these trials would have without limits:
  // none of those that a limit ended would have arrived, or all of them, and with them all that
  // found no path and tell no cause.
  Interval SuccessWithoutLimits() const;
  std::int64_t cause(truth::EndCause kind) const { return causes[static_cast<std::size_t>(kind)]; }
  const ColumnSummary* Find(std::string_view name) const;  // nullptr where there is none
};

// Returns the position of a column in the schema.
std::optional<std::size_t> ColumnIndex(const truth::RecordSchema& schema, std::string_view name);

// Returns the finite values of one column over the trials without a fault, in trial order.
std::vector<double> ColumnValues(std::span<const truth::Record> records, std::size_t column);

// Summarizes drives. `records` must be the contiguous prefix of finished trials, never the order of
// completion: failures run longer, so that completion order favours successes. `planned` is 0 where
// as many were planned as are given.
DriveSummary Summarize(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                       std::int64_t planned = 0, IntervalMethod method = IntervalMethod::kWilson);

}  // namespace rockyard::statistics
