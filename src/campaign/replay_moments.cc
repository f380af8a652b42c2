#include "campaign/replay_moments.h"

#include <fmt/format.h>

#include <exception>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "campaign/replay_files.h"
#include "campaign/scan_capture.h"
#include "campaign/step_scene.h"
#include "core/error.h"
#include "experiments/drive/drive_experiment.h"
#include "experiments/experiment.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

bool Draws(const MomentsRequest& request) { return request.scan || request.step; }
std::string_view OptionOf(const MomentsRequest& request) {
  return request.scan ? "--scan" : "--step";
}
std::string_view KindOf(const MomentsRequest& request) { return request.scan ? "scan" : "step"; }
std::int64_t NumberOf(const MomentsRequest& request) {
  return request.scan ? *request.scan : request.step.value_or(0);
}

// The trial, and of the moment that was asked for everything that can be shown.
struct MomentTrial {
  truth::RecordSchema schema;
  truth::Record record;
  std::optional<CapturedScan> scan;
  std::optional<CapturedStep> step;
  std::string failure;  // why what was asked for cannot be shown
};

fs::path MomentFolder(const MomentsRequest& request, const TrialSource& source) {
  if (!request.folder.empty()) return request.folder;
  return fs::path("results") / "runs" /
         fmt::format("{}-seed{}-trial{}-{}{}", source.scenario.name, source.seed,
                     request.trial.trial, KindOf(request), NumberOf(request));
}

// Pictures of two moments in one folder would be told apart by nothing.
void RequireNewFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (fs::is_directory(folder, error) && fs::is_empty(folder, error)) return;
  throw core::UserError("--out", folder.string() + " exists and is no empty folder",
                        "name another folder, or remove it");
}

class MomentReplayer {
 public:
  MomentReplayer(const MomentsRequest& request, const TrialSource& source,
                 const MomentsObserver& observer, MomentsResult& result)
      : request_(request), source_(source), observer_(observer), result_(result) {}

  MomentTrial Run() {
    const auto on_scan = [this](const trial::WatchedScan& watched) { OnScan(watched); };
    const auto on_step = [this](const trial::WatchedStep& watched) { OnStep(watched); };
    const scenario::Scenario& scenario = source_.scenario;
    if (request_.step && scenario.experiment.kind == experiments::ExperimentKind::kDrive) {
      RunTraced(experiments::DriveExperiment(scenario.drive, on_scan, on_step));
    } else {
      RunPlain(*experiments::MakeExperiment(scenario.experiment, scenario.drive, on_scan, on_step));
    }
    return std::move(replayed_);
  }

 private:
  // A drawn step shows the path so far.
  void RunTraced(const experiments::DriveExperiment& drive) {
    replayed_.schema = drive.schema();
    replayed_.record = drive.RunTraced(source_.seed, request_.trial.trial, trace_);
  }

  void RunPlain(const experiments::Experiment& experiment) {
    replayed_.schema = experiment.schema();
    replayed_.record = experiment.Run(source_.seed, request_.trial.trial);
  }

  std::string Title(std::string_view what, std::int64_t number) const {
    return fmt::format("{}, seed {}, trial {}, {} {}", source_.scenario.name, source_.seed,
                       request_.trial.trial, what, number);
  }

  void OnScan(const trial::WatchedScan& watched) {
    const std::int64_t number = result_.scans++;
    if (!Draws(request_) && observer_.scan) {
      const auto hazards = HazardsOf(watched).stripe_hazard;
      observer_.scan(
          {number, math::ToPose2(watched.X_WR), std::vector<bool>(hazards.begin(), hazards.end())});
    }
    if (request_.scan != number) return;
    // A picture that fails must not become a fault of the trial.
    try {
      replayed_.scan = Capture(watched);
      replayed_.scan->view.title = Title("scan", number);
    } catch (const std::exception& error) {
      replayed_.failure = error.what();
    }
  }

