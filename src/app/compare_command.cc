// The command `rockyard compare`: two runs, trial by trial or cell by cell.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/run_folders.h"
#include "campaign/compare.h"
#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "report/line_text.h"
#include "report/paired_comparison.h"

namespace rockyard::app {
namespace {

struct CompareOptions {
  std::string first;
  std::string second;
  std::string cell;
  std::string second_cell;
  std::string csv;
  bool all = false;
  bool json = false;
};

void WriteCsv(const CompareOptions& options, const std::string& csv) {
  if (!options.csv.empty()) WriteNamedFile("table", options.csv, csv);
}

// Returns the settings in which two runs differ, one a line.
std::string SettingsText(const std::vector<batch::ScenarioDifference>& differences) {
  constexpr std::size_t kShown = 12;
  if (differences.empty()) return "no setting differs\n\n";
  std::string text = "settings that differ (A, B)\n";
  for (const batch::ScenarioDifference& each :
       std::span(differences).first(std::min(kShown, differences.size()))) {
    text += fmt::format("  {:<56} {:>18} {:>20}\n", report::Printable(each.path),
                        report::Cut(report::Printable(each.first), 18),
                        report::Cut(report::Printable(each.second), 20));
  }
  if (differences.size() > kShown) {
    text += fmt::format("  and {} more: compare the files scenario.resolved.json\n",
                        differences.size() - kShown);
  }
  return text + "\n";
}

void Show(const campaign::Comparison& told, const CompareOptions& options) {
  const report::ComparedRun a = campaign::ComparedView(told.first);
  const report::ComparedRun b = campaign::ComparedView(told.second);
  if (const auto* drives = std::get_if<report::RunComparison>(&told.found)) {
    WriteCsv(options, report::RunComparisonCsv(*drives));
    if (options.json) return PrintJson(campaign::ComparisonJson(told));
    return Print(
        report::RunComparisonText(a, b, *drives, SettingsText(told.settings), options.all));
  }
  const auto& cells = std::get<statistics::CellComparison>(told.found);
  WriteCsv(options, report::CellComparisonCsv(cells));
  if (options.json) return PrintJson(campaign::ComparisonJson(told));
  Print(SettingsText(told.settings) + report::CellComparisonText(a, b, cells));
}

ExitCode Compare(const CompareOptions& options) {
  campaign::CheckOutputFile("--csv", options.csv);
  RequireRuns(std::array{options.first, options.second});
  const campaign::Comparison told = campaign::Compare({.first = options.first,
                                                       .second = options.second,
                                                       .cell = options.cell,
                                                       .second_cell = options.second_cell})
                                        .OrThrow();
  Show(told, options);
  return told.outcome;
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
  command->add_flag("--all", options->all,
                    "every column of drives, not those alone that metrics are made of");
  command->add_flag("--json", options->json, "print JSON instead of the table")->excludes("--all");
  command->callback([options, &exit_code] { exit_code = Compare(*options); });
}

}  // namespace rockyard::app
