#include "campaign/trial_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "campaign/looks/look_pictures.h"
#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "campaign/scan_capture.h"
#include "core/error.h"
#include "core/json_text.h"
#include "experiments/drive/drive_experiment.h"
#include "perception/triangulation.h"
#include "report/trace_view.h"
#include "rover/rover_links.h"
#include "scenario/load.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "terrain/field_export.h"
#include "trial/course/layout.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::campaign {
namespace {

// Returns the words of the request without the trial, which comes last.
std::string RequestWords(const TrialRequest& request) {
  std::string words = ShellPath(request.source);
  if (!request.cell.empty()) words += fmt::format(" --cell {}", ShellWord(request.cell));
  if (request.seed) words += fmt::format(" --seed {}", *request.seed);
  for (const std::string& assignment : request.overrides) {
    words += fmt::format(" --set {}", ShellWord(assignment));
  }
  return words;
}

TrialSource FromRun(const TrialRequest& request) {
  if (request.seed || !request.overrides.empty()) {
    throw core::UserError(
        request.seed ? "--seed" : "--set", "makes another trial than the one in the run's store",
        "name the scenario file, or a scenario.resolved.json, instead of the folder");
  }
  const StoredRun run = ReadRun(request.source, request.cell);
  const auto found = std::find_if(run.records.begin(), run.records.end(), [&](const auto& record) {
    return record.trial == request.trial;
  });
  const auto trial = static_cast<std::int64_t>(request.trial);
  if (found == run.records.end() && trial < run.planned && run.shard.Has(trial)) {
    return StoredTrial(request, run.identity, run.builds, std::nullopt);  // pending
  }
  if (found == run.records.end()) {
    throw core::UserError(
        "--trial", fmt::format("trial {} is not stored in {}", request.trial, run.Label()),
        fmt::format("use one of the {} finished trials, or name the scenario file instead",
                    run.records.size()));
  }
  return StoredTrial(request, run.identity, run.builds, *found);
}

TrialSource FromScenario(const TrialRequest& request) {
  if (!request.cell.empty()) {
    throw core::UserError("--cell", "is for the folder of a campaign, and this is a scenario",
                          "leave it out");
  }
  std::vector<std::string> overrides = request.overrides;
  if (request.seed) overrides.push_back(fmt::format("seed={}", *request.seed));
  TrialSource source;
  source.scenario = LoadScenarioFrom(request.source, overrides);
  source.seed = static_cast<std::uint64_t>(source.scenario.seed);
  source.request = RequestWords(request);
  return source;
}

}  // namespace

TrialSource FindTrial(const TrialRequest& request) {
  std::error_code error;
  if (std::filesystem::is_directory(request.source, error)) return FromRun(request);
  return FromScenario(request);
}

TrialSource StoredTrial(const TrialRequest& request, const batch::CellIdentity& cell,
                        std::vector<std::string> builds, std::optional<truth::Record> stored) {
  TrialSource source;
  source.scenario = ScenarioToDrive(cell.resolved, request.source);
  source.seed = cell.seed;
  source.cell = cell.name;
  source.request = RequestWords(request);
  source.stored = std::move(stored);
  source.builds = std::move(builds);
  return source;
}

std::string ReplayCommandLine(const TrialSource& source, std::uint64_t trial) {
  return fmt::format("rockyard replay {} --trial {}", source.request, trial);
}

std::vector<core::Problem> CompareWithStore(const TrialRequest& request, const TrialSource& source,
                                            const truth::RecordSchema& schema,
                                            const truth::Record& record) {
  const auto differences = report::RecordDifferences(schema, *source.stored, record);
  std::vector<core::Problem> problems;
  if (differences.empty()) return problems;
  problems.reserve(differences.size() + 1);
  for (const std::string& difference : differences) {
    problems.push_back({fmt::format("trial {}", request.trial), difference, ""});
  }
  const bool other_build =
      std::find(source.builds.begin(), source.builds.end(), BuildName()) == source.builds.end();
  problems.push_back({request.source, "this trial is not the stored one: the records differ",
                      other_build
                          ? "use the program that made the run: " + source.builds.front()
                          : "the same program made it: this is a defect, please report it"});
  return problems;
}

