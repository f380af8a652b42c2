// rockyard trace
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_file.h"
#include "app/run_source.h"
#include "core/error.h"
#include "experiments/drive_experiment.h"
#include "report/atomic_file.h"
#include "report/trace_csv.h"
#include "report/trace_drawing.h"
#include "report/trace_story.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "terrain/field_export.h"
#include "trial/layout.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

struct TraceOptions {
  std::string source;
  std::uint32_t trial = 0;
  std::optional<std::int64_t> seed;
  std::vector<std::string> overrides;
  std::string csv;
  std::string svg;
  bool all = false;
};

// The trial to drive, and what a finished run says of it.
struct TraceSource {
  scenario::Scenario scenario;
  std::uint64_t seed = 1;
  std::optional<truth::Record> stored;
  std::vector<std::string> builds;  // that wrote the run
};

TraceSource FromRun(const TraceOptions& options) {
  if (options.seed || !options.overrides.empty()) {
    throw core::UserError(options.seed ? "--seed" : "--set",
                          "makes another trial than the one in the run's store",
                          "trace " + options.source + "/scenario.resolved.json instead");
  }
  const StoredRun run = ReadRun(options.source);
  const auto found = std::find_if(run.records.begin(), run.records.end(), [&](const auto& record) {
    return record.trial == options.trial;
  });
  if (found == run.records.end()) {
    throw core::UserError(
        "--trial", fmt::format("trial {} is not stored in {}", options.trial, options.source),
        fmt::format("use one of the {} finished trials, or trace the scenario file instead",
                    run.records.size()));
  }
  TraceSource source;
  source.scenario = LoadScenarioFrom(options.source);
  source.seed = run.identity.seed;
  source.stored = *found;
  source.builds = run.builds;
  return source;
}

TraceSource FromScenario(const TraceOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.seed) overrides.push_back(fmt::format("seed={}", *options.seed));
  TraceSource source;
  source.scenario = LoadScenarioFrom(options.source, overrides);
  source.seed = static_cast<std::uint64_t>(source.scenario.seed);
  return source;
}

// Found before the drive rather than after it.
void CheckOutputs(const TraceOptions& options) {
  CheckOutputFile("--csv", options.csv);
  CheckOutputFile("--svg", options.svg);
  if (!options.csv.empty() && options.csv == options.svg) {
    throw core::UserError("--svg", "is the same file as --csv", "name two files");
  }
}

std::string Svg(const scenario::Scenario& scenario, const report::TracedTrial& traced) {
  const terrain::Rectangle all = terrain::DrivableBounds(scenario.terrain.arena);
  const report::TraceDrawing drawing =
      report::DrawTrace(traced, {all.x_min_m, all.x_max_m, all.y_min_m, all.y_max_m});
  const report::DrawnArea& area = drawing.area;
  const terrain::Course course = trial::TerrainCourse(scenario.course);
  const core::TrialKey key{traced.seed, static_cast<std::uint32_t>(traced.record.trial)};
  const terrain::Field field =
      terrain::BuildField(scenario.terrain, trial::LayoutKey(scenario, key), course);
  return terrain::ToSvg(
      field, scenario.terrain, course,
      {drawing.elements, {area.x_min_m, area.x_max_m, area.y_min_m, area.y_max_m}});
}

void WriteOutputs(const TraceOptions& options, const scenario::Scenario& scenario,
                  const report::TracedTrial& traced) {
  if (!options.csv.empty()) {
    report::WriteFileAtomically(options.csv, report::TraceCsv(traced.trace));
    Print(fmt::format("  samples and events in {}\n", options.csv));
  }
  if (!options.svg.empty()) {
    report::WriteFileAtomically(options.svg, Svg(scenario, traced));
    Print(fmt::format("  plan view in {}\n", options.svg));
  }
}

// Whether this drive is the stored one.
ExitCode CompareWithStore(const TraceOptions& options, const TraceSource& source,
                          const report::TracedTrial& traced) {
  const auto differences = report::RecordDifferences(traced.schema, *source.stored, traced.record);
  if (differences.empty()) {
    Print("  same as the stored record, bit for bit\n");
    return ExitCode::kDone;
  }
  std::vector<core::Problem> problems;
  problems.reserve(differences.size() + 1);
  for (const std::string& difference : differences) {
    problems.push_back({fmt::format("trial {}", options.trial), difference, ""});
  }
  const bool other_build =
      std::find(source.builds.begin(), source.builds.end(), BuildName()) == source.builds.end();
  problems.push_back({options.source, "this drive is not the stored one: the records differ",
                      other_build
                          ? "trace with the program that made the run: " + source.builds.front()
                          : "the same program made it: this is a defect, please report it"});
  PrintProblems(problems);
  return ExitCode::kDiffers;
}

TraceSource SourceOf(const TraceOptions& options) {
  std::error_code error;
  return fs::is_directory(options.source, error) ? FromRun(options) : FromScenario(options);
}

report::TracedTrial Drive(const TraceSource& source, std::uint32_t trial) {
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
  const TraceSource source = SourceOf(options);
  const report::TracedTrial traced = Drive(source, options.trial);
  Print(report::TraceStory(traced,
                           options.all ? report::StoryLength::kAll : report::StoryLength::kFolded));
  const ExitCode exit_code =
      source.stored ? CompareWithStore(options, source, traced) : ExitCode::kDone;
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
  command
      ->add_option("SCENARIO_OR_RUN", options->source,
                   "scenario file, scenario.resolved.json, or the folder of a run")
      ->required();
  command->add_option("--trial", options->trial, "trial index, from 0")->required();
  command->add_option("--seed", options->seed, "seed of every random stream");
  command->add_option("--set", options->overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
  command->add_option("--csv", options->csv, "file for samples and events");
  command->add_option("--svg", options->svg,
                      "file for a plan view with the true and believed path");
  command->add_flag("--all", options->all, "a line for every event");
  command->callback([options, &exit_code] { exit_code = Trace(*options); });
}

}  // namespace rockyard::app
