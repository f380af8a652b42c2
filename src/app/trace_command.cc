// The command `rockyard trace`: what happened in one trial, and whether it repeats its record.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/option_checks.h"
#include "app/progress_line.h"
#include "app/run_folders.h"
#include "campaign/campaign_traces.h"
#include "campaign/output_folder.h"
#include "campaign/trial_source.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "report/line_text.h"
#include "report/trace_view.h"

namespace rockyard::app {
namespace {

struct StoryOptions {
  campaign::TrialRequest request;
  std::string csv;
  std::string svg;
  std::string npz;
  std::string mcap;
  bool all = false;
};

// Refuses files that cannot be written before the drive rather than after it.
void CheckOutputs(const StoryOptions& options) {
  const std::array<campaign::NamedFile, 4> files{{{"--csv", options.csv},
                                                  {"--svg", options.svg},
                                                  {"--npz", options.npz},
                                                  {"--mcap", options.mcap}}};
  for (const campaign::NamedFile& file : files) campaign::CheckOutputFile(file.option, file.file);
  campaign::CheckDistinct(files);
}

void WriteOutputs(const StoryOptions& options, const campaign::TrialSource& source,
                  const campaign::DriveRecording& recording) {
  const truth::TracedTrial& traced = recording.traced;
  if (!options.csv.empty()) {
    report::WriteFileAtomically(options.csv, report::TraceCsv(traced.trace));
    Print(fmt::format("  samples and events in {}\n", report::Printable(options.csv)));
  }
  if (!options.svg.empty()) {
    report::WriteFileAtomically(options.svg, campaign::PlanView(source.scenario, traced));
    Print(fmt::format("  plan view in {}\n", report::Printable(options.svg)));
  }
  // Must agree: the bytes that `run --traces` writes of the same trial.
  const auto write = [&](const std::string& file, campaign::TraceFormat format, const char* what) {
    if (file.empty()) return;
    report::WriteFileAtomically(
        file, campaign::TraceBytes(source.scenario, source.cell, recording, format));
    Print(fmt::format("  {} in {}\n", what, report::Printable(file)));
  };
  write(options.npz, campaign::TraceFormat::kNpz, "arrays for NumPy");
  write(options.mcap, campaign::TraceFormat::kMcap, "messages for readers of MCAP");
}

ExitCode Trace(const StoryOptions& options) {
  CheckOutputs(options);
  const campaign::TrialSource source = campaign::FindTrial(options.request);
  const campaign::DriveRecording recording = [&] {
    const BusyLine busy(fmt::format("driving trial {} again", options.request.trial));
    return campaign::RecordDrive(source.scenario, source.seed, options.request.trial);
  }();
  const truth::TracedTrial& traced = recording.traced;
  Print(report::TraceStory(traced,
                           options.all ? report::StoryLength::kAll : report::StoryLength::kFolded));
  std::vector<core::Problem> differences;
  if (source.stored) {
    differences = campaign::CompareWithStore(options.request, source, traced.schema, traced.record);
    PrintProblems(differences);
  }
  PrintRepetition(source.stored ? std::optional(differences.empty()) : std::nullopt,
                  options.request.source);
  try {
    WriteOutputs(options, source, recording);
  } catch (const core::UserError& failure) {
    // Thrown on, the failure would end as bad input. Its exit code outweighs that of a record that
    // differs, which has been told.
    PrintProblems(failure.problems());
    return ExitCode::kFailed;
  }
  return differences.empty() ? ExitCode::kDone : ExitCode::kDiffers;
}

}  // namespace

void AddTraceCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<StoryOptions>();
  CLI::App* command = app.add_subcommand(
      "trace", "Drives one trial again and tells what happened; of a run, checks its record");
  AddTrialOptions(*command, options->request);
  command->add_option("--csv", options->csv, "file for samples and events");
  command->add_option("--svg", options->svg,
                      "file for a plan view with the true and believed path");
  command->add_option("--npz", options->npz,
                      "file for posture, events, scans and steps as arrays for NumPy");
  command->add_option("--mcap", options->mcap,
                      "file for the same and the scene, for Foxglove and other readers of MCAP");
  command->add_flag("--all", options->all, "a line for every event");
  command->callback([options, &exit_code] {
    FindSource(options->request);
    exit_code = Trace(*options);
  });
}

}  // namespace rockyard::app
