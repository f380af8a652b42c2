// rockyard replay
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "app/commands.h"
#include "app/console.h"
#include "app/scan_capture.h"
#include "app/trial_source.h"
#include "core/error.h"
#include "experiments/experiment.h"
#include "report/atomic_file.h"
#include "report/png_file.h"
#include "report/scan_drawing.h"
#include "report/scan_picture.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

struct ReplayOptions {
  TrialRequest request;
  std::optional<std::int64_t> scan;
  std::string out;
};

// Scans of the trial, and of the one that was asked for everything that can be shown.
struct Replayed {
  truth::RecordSchema schema;
  truth::Record record;
  std::int64_t scans = 0;
  std::optional<CapturedScan> captured;
  std::string failure;  // why the scan that was asked for cannot be shown
};

fs::path FolderOf(const ReplayOptions& options, const TrialSource& source) {
  if (!options.out.empty()) return options.out;
  return fs::path("results") / "runs" /
         fmt::format("{}-seed{}-trial{}-scan{}", source.scenario.name, source.seed,
                     options.request.trial, *options.scan);
}

// Pictures of two scans in one folder would be told apart by nothing.
void CheckFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (fs::is_directory(folder, error) && fs::is_empty(folder, error)) return;
  throw core::UserError("--out", folder.string() + " exists and is no empty folder",
                        "name another folder, or remove it");
}

// One line per scan: where the rover stood, and what the scan shows by itself.
std::string ScanLine(std::int64_t number, const trial::WatchedScan& watched) {
  std::string stripes;
  for (const bool hazard : HazardsOf(watched).stripe_hazard) stripes += hazard ? '#' : '.';
  const math::Pose2 pose = math::ToPose2(watched.X_WR);
  return fmt::format("  scan {:>5}   x {:>7.3f} m   y {:>7.3f} m   heading {:>7.1f} deg   {}\n",
                     number, pose.x_m, pose.y_m, math::RadToDeg(pose.heading_rad), stripes);
}

Replayed Replay(const ReplayOptions& options, const TrialSource& source) {
  Replayed replayed;
  const auto experiment =
      experiments::MakeExperiment(source.scenario, [&](const trial::WatchedScan& watched) {
        const std::int64_t number = replayed.scans++;
        if (!options.scan) {
          Print(ScanLine(number, watched));
        } else if (number == *options.scan) {
          // A picture that fails must not become a fault of the trial.
          try {
            replayed.captured = Capture(watched);
            replayed.captured->view.title =
                fmt::format("{}, seed {}, trial {}, scan {}", source.scenario.name, source.seed,
                            options.request.trial, number);
          } catch (const std::exception& error) {
            replayed.failure = error.what();
          }
        }
      });
  replayed.schema = experiment->schema();
  replayed.record = experiment->Run(source.seed, options.request.trial);
  return replayed;
}

std::string FileStem(const messages::StripeExposure& frames) {
  return fmt::format("{}-group{}", frames.camera == 0 ? "left" : "right", frames.group);
}

void WriteScan(const fs::path& folder, const scenario::Scenario& scenario,
               const CapturedScan& captured) {
  fs::create_directories(folder);
  for (const CapturedExposure& exposure : captured.exposures) {
    const auto write = [&](std::string_view what, const report::Picture& picture) {
      report::WriteFileAtomically(
          folder / fmt::format("{}-{}.png", FileStem(exposure.frames), what),
          report::EncodePng(picture));
    };
    write("lit", report::FramePicture(exposure.frames.lit.front()));
    write("dark", report::FramePicture(exposure.frames.dark.front()));
    write("difference",
          report::DifferencePicture(captured.view, exposure.frames, exposure.difference));
  }
  report::WriteFileAtomically(folder / "scenario.resolved.json", scenario::ResolvedJson(scenario));
  report::WriteFileAtomically(folder / "array.svg", report::ScanSvg(captured.view));
  report::WriteFileAtomically(folder / "points.csv", report::ScanCsv(captured.view));
}

ExitCode WriteOutputs(const ReplayOptions& options, const TrialSource& source,
                      const CapturedScan& captured) {
  const fs::path folder = FolderOf(options, source);
  try {
    WriteScan(folder, source.scenario, captured);
  } catch (const core::UserError& failure) {
    PrintProblems(failure.problems());
    return ExitCode::kFailed;
  } catch (const fs::filesystem_error& failure) {
    PrintProblems({{folder.string(), failure.code().message(), "name another folder with --out"}});
    return ExitCode::kFailed;
  }
  Print(report::ScanText(captured.view));
  Print(fmt::format("  images, array.svg and points.csv in {}\n", folder.string()));
  return ExitCode::kDone;
}

ExitCode Replay(const ReplayOptions& options) {
  const TrialSource source = FindTrial(options.request);
  if (options.scan) CheckFolder(FolderOf(options, source));
  const Replayed replayed = Replay(options, source);
  if (truth::IsFault(replayed.record)) PrintNote("simulator fault: " + replayed.record.detail);
  const ExitCode same =
      source.stored ? CompareWithStore(options.request, source, replayed.schema, replayed.record)
                    : ExitCode::kDone;
  if (!options.scan) {
    Print(fmt::format("  {} scans; --scan N draws one of them\n", replayed.scans));
    return same;
  }
  if (!replayed.failure.empty()) {
    PrintProblems({{"--scan", "the images cannot be rendered: " + replayed.failure, ""}});
    return ExitCode::kFailed;
  }
  if (!replayed.captured) {
    throw core::UserError(
        "--scan", fmt::format("scan {} was not taken in this trial", *options.scan),
        fmt::format("the trial took {} scans{}; leave --scan out to list them", replayed.scans,
                    truth::IsFault(replayed.record) ? " until its simulator fault" : ""));
  }
  const ExitCode written = WriteOutputs(options, source, *replayed.captured);
  return written == ExitCode::kDone ? same : written;
}

}  // namespace

void AddReplayCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay", "Runs one trial again and lists its scans, or draws one of them");
  AddTrialOptions(*command, options->request);
  command
      ->add_option("--scan", options->scan,
                   "number of the scan, from 0: writes its images and its array")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out,
                      "folder (default: results/runs/<name>-seed<seed>-trial<I>-scan<N>)");
  command->callback([options, &exit_code] { exit_code = Replay(*options); });
}

}  // namespace rockyard::app
