// rockyard run
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/open_run.h"
#include "app/progress_line.h"
#include "app/run_source.h"
#include "batch/executor.h"
#include "batch/store_error.h"
#include "experiments/experiment.h"
#include "report/measurement_text.h"
#include "report/run_files.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

enum class Output { kText, kJson, kQuiet };

struct RunOptions {
  RunRequest request;
  batch::BatchOptions batch;
  std::string scenario;
  std::string out;
  std::string interval = "wilson";
  bool resume = false;
  bool force = false;
  bool any_build = false;
  bool json = false;
  bool quiet = false;
};

Output OutputOf(const RunOptions& options) {
  if (options.json) return Output::kJson;
  return options.quiet ? Output::kQuiet : Output::kText;
}

ExistingRun ExistingOf(const RunOptions& options) {
  if (options.resume) return options.force ? ExistingRun::kResumeOrSetAside : ExistingRun::kResume;
  return options.force ? ExistingRun::kSetAside : ExistingRun::kRefuse;
}

statistics::IntervalMethod MethodOf(const RunOptions& options) {
  return options.interval == "wilson" ? statistics::IntervalMethod::kWilson
                                      : statistics::IntervalMethod::kClopperPearson;
}

batch::BatchResult RunTrials(const experiments::Experiment& experiment, OpenedRun& run,
                             const batch::BatchOptions& options, Output output) {
  std::atomic<bool> stop = false;
  const InterruptGuard interrupt(stop, SecondSignal::kEnds);
  if (output == Output::kQuiet) {
    return batch::RunBatch(experiment, run.store, options, stop);
  }
  ProgressLine line(stderr);
  const batch::BatchResult result =
      batch::RunBatch(experiment, run.store, options, stop,
                      [&](const batch::Progress& progress) { line.Show(progress); });
  line.Finish(result.progress);
  return result;
}

void Show(Output output, const std::string& text, const std::string& json,
          const std::filesystem::path& folder) {
  switch (output) {
    case Output::kText:
      Print(text);
      Print(fmt::format("  results in {}\n", folder.string()));
      break;
    case Output::kJson:
      Print(json);
      break;
    case Output::kQuiet:
      break;
  }
}

// Derives the files from what is stored, and shows the summary.
void Report(const OpenedRun& run, const RunOptions& options) {
  const StoredRun stored = ReadRun(run.folder);
  report::RunDescription description = Describe(stored, batch::ThreadCount(options.batch));
  description.resolved = scenario::ResolvedJson(run.scenario);
  const statistics::IntervalMethod method = MethodOf(options);
  const truth::RecordSchema& schema = stored.schema;
  if (truth::IsMeasurement(schema)) {
    const statistics::MeasurementSummary summary = report::WriteMeasurementFiles(
        run.folder, description, schema, stored.records, stored.prefix(), method);
    Show(OutputOf(options), report::MeasurementText(description, summary, StyleFor(stdout)),
         report::MeasurementJson(description, summary, method), run.folder);
    return;
  }
  const statistics::DriveSummary summary = report::WriteRunFiles(
      run.folder, description, schema, stored.records, stored.prefix(), method);
  Show(OutputOf(options), report::SummaryText(description, summary, StyleFor(stdout)),
       report::SummaryJson(description, summary, method), run.folder);
}

ExitCode Judge(const OpenedRun& run, const batch::BatchResult& result,
               const batch::BatchOptions& options) {
  const batch::Progress& progress = result.progress;
  if (result.end == batch::BatchEnd::kStopped) {
    PrintNote(fmt::format(
        "interrupted: {} of {} trials are stored; go on with the same command and --resume",
        progress.finished, progress.planned));
    return ExitCode::kInterrupted;
  }
  if (!result.too_many_faults) return ExitCode::kDone;
  PrintProblems(
      {{run.folder.string(),
        fmt::format("{} of {} trials ended in a simulator fault, more than {} %", progress.faults,
                    progress.finished, 100.0 * options.max_fault_fraction),
        "trials.csv names seed and trial of each: look there for the reason"}});
  return ExitCode::kTooManyFaults;
}

// What fails from here on is no bad input: trials have been run, and are stored.
ExitCode RunAndReport(OpenedRun& run, RunOptions& options) {
  try {
    const auto experiment = experiments::MakeExperiment(run.scenario);
    const batch::BatchResult result = RunTrials(*experiment, run, options.batch, OutputOf(options));
    Report(run, options);
    return Judge(run, result, options.batch);
  } catch (const core::UserError& error) {
    PrintProblems(error.problems());
    return ExitCode::kFailed;
  }
}

ExitCode Run(RunOptions& options) {
  options.request.scenario = options.scenario;
  options.request.out = options.out;
  options.request.existing = ExistingOf(options);
  if (options.any_build) options.request.build = batch::BuildPolicy::kAny;
  const scenario::Scenario scenario = RequestedScenario(options.request);
  const truth::RecordSchema schema = experiments::MakeExperiment(scenario)->schema();
  OpenedRun run = OpenRun(options.request, scenario, schema);
  if (OutputOf(options) != Output::kQuiet) {
    for (const std::string& note : run.notes) PrintNote(note);
  }
  return RunAndReport(run, options);
}

void AddOptions(CLI::App& command, RunOptions& options) {
  command
      .add_option("SCENARIO", options.scenario,
                  "scenario file, scenario.resolved.json, or the folder of a run")
      ->required();
  command.add_option("--trials", options.request.trials, "number of trials, those stored included");
  command.add_option("--seed", options.request.seed, "seed of every random stream");
  command.add_option("--threads", options.batch.threads, "threads (default: all of the machine)")
      ->check(CLI::Range(1, 4096));
  command.add_option("--out", options.out, "run folder (default: results/runs/<name>-seed<seed>)");
  command
      .add_option("--set", options.request.overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
  command.add_flag("--resume", options.resume,
                   "go on with the run in the folder; a larger --trials extends it");
  command.add_flag("--force", options.force,
                   "set a run in the folder aside (nothing is deleted) and start anew; with "
                   "--resume only where it cannot go on");
  command.add_flag("--any-build", options.any_build,
                   "let --resume mix trials of different builds of the program");
  command
      .add_option("--max-faults", options.batch.max_fault_fraction,
                  "fraction of simulator faults above which the run fails")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_option("--interval", options.interval, "of rates: wilson or clopper-pearson")
      ->check(CLI::IsMember({"wilson", "clopper-pearson"}))
      ->capture_default_str();
  CLI::Option* json =
      command.add_flag("--json", options.json, "print summary.json instead of the table");
  command.add_flag("--quiet", options.quiet, "print nothing but errors")->excludes(json);
}

}  // namespace

void AddRunCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Runs the trials of a scenario");
  AddOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace rockyard::app
