#include "report/result_json.h"

#include <string_view>
#include <vector>

#include "core/json_pieces.h"
#include "report/comparison_format.h"
#include "report/regression_format.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonObject;
using core::JsonTexts;

JsonObject Begin(std::string_view kind) {
  return JsonObject().AddInteger("schema_version", 1).AddText("kind", kind);
}

std::string Line(const JsonObject& object) { return object.Text() + "\n"; }

std::string Value(const statistics::ComparedValue& value) {
  const statistics::PublishedValue& published = value.published;
  return JsonObject()
      .AddText("id", published.id)
      .AddText("scenario", published.scenario)
      .AddText("what", published.what)
      .AddText("place", published.place)
      .AddText("role", RoleName(published.role))
      .AddText("unit", published.unit)
      .AddNumber("published", published.value)
      .AddInteger("published_runs", published.sample_size)
      .AddInteger("simulated_runs", value.pool)
      .AddNumber("simulated", value.pool_value)
      .AddNumber("predicted_median", value.median)
      .AddNumber("predicted_low", value.interval.low)
      .AddNumber("predicted_high", value.interval.high)
      .AddNumber("p_value", value.p_value)
      .AddNumber("p_holm", value.holm_p_value)
      .AddNumber("power", value.power)
      .AddText("verdict", statistics::Name(value.verdict))
      .AddText("remark", value.remark)
      .Text();
}

std::string Records(const RecordChanges& changes) {
  std::vector<std::string> columns;
  for (const RecordChanges::Column& column : changes.columns) {
    columns.push_back(
        JsonObject().AddText("column", column.name).AddInteger("trials", column.trials).Text());
  }
  return JsonObject()
      .AddInteger("pairs", changes.pairs)
      .AddInteger("changed", changes.trials)
      .AddFlag("only_hash", changes.only_hash)
      .Add("columns", JsonList(columns))
      .Text();
}

std::string Cell(const CheckedCell& cell) {
  return JsonObject()
      .AddText("name", cell.name)
      .AddFlag("identical", cell.identical)
      .AddFlag("not_deterministic", cell.not_deterministic)
      .AddFlag("paired", cell.paired)
      .AddFlag("same_fields", cell.same_fields)
      .AddInteger("baseline_trials", cell.baseline_trials)
      .AddInteger("run_trials", cell.run_trials)
      .Add("records", Records(cell.records))
      .Text();
}

std::string MetricRow(const statistics::RegressionRow& row) {
  return JsonObject()
      .AddText("cell", row.cell)
      .AddText("metric", row.metric->name)
      .AddText("unit", row.metric->unit)
      .AddText("verdict", Name(row.verdict))
      .AddFlag("paired", row.paired)
      .AddInteger("baseline_count", row.baseline_count)
      .AddInteger("run_count", row.run_count)
      .AddNumber("baseline_mean", row.baseline_mean)
      .AddNumber("run_mean", row.run_mean)
      .AddNumber("difference", row.difference)
      .AddNumber("low", row.interval.low)
      .AddNumber("high", row.interval.high)
      .AddNumber("margin", row.margin)
      .AddNumber("p_holm", row.holm_p_value)
      .AddNumber("p_equivalence", row.equivalence_p_value)
      .AddInteger("trials_for_margin", row.trials_for_margin)
      .AddText("family", row.primary ? "primary" : "secondary")
      .AddNumber("seen_80", row.seen_80)
      .AddNumber("to_see", row.to_see)
      .Text();
}

std::string Rate(const statistics::Proportion& rate) {
  return JsonObject()
      .AddInteger("count", rate.count)
      .AddInteger("trials", rate.trials)
      .AddNumber("rate", rate.rate)
      .Text();
}

std::string ComparedRate(std::string_view name, const statistics::RateDifference& rate,
                         bool differs) {
  return JsonObject()
      .AddText("rate", name)
      .Add("first", Rate(rate.first))
      .Add("second", Rate(rate.second))
      .AddNumber("difference", rate.difference)
      .AddNumber("low", rate.interval.low)
      .AddNumber("high", rate.interval.high)
      .AddNumber("p_holm", rate.adjusted)
      .AddFlag("differs", differs)
      .Text();
}

std::string Cell(const statistics::CellComparison& all, const statistics::ComparedCell& cell) {
  JsonObject factors;
  for (std::size_t i = 0; i < all.factors.size(); ++i) {
    factors.AddNumber(all.factors[i].name, cell.factors[i]);
  }
  std::vector<std::string> rates;
  for (std::size_t i = 0; i < all.rates.size(); ++i) {
    rates.push_back(ComparedRate(all.rates[i].name, cell.rates[i], all.Differs(cell.rates[i])));
  }
  return JsonObject().Add("factors", factors.Text()).Add("rates", JsonList(rates)).Text();
}

}  // namespace

std::string PublishedCheckJson(const statistics::PublishedReference& reference,
                               const statistics::ComparisonResult& result, int exit_code) {
  std::vector<std::string> values;
  for (const statistics::ComparedValue& value : result.values) values.push_back(Value(value));
  std::vector<std::string> changed;
  for (const statistics::OtherSettings& other : result.changed) {
    changed.push_back(JsonObject()
                          .AddText("scenario", other.scenario)
                          .Add("settings", JsonTexts(other.settings))
                          .Text());
  }
  return Line(Begin("published_check")
                  .AddText("reference", reference.title)
                  .Add("not_the_published_case", JsonList(changed))
                  .AddInteger("exit_code", exit_code)
                  .AddInteger("family", static_cast<std::int64_t>(result.family))
                  .Add("values", JsonList(values)));
}

std::string BaselineCheckJson(const RegressionReport& report, int exit_code) {
  std::vector<std::string> cells;
  for (const CheckedCell& cell : report.cells) cells.push_back(Cell(cell));
  std::vector<std::string> metrics;
  for (const statistics::RegressionRow& row : report.result.rows) metrics.push_back(MetricRow(row));
  return Line(Begin("baseline_check")
                  .AddText("baseline", report.baseline)
                  .AddText("baseline_build", report.baseline_build)
                  .AddText("run_build", report.run_build)
                  .AddInteger("exit_code", exit_code)
                  .AddNumber("alpha", report.result.options.alpha)
                  .AddNumber("primary_alpha", report.result.options.FamilyAlpha(true))
                  .AddText("records", Name(FindingOfRecords(report)))
                  .AddText("distribution", DistributionName(report.result))
                  .Add("cells", JsonList(cells))
                  .Add("metrics", JsonList(metrics))
                  .Add("notes", JsonTexts(report.notes)));
}

std::string DriveComparisonJson(const PageComparison& comparison) {
  return Line(Begin("drive_comparison").Add("comparison", PageComparisonJson(comparison, false)));
}

std::string CellComparisonJson(const ComparedRun& first, const ComparedRun& second,
                               const statistics::CellComparison& cells, int exit_code) {
  std::vector<std::string> rows;
  for (const statistics::ComparedCell& cell : cells.cells) rows.push_back(Cell(cells, cell));
  return Line(Begin("cell_comparison")
                  .AddText("first", first.name)
                  .AddText("second", second.name)
                  .AddInteger("exit_code", exit_code)
                  .AddNumber("alpha", cells.alpha)
                  .AddInteger("tests", static_cast<std::int64_t>(cells.tests))
                  .Add("cells", JsonList(rows)));
}

}  // namespace rockyard::report
