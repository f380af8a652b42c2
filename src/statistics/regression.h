// Has a build changed what a campaign says? Its trials against a stored baseline, metric by metric.
//
// Each metric of each cell is tested for a change (no difference as the null hypothesis) and for
// equivalence (a difference of its margin or more as the null hypothesis):
//   values, paired: Student's t of the differences; not paired: Welch's t
//   rates, paired: McNemar's exact test, Tango's score; not paired: Fisher's exact test, Farrington
//   and Manning's score
// All tests for a change are one family (Holm): the chance that an unchanged build gives any
// `changed` is at most `alpha`, whatever the dependence between metrics. Equivalence is tested for
// each metric alone: calling one metric equivalent that is not has a chance of `equivalence_alpha`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "statistics/metrics.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {

// One metric of a cell in the baseline: what each trial gave, NaN where it gave none.
struct BaselineMetric {
  std::string name;
  double margin = 0.0;  // differences below it do not matter; in the metric's unit
  std::vector<double> values;
};

struct RegressionCell {
  std::string name;
  // The same rocks, noise and index: trial i of both may be compared with itself.
  bool paired = false;
  std::span<const BaselineMetric> baseline;
  // Of the run, in the order of `baseline`; empty where the run has no such metric.
  std::vector<std::vector<double>> run;
};

struct RegressionOptions {
  double alpha = 0.01;              // of the family: any false `changed`
  double equivalence_alpha = 0.05;  // of each metric: `equivalent` although it moved by its margin
};

enum class RegressionVerdict {
  kChanged,       // a difference is there, large or small
  kEquivalent,    // none is shown, and it is shown to be smaller than the margin
  kInconclusive,  // neither: too few trials to know
};

struct RegressionRow {
  std::string cell;
  const Metric* metric = nullptr;
  bool paired = false;
  std::int64_t baseline_count = 0;  // pairs, where paired
  std::int64_t run_count = 0;
  double baseline_mean = 0.0;
  double run_mean = 0.0;
  double difference = 0.0;  // run less baseline
  Interval interval{};      // 95 %, of the difference, alone
  double margin = 0.0;
  double p_value = 1.0;       // of no difference
  double holm_p_value = 1.0;  // in the family
  double level = 0.0;         // at which this test is rejected, given the others
  double equivalence_p_value = 1.0;
  // Shifts that this run would have called `changed` with that probability: normal approximation at
  // `level`, with the scatter that was seen.
  double seen_80 = 0.0;
  double seen_90 = 0.0;
  // Trials (pairs) with which a shift of the margin would be seen with 80 %; 0 where unknown.
  std::int64_t trials_for_margin = 0;
  RegressionVerdict verdict = RegressionVerdict::kInconclusive;
};

struct RegressionResult {
  RegressionOptions options;
  std::vector<RegressionRow> rows;  // metrics of which either side has values

  std::int64_t Count(RegressionVerdict verdict) const;
};

// Cost: linear in trials times metrics, but for Fisher's test.
RegressionResult CheckRegression(std::span<const RegressionCell> cells,
                                 const RegressionOptions& options = {});

// 1: something changed; else 4: something is inconclusive, or there is nothing; else 0.
int ExitCode(const RegressionResult& result);

// Values enter a baseline, and the comparison with it, with five significant digits.
double RoundForBaseline(double value);

}  // namespace rockyard::statistics
