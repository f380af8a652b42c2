#include <cmath>
#include <string>

#include "report/json_members.h"
#include "report/page_data.h"
#include "statistics/multiple_testing.h"

namespace rockyard::report {
namespace {

using core::JsonList;

std::string SuccessJson(const SuccessComparison& success) {
  return ObjectText("what", success.what, "first", success.first.rate, "second",
                    success.second.rate, "difference", success.difference, "low",
                    success.interval.low, "high", success.interval.high, "p", success.p_value);
}

std::string SettingJson(const PageSetting& setting) {
  return ObjectText("path", setting.path, "first", setting.first, "second", setting.second);
}

std::vector<std::string> Notes(const RunComparison& comparison, bool adjusted) {
  std::vector<std::string> notes;
  if (!comparison.paired) {
    notes.emplace_back("Different seeds: compared as two samples, not in pairs.");
  } else if (comparison.same_terrain) {
    notes.emplace_back("In pairs of trials with equal rocks and equal noise.");
  } else {
    notes.emplace_back(
        "In pairs of trials with equal random numbers, but other settings of terrain or course.");
  }
  if (comparison.shared_layouts) {
    notes.emplace_back(
        "Trials share layouts of rocks: intervals allow for it, and there are no p-values.");
  }
  notes.emplace_back(adjusted ? "p-values of all pairs of runs are adjusted together by Holm."
                              : "p-values are not adjusted: one for each kind of success.");
  notes.emplace_back(
      "Intervals are each on their own at 95 %: of thirty columns one or two exclude zero by "
      "chance.");
  return notes;
}

}  // namespace

void AdjustSuccesses(std::span<PageComparison> comparisons) {
  std::vector<double*> tests;
  for (PageComparison& each : comparisons) {
    for (SuccessComparison& success : each.comparison.successes) {
      if (std::isfinite(success.p_value)) tests.push_back(&success.p_value);
    }
  }
  std::vector<double> p_values;
  p_values.reserve(tests.size());
  for (const double* test : tests) p_values.push_back(*test);
  const std::vector<double> adjusted = statistics::HolmAdjust(p_values);
  for (std::size_t i = 0; i < tests.size(); ++i) *tests[i] = adjusted[i];
}

std::string PageComparisonJson(const PageComparison& comparison, bool adjusted) {
  const RunComparison& result = comparison.comparison;
  const std::string columns = ColumnsOf(result).Json(
      "trials,column as name,unit,n,n_second,first,second,difference,low,high");
  return ObjectText("first", comparison.first, "second", comparison.second, "paired", result.paired,
                    "pairs", result.pairs, "notes", Notes(result, adjusted), "settings",
                    Json{JsonList(comparison.settings, SettingJson)}, "successes",
                    Json{JsonList(result.successes, SuccessJson)}, "columns", Json{columns});
}

}  // namespace rockyard::report
