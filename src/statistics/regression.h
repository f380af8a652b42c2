// Has a build changed what a campaign says? Its trials against a stored baseline, metric by metric,
// for `rockyard check`.
//
// Each metric of each cell is tested for a change (no difference as the null hypothesis) and for
// equivalence (a difference of its margin or more as the null hypothesis):
//   values, paired: Student's t of the differences; not paired: Welch's t
//   rates, paired: McNemar's exact test, Tango's score; not paired: Fisher's exact test, Farrington
//   and Manning's score
// Both sides enter with equally many trials and values, the first of each: with unlike numbers and
// skewed values Welch's test does not keep a level of alpha over the number of metrics.
//
// Two families. Primary: declared and true success of each cell, its distance, its time and the
// three errors of dead reckoning (IsPrimary). Secondary: all other metrics, most of which hang
// together with these. Holm's procedure holds each family at its own part of alpha, so that the
// chance that an unchanged build gives any `changed` is at most `alpha`, whatever the dependence
// between metrics; most of alpha belongs to the primary family, so that the many secondary metrics
// do not take its power. What is undecided in the secondary family leaves the check decided.
//
// Equivalence is tested for each metric alone: calling one metric equivalent that moved by its
// margin has a chance of at most `equivalence_alpha` for rates, and about that for values.
// Trials must not share rocks (course.trials_per_layout 1): they count as independent.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "statistics/metrics.h"
#include "statistics/proportions.h"
#include "truth/record.h"

namespace rockyard::statistics {

// One metric of a cell in the baseline: what each trial gave, NaN where it gave none.
struct BaselineMetric {
  std::string name;
  double margin = 0.0;  // differences below it do not matter; in the metric's unit
  std::vector<double> values;
};

// Two samples with fewer values than this are inconclusive.
inline constexpr std::int64_t kMinValues = 20;
// Pairs that differ, below which equivalence rests on their number (SparseEquivalencePValue) and
// not on their scatter.
inline constexpr std::int64_t kMinDiffering = 30;

struct RegressionCell {
  std::string name;
  // Whether baseline and run have the same rocks, noise and index: trial i of both may be compared
  // with itself.
  bool paired = false;
  // Whether the run's records are the baseline's to the last bit: metrics with equal values are
  // equivalent.
  bool identical = false;
  std::span<const BaselineMetric> baseline;
  // The values of the run, in the order of `baseline`; empty where the run has no such metric.
  std::vector<std::vector<double>> run;
  // The run's columns, which tell of what its navigator counts for itself.
  truth::RecordSchema schema = {};
};

// Power with which a shift that matters must be seen, for its absence to say something: as
// kRequiredPower of published_comparison.h.
inline constexpr double kNeededPower = 0.8;
// A shift of a mean that matters, in standard deviations between trials, where its margin is
// smaller: as kAlternativeShiftDeviations of published_comparison.h.
inline constexpr double kShiftThatMatters = 0.5;

// Whether the metric belongs to the primary family.
bool IsPrimary(const Metric& metric);

struct RegressionOptions {
  double alpha = 0.01;              // of both families: any false `changed`
  double primary_share = 0.8;       // of alpha, of the primary family; the rest of the secondary
  double equivalence_alpha = 0.05;  // of each metric: `equivalent` although it moved by its margin

  double FamilyAlpha(bool primary) const {
    return alpha * (primary ? primary_share : 1.0 - primary_share);
  }
};

enum class RegressionVerdict {
  kChanged,       // a difference is there, large or small
  kEquivalent,    // none is shown, and it is shown to be smaller than the margin
  kNoneSeen,      // none is shown, and one that matters would have been seen (to_see)
  kInconclusive,  // none of these: too few trials to know
};

struct RegressionRow {
  std::string cell;
  Metric metric;
  bool primary = false;
  bool paired = false;
  std::int64_t baseline_count = 0;  // pairs, where paired
  std::int64_t run_count = 0;
  double baseline_mean = 0.0;
  double run_mean = 0.0;
  double difference = 0.0;  // run less baseline
  Interval interval{};      // 95 %, of the difference, alone
  double margin = 0.0;
  double p_value = 1.0;       // of no difference
  double holm_p_value = 1.0;  // in its family
  double level = 0.0;         // at which this test is rejected, given the others
  double equivalence_p_value = 1.0;
  // Shifts that such a run would have called `changed` at `level` with that probability; NaN where
  // none or nothing is known. Rates: exact power, from the baseline's rate towards the far end; of
  // pairs, with as many discordant ones as were seen, half of them either way, beside the shift.
  // Values: Student's law, with the scatter that was seen.
  double seen_80 = 0.0;
  double seen_90 = 0.0;
  // The shift that matters: the margin; of a mean, half a standard deviation between trials (of
  // both sides) where that is more.
  double to_see = 0.0;
  // Whether such a shift would have been seen with kNeededPower; where few pairs differ, whether
  // their number excludes it.
  bool sees_enough = false;
  // Trials (pairs) with which a shift of the margin would be seen with 80 %, about; 0 where
  // unknown.
  std::int64_t trials_for_margin = 0;
  RegressionVerdict verdict = RegressionVerdict::kInconclusive;
};

struct RegressionResult {
  RegressionOptions options;
  std::vector<RegressionRow> rows;  // metrics of which either side has values

  std::int64_t Count(RegressionVerdict verdict) const;
  // Returns the number of such rows of one family.
  std::int64_t Count(RegressionVerdict verdict, bool primary) const;
};

// Tests every metric of every cell. A metric that one side has no value of is inconclusive. Cost:
// linear in trials times metrics; and the power of Fisher's test for each number of trials and
// level, 0.1 s for 2000.
RegressionResult CheckRegression(std::span<const RegressionCell> cells,
                                 const RegressionOptions& options = {});

// Returns the exit code: 1 where something changed, of either family; else 4 where something of the
// primary family is inconclusive, a metric has values on one side only, or there is nothing; else
// 0. Must stay the numbers of campaign::Outcome, into which callers cast them.
int ExitCode(const RegressionResult& result);

// Returns the value with five significant digits. Must be used for both sides: baselines hold
// values so rounded, and the run's are compared with them.
double RoundForBaseline(double value);

}  // namespace rockyard::statistics
