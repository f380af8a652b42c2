#include <cmath>
#include <string>

#include "core/json_pieces.h"
#include "report/page_data.h"
#include "statistics/multiple_testing.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonObject;
using core::JsonTexts;

std::string Success(const SuccessComparison& success) {
  return JsonObject()
      .AddText("what", success.what)
      .AddNumber("first", success.first.rate)
      .AddNumber("second", success.second.rate)
      .AddNumber("difference", success.difference)
      .AddNumber("low", success.interval.low)
      .AddNumber("high", success.interval.high)
      .AddNumber("p", success.p_value)
      .Text();
}

void AddColumns(std::string_view trials, const std::vector<ColumnComparison>& columns, bool paired,
                std::vector<std::string>& rows) {
  for (const ColumnComparison& column : columns) {
    rows.push_back(JsonObject()
                       .AddText("trials", trials)
                       .AddText("name", column.name)
                       .AddText("unit", column.unit)
                       .AddInteger("n", column.count)
                       .Add("n_second", paired ? "null" : std::to_string(column.second_count))
                       .AddNumber("first", column.first_mean)
                       .AddNumber("second", column.second_mean)
                       .AddNumber("difference", column.difference)
                       .AddNumber("low", column.interval.low)
                       .AddNumber("high", column.interval.high)
                       .Text());
  }
}

std::string Notes(const RunComparison& comparison, bool adjusted) {
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
  return JsonTexts(notes);
}

std::string Settings(const std::vector<PageSetting>& settings) {
  std::vector<std::string> rows;
  rows.reserve(settings.size());
  for (const PageSetting& setting : settings) {
    rows.push_back(JsonObject()
                       .AddText("path", setting.path)
                       .AddText("first", setting.first)
                       .AddText("second", setting.second)
                       .Text());
  }
  return JsonList(rows);
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
  std::vector<std::string> successes;
  for (const SuccessComparison& success : result.successes) successes.push_back(Success(success));
  std::vector<std::string> columns;
  AddColumns("all", result.columns, result.paired, columns);
  AddColumns("arrived", result.arrived_columns, result.paired, columns);
  return JsonObject()
      .AddText("first", comparison.first)
      .AddText("second", comparison.second)
      .AddFlag("paired", result.paired)
      .AddInteger("pairs", result.pairs)
      .Add("notes", Notes(result, adjusted))
      .Add("settings", Settings(comparison.settings))
      .Add("successes", JsonList(successes))
      .Add("columns", JsonList(columns))
      .Text();
}

}  // namespace rockyard::report
