// The command `rockyard check`: holds runs against published values or a baseline.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <variant>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "app/run_display.h"
#include "app/run_folders.h"
#include "campaign/check.h"
#include "campaign/output_folder.h"
#include "campaign/scenario_names.h"
#include "report/comparison_table.h"
#include "report/regression_report.h"

namespace rockyard::app {
namespace {

struct CheckOptions {
  campaign::CheckRequest request;
  bool allow_scenario_change = false;
  bool same_records = false;
  bool all_rows = false;
  bool json = false;
  std::string reference;
  std::string junit;
  std::string csv;
};

// Adds the options that hold for a baseline alone.
void AddRegressionOptions(CLI::App& command, CheckOptions& options) {
  command.add_flag("--allow-scenario-change", options.allow_scenario_change,
                   "baseline: compare although settings differ");
  command.add_flag("--same-records", options.same_records,
                   "baseline: exit code 1 also where any record changed");
  command.add_flag("--all", options.all_rows, "baseline: show every metric");
  command
      .add_option("--alpha", options.request.regression.alpha,
                  "baseline: chance of any false alarm in an unchanged build")
      ->check(CLI::Range(1e-6, 0.2))
      ->capture_default_str();
  command
      .add_option("--equivalence-alpha", options.request.regression.equivalence_alpha,
                  "baseline: chance to call a metric equivalent that moved by its margin")
      ->check(CLI::Range(1e-6, 0.2))
      ->capture_default_str();
}

void WriteFiles(const CheckOptions& options, const std::string& junit, const std::string& csv) {
  if (!options.junit.empty()) WriteNamedFile("JUnit report", options.junit, junit);
  if (!options.csv.empty()) WriteNamedFile("table", options.csv, csv);
}

ExitCode Show(const campaign::BaselineCheck& check, const CheckOptions& options) {
  const report::RegressionReport& found = check.report;
  WriteFiles(options, report::RegressionJUnit(found), report::RegressionCsv(found));
  const auto rows =
      options.all_rows ? report::ReportedRows::kAll : report::ReportedRows::kThatMatter;
  if (options.json) {
    PrintJson(campaign::CheckJson(check));
  } else {
    Print(Wrapped(report::RegressionText(found, rows)));
  }
  return check.outcome;
}

ExitCode Show(const campaign::PublishedCheck& check, const CheckOptions& options) {
  WriteFiles(options, report::ComparisonJUnit(check.reference, check.result),
             report::ComparisonCsv(check.result));
  if (options.json) {
    PrintJson(campaign::CheckJson(check));
  } else {
    Print(report::ComparisonText(check.reference, check.result));
  }
  return check.outcome;
}

ExitCode Check(const CheckOptions& options) {
  campaign::CheckOutputFile("--junit", options.junit);
  campaign::CheckOutputFile("--csv", options.csv);
  campaign::CheckRequest request = options.request;
  request.reference = campaign::ProjectPath(options.reference);
  if (options.allow_scenario_change) request.scenario_change = campaign::ScenarioChange::kAllow;
  if (options.same_records) request.record_change = campaign::RecordChange::kRefuse;
  const campaign::CheckResult result = [&] {
    const BusyLine busy("comparing");
    return campaign::Check(request, MessagesToConsole(Output::kText)).OrThrow();
  }();
  return std::visit([&](const auto& check) { return Show(check, options); }, result);
}

}  // namespace

void AddCheckCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check", "Compares runs with published values or a baseline; exit code 0, 1 or 4");
  command->add_option("RUN", options->request.runs, "folders of runs, or a folder of such folders")
      ->required();
  command->add_option("--against", options->reference, "reference or baseline file")->required();
  command->add_option("--cell", options->request.cell,
                      "cell of a campaign: its name, or number from 0");
  command->add_option("--junit", options->junit, "write a JUnit report to this file");
  command->add_option("--csv", options->csv, "write the table as CSV to this file");
  command->add_flag("--json", options->json, "print JSON instead of the table");
  command->add_option("--seed", options->request.comparison.seed, "seed of the resampling")
      ->capture_default_str();
  command
      ->add_option("--replicates", options->request.comparison.replicates,
                   "samples for each number")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  AddRegressionOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = Check(*options); });
}

}  // namespace rockyard::app
