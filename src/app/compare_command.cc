// rockyard compare
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "batch/scenario_difference.h"
#include "campaign/output_file.h"
#include "campaign/run_source.h"
#include "campaign/run_views.h"
#include "core/error.h"
#include "core/json_text.h"
#include "report/atomic_file.h"
#include "report/cell_comparison_text.h"
#include "report/paired_comparison.h"
#include "report/result_json.h"
#include "statistics/cell_comparison.h"
#include "truth/measurement_record.h"

namespace rockyard::app {
namespace {

struct CompareOptions {
  std::string first;
  std::string second;
  std::string cell;
  std::string second_cell;
  std::string csv;
  bool json = false;
};

std::string TextAt(const core::JsonValue* value) {
  const bool text = value != nullptr && value->Is(core::JsonValue::Type::kText);
  return text ? value->text() : std::string("unknown");
}

// What a run is of, as its scenario says.
std::string ExperimentOf(const campaign::StoredRun& run) {
  const core::JsonValue document = core::ParseJson(run.identity.resolved, "resolved scenario");
  const std::string experiment = TextAt(document.Find("experiment"));
  if (!truth::IsMeasurement(run.schema)) return "experiment " + experiment;
  const core::JsonValue* group = document.Find(experiment);
  const core::JsonValue* study = group == nullptr ? nullptr : group->Find("study");
  return "study " + TextAt(study) + " of experiment " + experiment;
}

void RequireSameExperiment(const campaign::StoredRun& first, const campaign::StoredRun& second) {
  const std::string a = ExperimentOf(first);
  const std::string b = ExperimentOf(second);
  if (a == b) return;
  throw core::UserError(second.Label(),
                        fmt::format("is a run of {}, but {} is one of {}", b, first.Label(), a),
                        "compare two runs of the same experiment and study");
}

ExitCode CompareMeasurements(const campaign::StoredRun& first, const campaign::StoredRun& second,
                             const CompareOptions& options) {
  RequireSameExperiment(first, second);
  const report::ComparedRun a = campaign::ComparedView(first);
  const report::ComparedRun b = campaign::ComparedView(second);
  const statistics::CellComparison cells =
      statistics::CompareCells(statistics::SummarizeCells(a.schema, a.records),
                               statistics::SummarizeCells(b.schema, b.records));
  if (cells.tests == 0) {
    throw core::UserError(second.Label(), "shares no cell with trials with " + first.Label(),
                          "compare runs whose lists of factors have values in common");
  }
  if (!options.csv.empty()) {
    report::WriteFileAtomically(options.csv, report::CellComparisonCsv(cells));
  }
  const ExitCode code = cells.Differing() > 0 ? ExitCode::kDiffers : ExitCode::kDone;
  Print(options.json ? report::CellComparisonJson(a, b, cells, static_cast<int>(code))
                     : report::CellComparisonText(a, b, cells));
  return code;
}

// The settings in which two runs differ, one per line.
std::string SettingsText(const campaign::StoredRun& first, const campaign::StoredRun& second) {
  constexpr std::size_t kShown = 12;
  const std::vector<batch::ScenarioDifference> differences =
      batch::FindScenarioDifferences(first.identity.resolved, second.identity.resolved);
  if (differences.empty()) return "\nno setting differs\n";
  std::string text = "\nsettings that differ (A, B)\n";
  for (const batch::ScenarioDifference& each :
       std::span(differences).first(std::min(kShown, differences.size()))) {
    text += fmt::format("  {:<56} {:>18.18} {:>20.20}\n", each.path, each.first, each.second);
  }
  if (differences.size() > kShown) {
    text += fmt::format("  and {} more: compare the files scenario.resolved.json\n",
                        differences.size() - kShown);
  }
  return text;
}

std::string DriveJson(const campaign::StoredRun& first, const campaign::StoredRun& second,
                      const report::RunComparison& comparison) {
  report::PageComparison told{first.Label(), second.Label(), comparison, {}};
  for (const batch::ScenarioDifference& each :
       batch::FindScenarioDifferences(first.identity.resolved, second.identity.resolved)) {
    told.settings.push_back({each.path, each.first, each.second});
  }
  return report::DriveComparisonJson(told);
}

ExitCode CompareDrives(const campaign::StoredRun& first, const campaign::StoredRun& second,
                       const CompareOptions& options) {
  const report::ComparedRun a = campaign::ComparedView(first);
  const report::ComparedRun b = campaign::ComparedView(second);
  const report::RunComparison comparison = report::CompareRuns(a, b);
  if (!options.csv.empty()) {
    report::WriteFileAtomically(options.csv, report::RunComparisonCsv(comparison));
  }
  Print(options.json ? DriveJson(first, second, comparison)
                     : report::RunComparisonText(a, b, comparison) + SettingsText(first, second));
  return ExitCode::kDone;
}

ExitCode Compare(const CompareOptions& options) {
  campaign::CheckOutputFile("--csv", options.csv);
  const campaign::StoredRun first = campaign::ReadRun(options.first, options.cell);
  const campaign::StoredRun second = campaign::ReadRun(
      options.second, options.second_cell.empty() ? options.cell : options.second_cell);
  campaign::RequireWhole(first);
  campaign::RequireWhole(second);
  const bool drive = !truth::IsMeasurement(first.schema) && !truth::IsMeasurement(second.schema);
  return drive ? CompareDrives(first, second, options)
               : CompareMeasurements(first, second, options);
}

}  // namespace

void AddCompareCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand(
      "compare",
      "Compares two runs: drives trial by trial where their seeds are the same (exit code 0: they\n"
      "describe), measurements cell by cell (exit code 1 where a rate differs)");
  command->add_option("RUN_A", options->first, "folder of a run")->required();
  command->add_option("RUN_B", options->second, "folder of a run")->required();
  command->add_option("--cell", options->cell,
                      "cell of a campaign: its name, or number from 0; of both runs");
  command->add_option("--cell-b", options->second_cell, "cell of RUN_B, where it is another one");
  command->add_option("--csv", options->csv,
                      "write every cell, or every column of drives, to this file");
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->callback([options, &exit_code] { exit_code = Compare(*options); });
}

}  // namespace rockyard::app