namespace {

// Records a drive. Points lie where the calibration that the rover believes puts them, as seen from
// its true pose: so a replay shows the error of a calibration beside the true rocks.
class Recorder {
 public:
  explicit Recorder(const scenario::Scenario& scenario)
      : scenario_(scenario),
        triangulator_(trial::OnboardStripeCalibration(scenario.drive.sensors.light_stripe,
                                                      scenario.drive.perception.calibration)) {}

  DriveRecording Run(std::uint64_t seed, std::uint64_t trial) {
    truth::TracedTrial& traced = recording_.traced;
    traced.scenario = scenario_.name;
    traced.seed = seed;
    traced.goal = {scenario_.drive.course.goal_x_m, scenario_.drive.course.goal_y_m};
    traced.schema = experiments::DriveSchema(scenario_.drive);
    const experiments::DriveExperiment experiment(
        scenario_.drive,
        {.scan = [this](const trial::WatchedScan& scan) { OnScan(scan); },
         .stereo = [this](const trial::WatchedStereo& look) { OnLook(look); },
         .step = [this](const trial::WatchedStep& step) { OnStep(step); },
         .overlay = [this](const trial::WatchedOverlay& shown) { OnOverlay(shown); },
         .begin = [this] { Begin(); }});
    traced.record = experiment.RunTraced(seed, trial, traced.trace);
    return std::move(recording_);
  }

 private:
  // The present time: the end of the trace, which grows while the trial runs.
  double now_s() const { return recording_.traced.trace.now_s(); }

  // The trace is begun anew by the drive itself.
  void Begin() {
    recording_.scans.clear();
    recording_.steps.clear();
    recording_.looks.clear();
    recording_.overlays.clear();
    recording_.overlay_every = 1;
    overlays_ = 0;
    overlay_bytes_ = 0;
  }

  void OnScan(const trial::WatchedScan& watched) {
    replay::ReplayScan scan{.time_s = now_s(),
                            .pose = math::ToPose2(watched.X_WR),
                            .points = {},
                            .hazards = HazardsOf(watched).stripe_hazard};
    const messages::StripeArraySize size = watched.scan.pixels.size();
    for (std::size_t row = 0; row < size.rows; ++row) {
      for (std::size_t stripe = 0; stripe < size.stripes; ++stripe) {
        AddPoint(watched, row, stripe, scan);
      }
    }
    recording_.scans.push_back(std::move(scan));
  }

  void AddPoint(const trial::WatchedScan& watched, std::size_t row, std::size_t stripe,
                replay::ReplayScan& scan) const {
    const messages::StripePixel& pixel = watched.scan.pixels[row][stripe];
    if (!pixel.detected) return;
    const auto p_RoP_R = triangulator_.Point(row, stripe, pixel.column_px);
    if (!p_RoP_R) return;
    const double height_m = triangulator_.Elevation(row, stripe, pixel.column_px).elevation_m;
    scan.points.push_back({watched.X_WR * *p_RoP_R, stripe, height_m});
  }

  void OnLook(const trial::WatchedStereo& watched) {
    recording_.looks.push_back(LookRecord(watched, now_s()));
  }

  void OnStep(const trial::WatchedStep& watched) {
    const messages::PoseEstimate& believed = watched.look.estimate;
    replay::ReplayStep step{.time_s = now_s(),
                            .look_time_s = watched.look.time_s,
                            .pose = math::ToPose2(watched.X_WR),
                            .look_believed = {believed.x_m, believed.y_m, believed.heading_rad},
                            .view = watched.view,
                            .points_W = {}};
    const std::vector<math::Vector3>& points_R = watched.cloud.points_R;
    const std::size_t kept = std::min(points_R.size(), kMaxStepPoints);
    step.points_W.reserve(kept);
    for (std::size_t i = 0; i < kept; ++i) {
      step.points_W.push_back(watched.X_WR * points_R[i * points_R.size() / kept]);
    }
    recording_.steps.push_back(std::move(step));
  }

