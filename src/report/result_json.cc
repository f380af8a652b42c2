#include "report/result_json.h"

#include <string_view>
#include <vector>

#include "report/comparison_table.h"
#include "report/regression_report.h"
#include "report/result_table.h"

namespace rockyard::report {
namespace {

using core::JsonList;

// One object on a line, with its kind before all other members.
template <typename... Members>
std::string ResultLine(std::string_view kind, const Members&... members) {
  return ObjectText("schema_version", 1, "kind", kind, members...) + "\n";
}

std::string RecordsJson(const RecordChanges& changes) {
  const std::string columns = JsonList(changes.columns, [](const RecordChanges::Column& column) {
    return ObjectText("column", column.name, "trials", column.trials);
  });
  return ObjectText("pairs", changes.pairs, "changed", changes.trials, "only_hash",
                    changes.only_hash, "columns", Json{columns});
}

std::string CheckedCellJson(const CheckedCell& cell) {
  return ObjectText("name", cell.name, "identical", cell.identical, "not_deterministic",
                    cell.not_deterministic, "paired", cell.paired, "same_fields", cell.same_fields,
                    "baseline_trials", cell.baseline_trials, "run_trials", cell.run_trials,
                    "records", Json{RecordsJson(cell.records)});
}

std::string CountedRateJson(const statistics::Proportion& rate) {
  return ObjectText("count", rate.count, "trials", rate.trials, "rate", rate.rate);
}

std::string ComparedRateJson(std::string_view name, const statistics::RateDifference& rate,
                             bool differs) {
  return ObjectText("rate", name, "first", Json{CountedRateJson(rate.first)}, "second",
                    Json{CountedRateJson(rate.second)}, "difference", rate.difference, "low",
                    rate.interval.low, "high", rate.interval.high, "p_holm", rate.adjusted,
                    "differs", differs);
}

std::string ComparedCellJson(const statistics::CellComparison& all,
                             const statistics::ComparedCell& cell) {
  core::JsonObject factors;
  for (std::size_t i = 0; i < all.factors.size(); ++i) {
    factors.AddNumber(all.factors[i].name, cell.factors[i]);
  }
  std::vector<std::string> rates;
  for (std::size_t i = 0; i < all.rates.size(); ++i) {
    rates.push_back(ComparedRateJson(all.rates[i].name, cell.rates[i], all.Differs(cell.rates[i])));
  }
  return ObjectText("factors", Json{factors.Text()}, "rates", Json{JsonList(rates)});
}

}  // namespace

std::string PublishedCheckJson(const statistics::PublishedReference& reference,
                               const statistics::ComparisonResult& result, int exit_code) {
  const std::string changed = JsonList(result.changed, [](const statistics::OtherSettings& other) {
    return ObjectText("scenario", other.scenario, "settings", other.settings);
  });
  const std::string values = ComparisonRows(result, ComparisonDetail::kValues)
                                 .Json(
                                     "id,scenario,what,place,role,unit,published,published_runs,"
                                     "simulated_runs,simulated,predicted_median,predicted_low,"
                                     "predicted_high,p_value,p_holm,power,verdict,remark");
  return ResultLine("published_check", "reference", reference.title, "not_the_published_case",
                    Json{changed}, "exit_code", exit_code, "family", result.family, "values",
                    Json{values});
}

std::string BaselineCheckJson(const RegressionReport& report, int exit_code) {
  const statistics::RegressionOptions& options = report.result.options;
  const std::string metrics = RegressionTable(report).Json(
      "cell,metric,unit,verdict,paired,baseline_count,run_count,baseline_mean,run_mean,"
      "difference,difference_low as low,difference_high as high,margin,p_holm,p_equivalence,"
      "trials_for_margin,family,seen_80,to_see");
  return ResultLine("baseline_check", "baseline", report.baseline, "baseline_build",
                    report.baseline_build, "run_build", report.run_build, "exit_code", exit_code,
                    "alpha", options.alpha, "primary_alpha", options.FamilyAlpha(true), "records",
                    Name(FindingOfRecords(report)), "distribution", DistributionName(report.result),
                    "cells", Json{JsonList(report.cells, CheckedCellJson)}, "metrics",
                    Json{metrics}, "notes", report.notes);
}

std::string DriveComparisonJson(const PageComparison& comparison) {
  return ResultLine("drive_comparison", "comparison", Json{PageComparisonJson(comparison, false)});
}

std::string CellComparisonJson(const ComparedRun& first, const ComparedRun& second,
                               const statistics::CellComparison& cells, int exit_code) {
  const std::string rows = JsonList(cells.cells, [&](const statistics::ComparedCell& cell) {
    return ComparedCellJson(cells, cell);
  });
  return ResultLine("cell_comparison", "first", first.name, "second", second.name, "exit_code",
                    exit_code, "alpha", cells.alpha, "tests", cells.tests, "cells", Json{rows});
}

}  // namespace rockyard::report