  void OnStep(const trial::WatchedStep& watched) {
    ++result_.steps;
    if (!Draws(request_) && observer_.step) {
      observer_.step({math::ToPose2(watched.X_WR), watched.view});
    }
    if (request_.step != watched.view.step) return;
    replayed_.step = {{Title("step", watched.view.step), watched.view, SceneOf(watched, trace_)},
                      watched.cloud};
  }

  const MomentsRequest& request_;
  const TrialSource& source_;
  const MomentsObserver& observer_;
  MomentsResult& result_;
  MomentTrial replayed_;
  truth::Trace trace_;  // of a drive of which a step is drawn, up to now
};

// False where a file cannot be written.
bool WriteMoment(const fs::path& folder, const TrialSource& source, const MomentTrial& replayed,
                 Journal& journal) {
  try {
    if (replayed.scan) {
      WriteScanFiles(folder, source.scenario, *replayed.scan);
    } else {
      WriteStepFiles(folder, source.scenario, *replayed.step);
    }
    return true;
  } catch (const core::UserError& failure) {
    journal.Fail(failure.problems());
  } catch (const fs::filesystem_error& failure) {
    journal.Fail({{folder.string(), failure.code().message(), "name another folder with --out"}});
  }
  return false;
}

// Of what was asked for and did not happen.
core::UserError Missing(const MomentsRequest& request, const MomentsResult& result,
                        const truth::Record& record) {
  const std::int64_t there = request.scan ? result.scans : result.steps;
  return {
      std::string(OptionOf(request)),
      fmt::format("{} {} does not occur in this trial", KindOf(request), NumberOf(request)),
      fmt::format("the trial has {} {}s{}; leave {} out to list them", there, KindOf(request),
                  truth::IsFault(record) ? " until its simulator fault" : "", OptionOf(request))};
}

Outcome Draw(const MomentsRequest& request, const TrialSource& source, const MomentTrial& replayed,
             Journal& journal, MomentsResult& result) {
  if (!replayed.failure.empty()) {
    journal.Fail({{std::string(OptionOf(request)),
                   "the images cannot be rendered: " + replayed.failure, ""}});
    return Outcome::kFailed;
  }
  if (!replayed.scan && !replayed.step) throw Missing(request, result, replayed.record);
  const fs::path folder = MomentFolder(request, source);
  if (!WriteMoment(folder, source, replayed, journal)) return Outcome::kFailed;
  journal.SetFolder(folder);
  if (replayed.scan) result.scan = replayed.scan->view;
  if (!replayed.scan) result.step = replayed.step->picture.view;
  return Outcome::kDone;
}

Outcome RunMoments(const MomentsRequest& request, const MomentsObserver& observer, Journal& journal,
                   MomentsResult& result) {
  const TrialSource source = FindTrial(request.trial);
  if (Draws(request)) RequireNewFolder(MomentFolder(request, source));
  const MomentTrial replayed = MomentReplayer(request, source, observer, result).Run();
  if (truth::IsFault(replayed.record)) journal.Warn("simulator fault: " + replayed.record.detail);
  if (source.stored) {
    const auto differences =
        CompareWithStore(request.trial, source, replayed.schema, replayed.record);
    result.repeats_stored = differences.empty();
    journal.Fail(differences);
  }
  if (Draws(request)) {
    const Outcome drawn = Draw(request, source, replayed, journal, result);
    if (drawn != Outcome::kDone) return drawn;
  }
  return result.repeats_stored.value_or(true) ? Outcome::kDone : Outcome::kDiffers;
}

}  // namespace

MomentsResult ReplayMoments(const MomentsRequest& request, const MomentsObserver& observer) {
  MomentsResult result;
  static_cast<WorkResult&>(result) = Recorded(
      observer, [&](Journal& journal) { return RunMoments(request, observer, journal, result); });
  return result;
}

}  // namespace rockyard::campaign
