#include "statistics/regression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string_view>

#include "core/check.h"
#include "core/numbers.h"
#include "statistics/multiple_testing.h"
#include "statistics/regression_samples.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

using core::kInfinity;

// The metrics of the primary family; "distance" and "time" are of every trial, arrived or not. Must
// stay: a metric that joins or leaves changes the levels that Holm's procedure grants all others,
// and so verdicts against stored baselines.
constexpr std::array<std::string_view, 7> kPrimary = {
    "declared_success",       "true_success",      "true_distance_m", "active_time_s",
    "distance_error_percent", "heading_error_deg", "position_error_m"};

// Fills what each side has on its own, which the row says where nothing can be compared.
void Describe(const RegressionSamples& samples, std::span<const double> baseline,
              std::span<const double> run, RegressionRow& row) {
  const bool common = !samples.empty();
  const Moments before = MomentsOf(common ? samples.baseline : SortedFinite(baseline));
  const Moments after = MomentsOf(common ? samples.run : SortedFinite(run));
  row.baseline_count = before.count();
  row.run_count = after.count();
  row.baseline_mean = before.mean();
  row.run_mean = after.mean();
  row.difference = row.run_mean - row.baseline_mean;
  row.interval = {-kInfinity, kInfinity};
}

// Whether trials and values are the same to the last bit: nothing is left to estimate.
bool Identical(const RegressionCell& cell, const RegressionSamples& samples) {
  return cell.identical && !samples.empty() && samples.baseline == samples.run;
}

RegressionRow MakeRow(const RegressionCell& cell, std::size_t index, const Metric& metric,
                      const RegressionSamples& samples) {
  const BaselineMetric& baseline = cell.baseline[index];
  RegressionRow row{
      .cell = cell.name, .metric = metric, .primary = IsPrimary(metric), .paired = cell.paired};
  row.margin = baseline.margin;
  Describe(samples, baseline.values, cell.run[index], row);
  TestSamples(samples, row);
  if (Identical(cell, samples)) {
    row.interval = {0.0, 0.0};
    row.equivalence_p_value = 0.0;
  }
  return row;
}

void Judge(const RegressionOptions& options, RegressionRow& row) {
  // A change that is shown stays a change, however small.
  if (row.holm_p_value <= options.FamilyAlpha(row.primary)) {
    row.verdict = RegressionVerdict::kChanged;
  } else if (row.equivalence_p_value <= options.equivalence_alpha) {
    row.verdict = RegressionVerdict::kEquivalent;
  } else if (row.sees_enough) {
    row.verdict = RegressionVerdict::kNoneSeen;
  }
}

// Holm's procedure over the rows of one family.
void SetLevels(const RegressionOptions& options, bool primary, std::vector<RegressionRow>& rows) {
  std::vector<RegressionRow*> family;
  std::vector<double> p_values;
  for (RegressionRow& row : rows) {
    if (row.primary != primary) continue;
    family.push_back(&row);
    p_values.push_back(row.p_value);
  }
  const std::vector<double> adjusted = HolmAdjust(p_values);
  const std::vector<double> levels = HolmLevels(p_values, options.FamilyAlpha(primary));
  for (std::size_t i = 0; i < family.size(); ++i) {
    family[i]->holm_p_value = adjusted[i];
    family[i]->level = levels[i];
  }
}

bool OnOneSideOnly(const RegressionRow& row) {
  return (row.baseline_count == 0) != (row.run_count == 0);
}

bool HasValue(std::span<const double> values) {
  return std::any_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

bool IsPrimary(const Metric& metric) {
  return std::find(kPrimary.begin(), kPrimary.end(), metric.name) != kPrimary.end();
}

std::int64_t RegressionResult::Count(RegressionVerdict verdict) const {
  return Count(verdict, true) + Count(verdict, false);
}

std::int64_t RegressionResult::Count(RegressionVerdict verdict, bool primary) const {
  return std::count_if(rows.begin(), rows.end(), [&](const RegressionRow& row) {
    return row.verdict == verdict && row.primary == primary;
  });
}

RegressionResult CheckRegression(std::span<const RegressionCell> cells,
                                 const RegressionOptions& options) {
  RegressionResult result{.options = options, .rows = {}};
  std::vector<RegressionSamples> samples;
  for (const RegressionCell& cell : cells) {
    EXPECT(cell.run.size() == cell.baseline.size());
    for (std::size_t i = 0; i < cell.baseline.size(); ++i) {
      const std::optional<Metric> metric = FindMetric(cell.baseline[i].name, cell.schema);
      if (!metric) continue;
      if (!HasValue(cell.baseline[i].values) && !HasValue(cell.run[i])) continue;
      samples.push_back(TakeSamples(cell.paired, cell.baseline[i].values, cell.run[i]));
      result.rows.push_back(MakeRow(cell, i, *metric, samples.back()));
    }
  }
  for (const bool primary : {true, false}) SetLevels(options, primary, result.rows);
  RegressionPower power;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    power.Fill(samples[i], options.equivalence_alpha, result.rows[i]);
    Judge(options, result.rows[i]);
  }
  return result;
}

int ExitCode(const RegressionResult& result) {
  if (result.Count(RegressionVerdict::kChanged) > 0) return 1;
  const bool unsure = result.rows.empty() ||
                      result.Count(RegressionVerdict::kInconclusive, true) > 0 ||
                      std::any_of(result.rows.begin(), result.rows.end(), OnOneSideOnly);
  return unsure ? 4 : 0;
}

double RoundForBaseline(double value) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr)
                              : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rockyard::statistics
