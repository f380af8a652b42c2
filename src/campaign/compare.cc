#include "campaign/compare.h"

#include <fmt/format.h>

#include <utility>

#include "campaign/run_source.h"
#include "core/error.h"
#include "core/json_text.h"
#include "report/result_json.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

std::string TextAt(const core::JsonValue* value) {
  const bool text = value != nullptr && value->Is(core::JsonValue::Type::kText);
  return text ? value->text() : std::string("unknown");
}

// Returns what a run is of, as its scenario says: an experiment, or one study of an experiment that
// has several.
std::string ExperimentOf(const StoredRun& run) {
  const core::JsonValue document = core::ParseJson(run.identity.resolved, "resolved scenario");
  const std::string experiment = TextAt(document.Find("experiment"));
  const core::JsonValue* group = document.Find(experiment);
  const core::JsonValue* study = group == nullptr ? nullptr : group->Find("study");
  if (study == nullptr) return "experiment " + experiment;
  return "study " + TextAt(study) + " of experiment " + experiment;
}

void RequireSameExperiment(const StoredRun& first, const StoredRun& second) {
  const std::string a = ExperimentOf(first);
  const std::string b = ExperimentOf(second);
  if (a == b) return;
  throw core::UserError(second.Label(),
                        fmt::format("is a run of {}, but {} is one of {}", b, first.Label(), a),
                        "compare two runs of the same experiment and study");
}

const std::string& SecondCell(const CompareRequest& request) {
  return request.second_cell.empty() ? request.cell : request.second_cell;
}

statistics::CellComparison CompareMeasurements(const StoredRun& first, const StoredRun& second) {
  RequireSameExperiment(first, second);
  const report::ComparedRun a = ComparedView(first);
  const report::ComparedRun b = ComparedView(second);
  statistics::CellComparison cells =
      statistics::CompareCells(statistics::SummarizeCells(a.schema, a.records),
                               statistics::SummarizeCells(b.schema, b.records));
  if (cells.tests == 0) {
    throw core::UserError(second.Label(), "shares no cell with trials with " + first.Label(),
                          "compare runs whose lists of factors have values in common");
  }
  return cells;
}

// Compares measurements, whose runs are read whole.
statistics::CellComparison CompareMeasurements(const CompareRequest& request) {
  return CompareMeasurements(ReadRun(request.first, request.cell),
                             ReadRun(request.second, SecondCell(request)));
}

Comparison CompareStored(const CompareRequest& request) {
  StoredRun first = ReadRun(request.first, request.cell, StoredValues::kNone);
  StoredRun second = ReadRun(request.second, SecondCell(request), StoredValues::kNone);
  RequireWhole(first);
  RequireWhole(second);
  Comparison comparison;
  if (truth::IsMeasurement(first.schema) || truth::IsMeasurement(second.schema)) {
    statistics::CellComparison cells = CompareMeasurements(request);
    if (cells.Differing() > 0) comparison.outcome = Outcome::kDiffers;
    comparison.found = std::move(cells);
  } else {
    comparison.found = CompareDrives(first, second);
  }
  comparison.settings =
      batch::FindScenarioDifferences(first.identity.resolved, second.identity.resolved);
  comparison.first = std::move(first);
  comparison.second = std::move(second);
  return comparison;
}

std::string DriveJson(const Comparison& told, const report::RunComparison& drives) {
  report::PageComparison page{told.first.Label(), told.second.Label(), drives, {}};
  for (const batch::ScenarioDifference& each : told.settings) {
    page.settings.push_back({each.path, each.first, each.second});
  }
  return report::DriveComparisonJson(page);
}

}  // namespace

core::Result<Comparison> Compare(const CompareRequest& request) {
  return core::Attempt([&] { return CompareStored(request); });
}

std::string ComparisonJson(const Comparison& comparison) {
  if (const auto* drives = std::get_if<report::RunComparison>(&comparison.found)) {
    return DriveJson(comparison, *drives);
  }
  return report::CellComparisonJson(ComparedView(comparison.first), ComparedView(comparison.second),
                                    std::get<statistics::CellComparison>(comparison.found),
                                    static_cast<int>(comparison.outcome));
}

}  // namespace rockyard::campaign
