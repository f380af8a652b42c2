// Numbers that a publication gives, in the form in which simulated trials can be held against them.
// report/comparison_reference.h reads them from reference files, published_comparison.h judges by
// them.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "truth/record.h"

namespace rockyard::statistics {

// What a published number says about its set of runs. Must stay in this order, which decides
// HasTolerance and SplitsByArrival. Names in reference files stand in the order of this enum, of
// Formula and of ValueRole (report/reference_fields.h).
enum class StatisticKind {
  kOutcomeCount,     // runs with one of `outcomes`
  kFailureKinds,     // how the failures divide into `kinds` and all others, given their number
  kNegativeCount,    // runs whose `column` is below zero
  kMinimum,          // of `column`
  kMaximum,          // of `column`
  kMode,             // of `column`; the definition used is the half-sample mode
  kExponentialTail,  // statement, no number: `column` looks exponential above its minimum
  kLowerBound,       // of `column` over runs that arrive: `value` less the goal tolerance
  kMedianOffset,     // statement, no number: `column` differs from `other_scenario`
  // Numbers without a sample: held against the simulation's own value by a tolerance.
  kRate,      // `column` over `of`, both added up: a binomial rate of independent scenes, or one of
              // events that depend on one another within a run
  kRatio,     // `column` over `of`, times `factor`, for sums that count no independent events
  kRatioSum,  // ratios of sums added up: `terms`, times `factor`
  kMean,      // of `column` over the runs, times `factor`
  kCrossing,  // where the rate of `column` over `of` first passes `level` along `along`, times
              // `factor`
  kComputed,  // `formula` of `inputs`: no simulation at all
};

// Whether a value is judged by its tolerance, see StatisticKind.
constexpr bool HasTolerance(StatisticKind kind) { return kind >= StatisticKind::kRate; }

// Whether the published set behind a value can be told apart by how many of its runs arrived, see
// PublishedValue::arrived.
constexpr bool SplitsByArrival(StatisticKind kind) {
  return kind >= StatisticKind::kNegativeCount && kind <= StatisticKind::kExponentialTail;
}

// Closed forms, see closed_forms.h.
enum class Formula {
  kNone,
  kAnyOf,
  kSum,
  kProduct,
  kQuotient,
  kNetRate,
  kRangeResolution,
  kPowerLaw,
  kPowerLawCover,
  kDriftAlong,
  kDriftAcross
};

// Records whose `column` lies within low .. high.
struct ColumnRange {
  std::string column;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// A term of kRatioSum: all of `columns` over `of`, each added up over the runs.
struct RatioTerm {
  std::vector<std::string> columns;
  std::string of;
};

// How independent a comparison is of the published data.
enum class ValueRole {
  kPrediction,   // nothing in the simulation was taken from the runs behind the number
  kConditional,  // conditional on error magnitudes that the publication states as inputs
  kCalibration,  // the simulation was calibrated with these runs or their siblings
};

// Failures of one kind and how many of the published ones were of it.
struct FailureKind {
  std::string name;
  std::vector<truth::TrialOutcome> outcomes;
  std::int64_t count = 0;
};

struct PublishedValue {
  // Unique, e.g. "nominal.distance.mode". Must stay: it keys the draws of the row, so that another
  // id gives other digits.
  std::string id;
  std::string what;      // for people
  std::string place;     // in the publication
  std::string scenario;  // whose trials it is compared with
  StatisticKind statistic = StatisticKind::kOutcomeCount;
  ValueRole role = ValueRole::kPrediction;
  std::int64_t sample_size = 0;  // published runs behind it
  // How many of them arrived, where the publication says so; 0 where not. Such sets are shown
  // beside the row, which is judged over all runs: SplitsByArrival.
  std::int64_t arrived = 0;
  double value = std::numeric_limits<double>::quiet_NaN();  // NaN for statements
  double rounding = 0.0;                                    // step of the last printed digit
  std::string unit = "1";
  // No value of the column can be smaller, e.g. 0 for an absolute error.
  double lower_limit = -std::numeric_limits<double>::infinity();
  std::string column;                         // of the trial records
  std::vector<truth::TrialOutcome> outcomes;  // kOutcomeCount
  std::vector<FailureKind> kinds;             // kFailureKinds
  std::string other_scenario;                 // kMedianOffset
  std::int64_t other_sample_size = 0;
  // Tolerance within which a simulated value agrees with the published one: HasTolerance.
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::string of;                  // column of the base: kRate, kRatio, kCrossing
  double factor = 1.0;             // to the published unit: kRatio, kRatioSum, kMean, kCrossing
  std::string along;               // column of the abscissa: kCrossing
  double level = 0.5;              // kCrossing
  std::vector<RatioTerm> terms;    // kRatioSum
  std::vector<ColumnRange> where;  // records that count; all where empty
  Formula formula = Formula::kNone;
  std::vector<double> inputs;
  std::string note;
};

// Something printed wrongly or two ways in the publication, and what is taken instead.
struct Misprint {
  std::string place;
  std::string printed;
  std::string used;
};

// The scenario file that stands for a published case.
struct ReferenceScenario {
  std::string name;
  std::string file;  // relative to the reference
};

struct PublishedReference {
  std::string title{};
  std::string citation{};
  std::vector<ReferenceScenario> scenarios{};  // those whose files are known
  std::vector<PublishedValue> values{};
  std::vector<Misprint> misprints{};
};

}  // namespace rockyard::statistics
