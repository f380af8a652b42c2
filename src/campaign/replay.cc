#include "campaign/replay.h"

#include <fmt/format.h>

#include <exception>
#include <functional>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "campaign/looks/look_pictures.h"
#include "campaign/open_run.h"
#include "campaign/output_folder.h"
#include "campaign/replay_moments.h"
#include "campaign/replay_page.h"
#include "campaign/scan_capture.h"
#include "core/error.h"
#include "experiments/drive/drive_experiment.h"
#include "experiments/make_experiment.h"
#include "image_files/png_file.h"
#include "messages/point_cloud.h"
#include "report/atomic_file.h"
#include "report/navigation_drawing.h"
#include "report/scan_drawing.h"
#include "scenario/load.h"
#include "scenario/scenario.h"
#include "sensing/stereo_params.h"
#include "trial/eyes/terrain_sensor_set_params.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// What was driven: the trial, and the one beside it where the request names one.
struct Replayed {
  ReplayedTrial trial;
  std::optional<ReplayedTrial> beside = {};

  const ReplayedTrial* second() const { return beside ? &*beside : nullptr; }
  std::string title() const {
    return beside ? fmt::format("{}, and {}", trial.data.title, beside->data.title)
                  : trial.data.title;
  }
  std::string payload() const { return ReplayPayload(trial, second()); }
};

// One file that the request asks for.
struct AskedFile {
  std::string option;  // that names it
  std::string what;
  fs::path path;
  std::function<std::string(const Replayed&)> text;
};

// Returns what stands before the ending of a page: beside the folder of a run, and of a scenario
// where its run would lie.
std::string DefaultStem(const TrialRequest& request, const TrialSource& source) {
  const auto seed = static_cast<std::int64_t>(source.seed);
  std::error_code error;
  std::string stem = DefaultFolder(source.scenario.name, seed).string();
  if (fs::is_directory(request.source, error)) {
    stem = fs::path(request.source).lexically_normal().string();
    while (stem.size() > 1 && stem.ends_with('/')) stem.pop_back();
    if (!source.cell.empty()) stem += "-" + DefaultFolder(source.cell, seed).filename().string();
  }
  return fmt::format("{}-trial{}", stem, request.trial);
}

std::vector<AskedFile> OutputsOf(const ReplayRequest& request, const TrialSource& source) {
  const std::string stem = request.page.empty()
                               ? DefaultStem(request.trial, source)
                               : fs::path(request.page).replace_extension().string();
  const auto path = [&](const std::string& asked, const char* extension) {
    return asked.empty() ? fs::path(stem + extension) : fs::path(asked);
  };
  std::vector<AskedFile> outputs;
  outputs.push_back(
      {"--out", "3-D replay", path(request.page, ".html"), [](const Replayed& replayed) {
         return web::MakePage(web::Page::kReplay, replayed.title(), replayed.payload());
       }});
  outputs.push_back({"--svg", "plan view", path(request.plan, ".svg"),
                     [](const Replayed& replayed) { return replayed.trial.plan_svg; }});
  if (!request.data.empty()) {
    outputs.push_back({"--data", "data of the page", path(request.data, ".json"),
                       [](const Replayed& replayed) { return replayed.payload(); }});
  }
  return outputs;
}

// Throws where a file cannot be meant: before the drive rather than after it.
void CheckOutputs(const ReplayRequest& request, const std::vector<AskedFile>& outputs) {
  CheckOutputFile("--out", request.page);
  CheckExtension("--out", request.page, ".html");
  CheckOutputFile("--svg", request.plan);
  CheckOutputFile("--data", request.data);
  std::vector<NamedFile> files;
  files.reserve(outputs.size());
  for (const AskedFile& output : outputs) files.push_back({output.option, output.path.string()});
  CheckDistinct(files);
}

// Writes the files. Returns false where one cannot be written.
bool WriteOutputs(const std::vector<AskedFile>& outputs, const Replayed& replayed, Journal& journal,
                  std::vector<ReplayFile>& files) {
  try {
    for (const AskedFile& output : outputs) {
      if (output.path.has_parent_path()) fs::create_directories(output.path.parent_path());
      report::WriteFileAtomically(output.path, output.text(replayed));
      files.push_back({output.what, output.path});
    }
    return true;
  } catch (const core::UserError& failure) {
    journal.Fail(failure.problems());
  } catch (const fs::filesystem_error& failure) {
    journal.Fail(
        {{failure.path1().string(), failure.code().message(), "name another file with --out"}});
  }
  return false;
}

// Drives a trial again. The differences from its stored record, where it has one, are told.
ReplayedTrial DriveAgain(const TrialRequest& request, const TrialSource& source, Journal& journal,
                         std::optional<bool>& repeats_stored) {
  ReplayedTrial replayed = ReplayTrial(source, request.trial);
  if (!source.stored) return replayed;
  const auto differences =
      CompareWithStore(request, source, replayed.data.schema, replayed.data.record);
  repeats_stored = repeats_stored.value_or(true) && differences.empty();
  journal.Fail(differences);
  return replayed;
}

