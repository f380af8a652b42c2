#include "app/replay_views.h"

#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/console.h"
#include "app/trial_options.h"
#include "campaign/replay_files.h"
#include "campaign/scan_capture.h"
#include "campaign/trial_source.h"
#include "core/error.h"
#include "experiments/experiment.h"
#include "report/scan_drawing.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

// Scans and steps of the trial, and of the one that was asked for everything that can be shown.
struct Replayed {
  truth::RecordSchema schema;
  truth::Record record;
  std::int64_t scans = 0;
  std::int64_t steps = 0;
  std::optional<campaign::CapturedScan> scan;
  std::optional<campaign::CapturedStep> step;
  std::string failure;  // why what was asked for cannot be shown
};

fs::path FolderOf(const ReplayOptions& options, const campaign::TrialSource& source) {
  if (!options.out.empty()) return options.out;
  return fs::path("results") / "runs" /
         fmt::format("{}-seed{}-trial{}-{}{}", source.scenario.name, source.seed,
                     options.request.trial, options.what(), options.number());
}

// Pictures of two moments in one folder would be told apart by nothing.
void CheckFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (fs::is_directory(folder, error) && fs::is_empty(folder, error)) return;
  throw core::UserError("--out", folder.string() + " exists and is no empty folder",
                        "name another folder, or remove it");
}

std::string Line(std::string_view what, std::int64_t number, const math::Transform& X_WR,
                 std::string_view rest) {
  const math::Pose2 pose = math::ToPose2(X_WR);
  return fmt::format("  {} {:>5}   x {:>7.3f} m   y {:>7.3f} m   heading {:>7.1f} deg   {}\n", what,
                     number, pose.x_m, pose.y_m, math::RadToDeg(pose.heading_rad), rest);
}

// Where the rover stood, and what the scan shows by itself.
std::string ScanLine(std::int64_t number, const trial::WatchedScan& watched) {
  std::string stripes;
  for (const bool hazard : campaign::HazardsOf(watched).stripe_hazard)
    stripes += hazard ? '#' : '.';
  return Line("scan", number, watched.X_WR, stripes);
}

// Where the rover stood, and what it chose.
std::string StepLine(const trial::WatchedStep& watched) {
  return Line("step", watched.view.step, watched.X_WR,
              report::ChosenText(watched.view) + (watched.view.looked_behind ? ", rear" : ""));
}

class Replayer {
 public:
  Replayer(const ReplayOptions& options, const campaign::TrialSource& source)
      : options_(options), source_(source) {}

  Replayed Run() {
    const auto experiment = experiments::MakeExperiment(
        source_.scenario, [this](const trial::WatchedScan& watched) { OnScan(watched); },
        [this](const trial::WatchedStep& watched) { OnStep(watched); });
    replayed_.schema = experiment->schema();
    replayed_.record = experiment->Run(source_.seed, options_.request.trial);
    return std::move(replayed_);
  }

 private:
  std::string Title(std::string_view what, std::int64_t number) const {
    return fmt::format("{}, seed {}, trial {}, {} {}", source_.scenario.name, source_.seed,
                       options_.request.trial, what, number);
  }

  void OnScan(const trial::WatchedScan& watched) {
    const std::int64_t number = replayed_.scans++;
    if (!options_.draws()) Print(ScanLine(number, watched));
    if (options_.scan != number) return;
    // A picture that fails must not become a fault of the trial.
    try {
      replayed_.scan = campaign::Capture(watched);
      replayed_.scan->view.title = Title("scan", number);
    } catch (const std::exception& error) {
      replayed_.failure = error.what();
    }
  }

  void OnStep(const trial::WatchedStep& watched) {
    ++replayed_.steps;
    if (!options_.draws()) Print(StepLine(watched));
    if (options_.step != watched.view.step) return;
    replayed_.step = {{Title("step", watched.view.step), watched.view}, watched.cloud};
  }

  const ReplayOptions& options_;
  const campaign::TrialSource& source_;
  Replayed replayed_;
};

// True if the files could be written.
bool Write(const fs::path& folder, const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const core::UserError& failure) {
    PrintProblems(failure.problems());
  } catch (const fs::filesystem_error& failure) {
    PrintProblems({{folder.string(), failure.code().message(), "name another folder with --out"}});
  }
  return false;
}

ExitCode WriteOutputs(const ReplayOptions& options, const campaign::TrialSource& source,
                      const Replayed& replayed) {
  const fs::path folder = FolderOf(options, source);
  if (replayed.scan) {
    const auto write = [&] { campaign::WriteScanFiles(folder, source.scenario, *replayed.scan); };
    if (!Write(folder, write)) return ExitCode::kFailed;
    Print(report::ScanText(replayed.scan->view));
    Print(fmt::format("  images, array.svg and points.csv in {}\n", folder.string()));
  } else {
    const auto write = [&] { campaign::WriteStepFiles(folder, source.scenario, *replayed.step); };
    if (!Write(folder, write)) return ExitCode::kFailed;
    Print(fmt::format("  {}\n  step.svg, map.csv, votes.csv and points.csv in {}\n",
                      report::ChosenText(replayed.step->picture.view), folder.string()));
  }
  return ExitCode::kDone;
}

std::string Counted(const Replayed& replayed) {
  std::string text;
  if (replayed.scans > 0 || replayed.steps == 0) {
    text += fmt::format("  {} scans; --scan N draws one of them\n", replayed.scans);
  }
  if (replayed.steps > 0) {
    text += fmt::format("  {} steps; --step N draws one of them\n", replayed.steps);
  }
  return text;
}

// Of what was asked for and did not happen.
core::UserError Missing(const ReplayOptions& options, const Replayed& replayed) {
  const std::int64_t there = options.scan ? replayed.scans : replayed.steps;
  return {std::string(options.option()),
          fmt::format("{} {} does not occur in this trial", options.what(), options.number()),
          fmt::format("the trial has {} {}s{}; leave {} out to list them", there, options.what(),
                      truth::IsFault(replayed.record) ? " until its simulator fault" : "",
                      options.option())};
}

}  // namespace

ExitCode ShowViews(const ReplayOptions& options) {
  const campaign::TrialSource source = campaign::FindTrial(options.request);
  if (options.draws()) CheckFolder(FolderOf(options, source));
  const Replayed replayed = Replayer(options, source).Run();
  if (truth::IsFault(replayed.record)) PrintNote("simulator fault: " + replayed.record.detail);
  const ExitCode same = source.stored
                            ? TellRepetition(campaign::CompareWithStore(
                                  options.request, source, replayed.schema, replayed.record))
                            : ExitCode::kDone;
  if (!options.draws()) {
    Print(Counted(replayed));
    return same;
  }
  if (!replayed.failure.empty()) {
    PrintProblems({{std::string(options.option()),
                    "the images cannot be rendered: " + replayed.failure, ""}});
    return ExitCode::kFailed;
  }
  if (!replayed.scan && !replayed.step) throw Missing(options, replayed);
  const ExitCode written = WriteOutputs(options, source, replayed);
  return written == ExitCode::kDone ? same : written;
}

}  // namespace rockyard::app