  void OnOverlay(const trial::WatchedOverlay& watched) {
    const math::Pose2 pose = math::ToPose2(watched.X_WR);
    if (!watched.failure.empty()) {
      recording_.traced.trace.events.push_back(
          {watched.time_s, pose, "overlay", std::string(watched.failure)});
    }
    if (overlays_++ % recording_.overlay_every != 0) return;
    const messages::PoseEstimate& believed = watched.believed;
    recording_.overlays.push_back({.time_s = watched.time_s,
                                   .pose = pose,
                                   .believed = {believed.x_m, believed.y_m, believed.heading_rad},
                                   .shown = watched.overlay});
    overlay_bytes_ += BytesOf(watched.overlay);
    while (overlay_bytes_ > kMaxOverlayMemoryBytes && recording_.overlays.size() > 1) {
      LeaveOutOverlays();
    }
  }

  static std::size_t BytesOf(const messages::Overlay& overlay) {
    std::size_t bytes = 0;
    for (const messages::OverlayLine& line : overlay.lines) {
      bytes += sizeof(line) + line.points.size() * sizeof(messages::Goal);
    }
    for (const messages::OverlayGrid& grid : overlay.grids) {
      bytes += sizeof(grid) + grid.values.size() * sizeof(double);
    }
    return bytes;
  }

  // Leaves out every second overlay.
  void LeaveOutOverlays() {
    std::vector<replay::ReplayOverlay>& overlays = recording_.overlays;
    overlay_bytes_ = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < overlays.size(); i += 2) {
      overlay_bytes_ += BytesOf(overlays[i].shown);
      if (i != kept) overlays[kept] = std::move(overlays[i]);
      ++kept;
    }
    overlays.resize(kept);
    recording_.overlay_every *= 2;
  }

  const scenario::Scenario& scenario_;
  const perception::Triangulator triangulator_;
  DriveRecording recording_;
  std::size_t overlays_ = 0;       // that the drive had so far
  std::size_t overlay_bytes_ = 0;  // of those that are kept
};

}  // namespace

DriveRecording RecordDrive(const scenario::Scenario& scenario, std::uint64_t seed,
                           std::uint64_t trial) {
  if (scenario.experiment.chosen().name() != "drive") {
    throw core::UserError(scenario.name, "is no drive, and only drives have a course",
                          "use rockyard replay --list, which lists the scans of any trial");
  }
  return Recorder(scenario).Run(seed, trial);
}

std::vector<replay::ReplayPose> PosesOf(const scenario::Scenario& scenario,
                                        const truth::Trace& trace) {
  const std::vector<rover::Link> links = rover::MakeLinks(scenario.drive.rover.geometry);
  std::vector<replay::ReplayPose> poses;
  poses.reserve(trace.samples.size() + trace.rests.size());
  const auto add = [&](const truth::TraceSample& sample, bool set_back) {
    replay::ReplayPose pose{sample, {}, set_back};
    for (const rover::Link& link : links) {
      if (link.parent >= 0) pose.joint_rad.push_back(rover::JointAngle(link, sample.posture));
    }
    poses.push_back(std::move(pose));
  };
  auto rest = trace.rests.begin();
  const auto rests_before = [&](std::size_t samples) {
    for (; rest != trace.rests.end() && rest->samples_before <= samples; ++rest) {
      add(rest->sample, rest->set_back);
    }
  };
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    rests_before(i);
    add(trace.samples[i], false);
  }
  rests_before(trace.samples.size());
  return poses;
}

std::string PlanView(const scenario::Scenario& scenario, const truth::TracedTrial& traced) {
  const terrain::Rectangle all = terrain::DrivableBounds(scenario.drive.terrain.arena);
  const report::TraceDrawing drawing =
      report::DrawTrace(traced, {all.x_min_m, all.x_max_m, all.y_min_m, all.y_max_m});
  const report::DrawnArea& area = drawing.area;
  const terrain::Course course = trial::TerrainCourse(scenario.drive.course);
  const core::TrialKey key{traced.seed, static_cast<std::uint32_t>(traced.record.trial)};
  const terrain::Field field =
      terrain::BuildField(scenario.drive.terrain, trial::LayoutKey(scenario.drive, key), course);
  return terrain::ToSvg(
      field, scenario.drive.terrain, course,
      {drawing.elements, {area.x_min_m, area.x_max_m, area.y_min_m, area.y_max_m}});
}

}  // namespace rockyard::campaign
