// Simulated trials against published numbers: predictive intervals, p-values, verdicts. `rockyard
// check` and the report page hold runs against publications by it. No record depends on it;
// exit codes of checks do.
//
// Null hypothesis of each row: the published runs and the simulated trials follow one law. Its
// p-value is two-sided and contains the simulation's own uncertainty (proportions.h,
// predictive.h). Holm's procedure over all judged rows keeps the chance of any false `differs` at
// or below alpha.
//
// Numbers that are published without a sample, but with a tolerance, are judged by an interval of
// the simulated value: `agrees` inside of the tolerance (`holds` where nothing lies outside of it),
// `differs` apart from it, `underpowered` across its ends. The intervals of all such rows hold
// together with 1 - alpha (Bonferroni). What is computed from published numbers is a point: it
// `holds` or `differs`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "statistics/proportions.h"
#include "statistics/published_values.h"
#include "truth/record.h"

namespace rockyard::statistics {

// kAlternativeRateShift and kAlternativeShiftDeviations are the alternatives that power is computed
// against, fixed before any run. For counts: a rate 0.20 lower for success; 0.20 nearer to one half
// for any other count; for kinds of failure, a share of the commonest simulated kind 0.20 lower,
// spread evenly over the other kinds.
inline constexpr double kAlternativeRateShift = 0.20;
// The alternative for minimum and maximum: the published runs shifted by half a standard deviation
// of the simulated trials, up or down. Where the column has a lower limit (absolute errors,
// distances) also moved by scale, so that the mean moves by as much: distances from the limit times
// 1 + 0.5 deviation / mean, or divided by it. Of all these the one that is hardest to see counts. A
// shift alone would move a minimum near its limit by many times what it scatters, so that it could
// never be called underpowered, although no change of the law's spread could be seen in it.
inline constexpr double kAlternativeShiftDeviations = 0.5;
// Below this power a value that is not rejected counts as untested. regression.h asks for as much
// (kNeededPower), and for a shift as large (kShiftThatMatters).
inline constexpr double kRequiredPower = 0.8;
// Level at which a set of runs is called consistent with an exponential law.
inline constexpr double kExponentialLevel = 0.05;

// The contiguous prefix of finished trials of one scenario.
struct ScenarioRun {
  std::string scenario;
  truth::RecordSchema schema;
  std::span<const truth::Record> records;
  // Distance to the goal at which the rover declares arrival; NaN: taken from the trials as the
  // largest true final distance of a declared success.
  double goal_tolerance_m = std::numeric_limits<double>::quiet_NaN();
  // The settings in which the run differs from the scenario that the reference is about, one each,
  // for people. Where this is not empty, what is compared is not the published case.
  std::vector<std::string> other_settings = {};
};

struct ComparisonOptions {
  std::uint64_t seed = 1;  // of the resampling alone
  std::size_t replicates = 10000;
  double alpha = 0.05;
};

enum class Verdict {
  kAgrees,        // not rejected, and the alternative would have been with kRequiredPower or more
  kHolds,         // a bound or arithmetic: true, but of any simulation, so that it tells none apart
  kDiffers,       // rejected after Holm
  kUnderpowered,  // not rejected, but the published runs are too few to tell
  kNotJudged,     // no number to judge by, or no simulated trials
};
const char* Name(Verdict verdict);

// The prediction for another statistic of the same published set, or for a set of which as many
// runs arrived as the publication says, or over the simulated arrivals alone. Shown beside and not
// judged: which runs fail is part of the prediction, so that rows are judged over all runs.
struct SideStatistic {
  std::string name;
  double median = 0.0;
  Interval interval;     // 95 %
  double p_value = 0.0;  // of the published value read as this statistic, not adjusted; NaN: none
};

// Success counts if all runs of a set met one rock layout.
struct OneLayout {
  Interval p_value;  // equal ends when `measured`
  bool measured =
      false;  // from repeated trials on layouts; otherwise bounds over all possibilities
};

// One kind of failure among the published number of failures.
struct KindPrediction {
  std::string name;
  std::int64_t published = 0;
  std::int64_t simulated = 0;  // in the whole pool
};

struct ComparedValue {
  PublishedValue published;
  Verdict verdict = Verdict::kNotJudged;
  std::int64_t pool = 0;  // simulated trials behind the prediction
  double pool_value =
      std::numeric_limits<double>::quiet_NaN();              // over the whole pool; rate for counts
  double median = std::numeric_limits<double>::quiet_NaN();  // predictive, for the published size
  // The predictive 95 % interval, for the published size. For a number with a tolerance it is the
  // confidence interval of the simulated value, all of a reference together 95 %; the ends are
  // equal where it is computed.
  Interval interval{std::numeric_limits<double>::quiet_NaN(),
                    std::numeric_limits<double>::quiet_NaN()};
  double p_value = std::numeric_limits<double>::quiet_NaN();
  double holm_p_value = std::numeric_limits<double>::quiet_NaN();
  double level = std::numeric_limits<double>::quiet_NaN();  // that Holm grants this row
  double power = std::numeric_limits<double>::quiet_NaN();  // at that level
  std::optional<OneLayout> one_layout;
  std::vector<SideStatistic> beside;
  std::vector<KindPrediction> kinds;
  std::string remark;
};

// A scenario of the runs that is not the published case.
struct OtherSettings {
  std::string scenario;
  std::vector<std::string> settings;
};

struct ComparisonResult {
  ComparisonOptions options;
  std::size_t family = 0;             // rows in Holm's procedure
  std::vector<ComparedValue> values;  // in the order of the reference
  // Verdicts on these are as computed, and hold other settings against the published numbers.
  std::vector<OtherSettings> changed = {};

  // Returns the other settings of a scenario; null where it is the published case.
  const OtherSettings* FindChanged(std::string_view scenario) const;
};

// Compares every value of the reference with the run of its scenario; values without a run are
// kNotJudged. A pure function of its arguments. Cost: about replicates times published runs per
// row, some seconds in all. A column named "layout" marks trials that share a rock layout.
ComparisonResult Compare(const PublishedReference& reference, std::span<const ScenarioRun> runs,
                         const ComparisonOptions& options = {});

// Returns the exit code: 0 where all judged rows agree or hold, 1 where something differs, and 4
// where nothing differs, but something is underpowered or nothing could be judged. Must stay the
// numbers of campaign::Outcome, into which callers cast them.
int ExitCode(const ComparisonResult& result);

}  // namespace rockyard::statistics
