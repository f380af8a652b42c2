// rockyard check
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/published_settings.h"
#include "app/regression_check.h"
#include "batch/run_folder.h"
#include "campaign/output_file.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/json_file.h"
#include "report/atomic_file.h"
#include "report/baseline.h"
#include "report/comparison_reference.h"
#include "report/comparison_table.h"
#include "report/result_json.h"
#include "statistics/published_comparison.h"

namespace rockyard::app {
namespace {

struct CheckOptions {
  RegressionRequest regression;  // without runs and files
  bool allow_scenario_change = false;
  std::vector<std::string> runs;
  std::string reference;
  std::string cell;
  std::string junit;
  std::string csv;
  statistics::ComparisonOptions comparison;
};

std::vector<campaign::StoredRun> ReadRuns(const std::vector<std::string>& paths,
                                          const std::string& cell) {
  std::vector<campaign::StoredRun> runs;
  std::map<std::string, std::string> folders;  // by scenario
  std::vector<core::Problem> problems;
  for (const std::string& path : paths) {
    for (const auto& folder : batch::FindRuns(path)) {
      runs.push_back(campaign::ReadRun(folder, cell));
      campaign::RequireWhole(runs.back());
      const std::string& scenario = runs.back().identity.scenario;
      const auto [at, is_new] = folders.emplace(scenario, folder.string());
      if (!is_new) {
        problems.push_back({folder.string(),
                            fmt::format("is a run of {}, and so is {}", scenario, at->second),
                            "name one run of each scenario"});
      }
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return runs;
}

void NoteUnfinished(const campaign::StoredRun& run) {
  const auto usable = static_cast<std::int64_t>(run.prefix().size());
  if (usable < run.planned) {
    PrintNote(fmt::format("{}: unfinished, {} of {} trials are used", run.folder.string(), usable,
                          run.planned));
  }
}

RegressionRequest Regression(const CheckOptions& options) {
  RegressionRequest request = options.regression;
  request.runs = options.runs;
  request.cell = options.cell;
  request.junit = options.junit;
  request.csv = options.csv;
  if (options.allow_scenario_change) request.scenario_change = ScenarioChange::kAllow;
  return request;
}

// Of the options for a baseline.
void AddRegressionOptions(CLI::App& command, CheckOptions& options) {
  command.add_flag("--allow-scenario-change", options.allow_scenario_change,
                   "baseline: compare although settings differ");
  command.add_flag("--all", options.regression.all_rows, "baseline: show equivalent metrics too");
  command
      .add_option("--alpha", options.regression.options.alpha,
                  "baseline: chance of any false alarm in an unchanged build")
      ->check(CLI::Range(1e-6, 0.2))
      ->capture_default_str();
  command
      .add_option("--equivalence-alpha", options.regression.options.equivalence_alpha,
                  "baseline: chance to call a metric equivalent that moved by its margin")
      ->check(CLI::Range(1e-6, 0.2))
      ->capture_default_str();
}

ExitCode Check(const CheckOptions& options) {
  campaign::CheckOutputFile("--junit", options.junit);
  campaign::CheckOutputFile("--csv", options.csv);
  const core::JsonValue document = core::LoadJsonFile(options.reference);
  if (report::IsBaseline(document)) return CheckAgainstBaseline(document, Regression(options));
  const statistics::PublishedReference reference = report::ParseReference(document);
  const std::vector<campaign::StoredRun> stored = ReadRuns(options.runs, options.cell);
  std::vector<const campaign::StoredRun*> runs;
  for (const campaign::StoredRun& run : stored) {
    NoteUnfinished(run);
    runs.push_back(&run);
  }
  const std::filesystem::path folder = std::filesystem::path(options.reference).parent_path();
  const statistics::ComparisonResult result =
      statistics::Compare(reference, PublishedViews(reference, folder, runs), options.comparison);
  if (!options.junit.empty()) {
    report::WriteFileAtomically(options.junit, report::ComparisonJUnit(reference, result));
  }
  if (!options.csv.empty()) {
    report::WriteFileAtomically(options.csv, report::ComparisonCsv(result));
  }
  const int code = statistics::ExitCode(result);
  Print(options.regression.json ? report::PublishedCheckJson(reference, result, code)
                                : report::ComparisonText(reference, result));
  return static_cast<ExitCode>(code);
}

}  // namespace

void AddCheckCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check", "Compares runs with published values or a baseline; exit code 0, 1 or 4");
  command->add_option("RUN", options->runs, "folders of runs, or a folder of such folders")
      ->required();
  command->add_option("--against", options->reference, "reference or baseline file")->required();
  command->add_option("--cell", options->cell, "cell of a campaign: its name, or number from 0");
  command->add_option("--junit", options->junit, "write a JUnit report to this file");
  command->add_option("--csv", options->csv, "write the table as CSV to this file");
  command->add_flag("--json", options->regression.json, "print JSON instead of the table");
  command->add_option("--seed", options->comparison.seed, "seed of the resampling")
      ->capture_default_str();
  command->add_option("--replicates", options->comparison.replicates, "samples for each number")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  AddRegressionOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = Check(*options); });
}

}  // namespace rockyard::app