Outcome DriveAndWrite(const ReplayRequest& request, Journal& journal, ReplayResult& result) {
  const TrialSource source = FindTrial(request.trial);
  const std::optional<TrialSource> beside =
      request.beside ? std::optional(FindTrial(*request.beside)) : std::nullopt;
  const std::vector<AskedFile> outputs = OutputsOf(request, source);
  CheckOutputs(request, outputs);
  Replayed replayed{.trial = DriveAgain(request.trial, source, journal, result.repeats_stored)};
  if (beside) {
    replayed.beside = DriveAgain(*request.beside, *beside, journal, result.repeats_stored);
  }
  result.title = replayed.title();
  result.record = replayed.trial.data.record;
  if (!WriteOutputs(outputs, replayed, journal, result.files)) return Outcome::kFailed;
  return result.repeats_stored.value_or(true) ? Outcome::kDone : Outcome::kDiffers;
}

}  // namespace

ReplayResult Replay(const ReplayRequest& request, const Observer& observer) {
  ReplayResult result;
  static_cast<WorkResult&>(result) =
      Recorded(observer, [&](Journal& journal) { return DriveAndWrite(request, journal, result); });
  return result;
}

namespace {

// A decision of a map-based navigator, and the last points that it rests on.
struct CapturedStep {
  report::NavigationPicture picture;
  messages::PointCloud cloud;
  std::vector<CapturedLook> looks;  // on which it rests; none where there are no images
};

std::string FileStem(const messages::StripeExposure& frames) {
  return fmt::format("{}-group{}", frames.camera == 0 ? "left" : "right", frames.group);
}

void BeginFolder(const fs::path& folder, const scenario::Scenario& scenario) {
  fs::create_directories(folder);
  report::WriteFileAtomically(folder / "scenario.resolved.json", scenario::ResolvedJson(scenario));
}

bool HasStereoCameras(const scenario::Scenario& scenario) {
  const trial::DriveParams& drive = scenario.drive;
  return drive.sensors.terrain_sensors.chosen().cameras(drive) != nullptr;
}

// Makes the folder and writes PNG images of every exposure (lit, dark, difference), array.svg,
// points.csv and the scenario. WriteScanFiles and WriteStepFiles throw core::UserError or
// std::filesystem::filesystem_error.
void WriteScanFiles(const fs::path& folder, const scenario::Scenario& scenario,
                    const CapturedScan& captured) {
  BeginFolder(folder, scenario);
  for (const CapturedExposure& exposure : captured.exposures) {
    const auto write = [&](std::string_view what, const image_files::Picture& picture) {
      report::WriteFileAtomically(
          folder / fmt::format("{}-{}.png", FileStem(exposure.frames), what),
          image_files::EncodePng(picture));
    };
    write("lit", report::FramePicture(exposure.frames.lit.front()));
    write("dark", report::FramePicture(exposure.frames.dark.front()));
    write("difference",
          report::DifferencePicture(captured.view, exposure.frames, exposure.difference));
  }
  report::WriteFileAtomically(folder / "array.svg", report::ScanSvg(captured.view));
  report::WriteFileAtomically(folder / "points.csv", report::ScanCsv(captured.view));
}

// Makes the folder and writes step.svg, map.csv, votes.csv, points.csv and the scenario. For stereo
// cameras it writes what they saw, too, and returns these files (WriteLookFiles).
std::vector<LookFile> WriteStepFiles(const fs::path& folder, const scenario::Scenario& scenario,
                                     const CapturedStep& captured) {
  BeginFolder(folder, scenario);
  const messages::NavigationView& view = captured.picture.view;
  report::WriteFileAtomically(folder / "step.svg", report::NavigationSvg(captured.picture));
  report::WriteFileAtomically(folder / "map.csv", report::MapCsv(view.map));
  report::WriteFileAtomically(folder / "votes.csv", report::VotesCsv(view));
  report::WriteFileAtomically(folder / "points.csv", report::CloudCsv(captured.cloud));
  if (!captured.looks.empty()) return WriteLookFiles(folder, captured.looks, view);
  if (!HasStereoCameras(scenario)) return {};
  return WriteCloudFiles(folder, captured.cloud);
}

bool Draws(const MomentsRequest& request) { return request.scan || request.step; }
std::string_view OptionOf(const MomentsRequest& request) {
  return request.scan ? "--scan" : "--step";
}
std::string_view WordOfMoment(const MomentsRequest& request) {
  return request.scan ? "scan" : "step";
}
std::int64_t NumberOf(const MomentsRequest& request) {
  return request.scan ? *request.scan : request.step.value_or(0);
}

// The trial, and everything that can be shown of the moment that was asked for.
struct MomentTrial {
  truth::RecordSchema schema;
  truth::Record record;
  std::optional<CapturedScan> scan;
  std::optional<CapturedStep> step;
  std::string failure;  // why what was asked for cannot be shown
};

fs::path MomentFolder(const MomentsRequest& request, const TrialSource& source) {
  if (!request.folder.empty()) return request.folder;
  return fmt::format("{}-{}{}", DefaultStem(request.trial, source), WordOfMoment(request),
                     NumberOf(request));
}

// Throws where the folder holds something: pictures of two moments in one folder could not be told
// apart.
void RequireNewFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (fs::is_directory(folder, error) && fs::is_empty(folder, error)) return;
  throw core::UserError("--out", folder.string() + " exists and is no empty folder",
                        "name another folder");
}

