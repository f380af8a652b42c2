// rockyard trace
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_file.h"
#include "app/plan_view.h"
#include "app/trial_source.h"
#include "core/error.h"
#include "experiments/drive_experiment.h"
#include "report/atomic_file.h"
#include "report/trace_csv.h"
#include "report/trace_story.h"

namespace rockyard::app {
namespace {

struct TraceOptions {
  TrialRequest request;
  std::string csv;
  std::string svg;
  bool all = false;
};

// Found before the drive rather than after it.
void CheckOutputs(const TraceOptions& options) {
  CheckOutputFile("--csv", options.csv);
  CheckOutputFile("--svg", options.svg);
  if (!options.csv.empty() && options.csv == options.svg) {
    throw core::UserError("--svg", "is the same file as --csv", "name two files");
  }
}

void WriteOutputs(const TraceOptions& options, const scenario::Scenario& scenario,
                  const report::TracedTrial& traced) {
  if (!options.csv.empty()) {
    report::WriteFileAtomically(options.csv, report::TraceCsv(traced.trace));
    Print(fmt::format("  samples and events in {}\n", options.csv));
  }
  if (!options.svg.empty()) {
    report::WriteFileAtomically(options.svg, PlanView(scenario, traced));
    Print(fmt::format("  plan view in {}\n", options.svg));
  }
}

report::TracedTrial Drive(const TrialSource& source, std::uint32_t trial) {
  report::TracedTrial traced;
  traced.scenario = source.scenario.name;
  traced.seed = source.seed;
  traced.goal = {source.scenario.course.goal_x_m, source.scenario.course.goal_y_m};
  traced.schema = experiments::DriveSchema();
  traced.record =
      experiments::DriveExperiment(source.scenario).RunTraced(source.seed, trial, traced.trace);
  return traced;
}

ExitCode Trace(const TraceOptions& options) {
  CheckOutputs(options);
  const TrialSource source = FindTrial(options.request);
  if (source.scenario.experiment != scenario::ExperimentKind::kDrive) {
    throw core::UserError(options.request.source, "is no drive, and only drives have a course",
                          "use rockyard replay, which lists the scans of any trial");
  }
  const report::TracedTrial traced = Drive(source, options.request.trial);
  Print(report::TraceStory(traced,
                           options.all ? report::StoryLength::kAll : report::StoryLength::kFolded));
  const ExitCode exit_code =
      source.stored ? CompareWithStore(options.request, source, traced.schema, traced.record)
                    : ExitCode::kDone;
  try {
    WriteOutputs(options, source.scenario, traced);
  } catch (const core::UserError& failure) {
    PrintProblems(failure.problems());
    return ExitCode::kFailed;
  }
  return exit_code;
}

}  // namespace

void AddTraceCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<TraceOptions>();
  CLI::App* command = app.add_subcommand(
      "trace", "Drives one trial again and tells what happened; of a run, checks its record");
  AddTrialOptions(*command, options->request);
  command->add_option("--csv", options->csv, "file for samples and events");
  command->add_option("--svg", options->svg,
                      "file for a plan view with the true and believed path");
  command->add_flag("--all", options->all, "a line for every event");
  command->callback([options, &exit_code] { exit_code = Trace(*options); });
}

}  // namespace rockyard::app