class MomentReplayer {
 public:
  MomentReplayer(const MomentsRequest& request, const TrialSource& source,
                 const MomentsObserver& observer, MomentsResult& result)
      : request_(request), source_(source), observer_(observer), result_(result) {}

  MomentTrial Run() {
    trial::Watchers watchers{.scan = [this](const trial::WatchedScan& watched) { OnScan(watched); },
                             .step = [this](const trial::WatchedStep& watched) { OnStep(watched); },
                             .begin = [this] { result_.scans = result_.steps = 0; }};
    if (request_.step) {
      watchers.stereo = [this](const trial::WatchedStereo& watched) {
        looks_.Add(Capture(watched));
      };
    }
    const scenario::Scenario& scenario = source_.scenario;
    if (request_.step && scenario.experiment.chosen().name() == "drive") {
      RunTraced(experiments::DriveExperiment(scenario.drive, watchers));
    } else {
      RunPlain(*experiments::MakeExperiment(scenario.experiment, scenario.drive, watchers));
    }
    return std::move(replayed_);
  }

 private:
  // Runs the trial with its trace: a drawn step shows the path so far.
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
    std::vector<CapturedLook> looks = looks_.LooksOf(watched.cloud);
    if (request_.step != watched.view.step) return;
    replayed_.step = {{Title("step", watched.view.step), watched.view, SceneOf(watched, trace_)},
                      watched.cloud,
                      std::move(looks)};
  }

  const MomentsRequest& request_;
  const TrialSource& source_;
  const MomentsObserver& observer_;
  MomentsResult& result_;
  MomentTrial replayed_;
  // The trace of a drive of which a step is drawn, up to now.
  truth::Trace trace_;
  LookMemory looks_;
};

// Writes the files of a moment. Returns false where one cannot be written.
bool WriteMoment(const fs::path& folder, const TrialSource& source, const MomentTrial& replayed,
                 Journal& journal, MomentsResult& result) {
  try {
    if (replayed.scan) {
      WriteScanFiles(folder, source.scenario, *replayed.scan);
    } else {
      result.look_files = WriteStepFiles(folder, source.scenario, *replayed.step);
    }
    return true;
  } catch (const core::UserError& failure) {
    journal.Fail(failure.problems());
  } catch (const fs::filesystem_error& failure) {
    journal.Fail({{folder.string(), failure.code().message(), "name another folder with --out"}});
  }
  return false;
}

// Returns why there are no images of stereo cameras; "" where there are no cameras either.
std::string WhyNoImages(const scenario::Scenario& scenario) {
  const trial::DriveParams& drive = scenario.drive;
  const sensing::StereoParams* cameras = drive.sensors.terrain_sensors.chosen().cameras(drive);
  if (cameras == nullptr) return "";
  const auto fidelity = static_cast<std::size_t>(cameras->fidelity);
  return fmt::format("sensors.stereo.fidelity is {}, which has points and no images",
                     core::EnumNames<sensing::StereoFidelity>::kNames.at(fidelity));
}

// Returns the error about a moment that was asked for and did not happen.
core::UserError Missing(const MomentsRequest& request, const MomentsResult& result,
                        const truth::Record& record) {
  const std::int64_t there = request.scan ? result.scans : result.steps;
  return {
      std::string(OptionOf(request)),
      fmt::format("{} {} does not occur in this trial", WordOfMoment(request), NumberOf(request)),
      fmt::format("the trial has {} {}s{}; --list in place of {} lists them", there,
                  WordOfMoment(request), truth::IsFault(record) ? " until its simulator fault" : "",
                  OptionOf(request))};
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
  if (!WriteMoment(folder, source, replayed, journal, result)) return Outcome::kFailed;
  journal.SetFolder(folder);
  if (replayed.scan) result.scan = replayed.scan->view;
  if (!replayed.scan) {
    result.step = replayed.step->picture.view;
    if (replayed.step->looks.empty()) result.no_images = WhyNoImages(source.scenario);
  }
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
