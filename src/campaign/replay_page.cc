#include "campaign/replay_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "batch/trial_hash.h"
#include "campaign/drive_recording.h"
#include "campaign/replay_scene.h"
#include "report/atomic_file.h"
#include "report/trace_view.h"
#include "scenario/scenario.h"
#include "sensing/stereo_view.h"
#include "sensing/stripe_layout_params.h"
#include "vision/lens.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

using math::Vector3;

// Directions that are kept along each side of a camera's image.
constexpr int kRimRaysOfASide = 6;

constexpr std::string_view kLightStripe = "light_stripe";

// Calls ray(u, v) once around the unit square, from the upper left corner along the upper edge.
template <typename Ray>
std::vector<Vector3> Rim(Ray ray) {
  std::vector<Vector3> rim;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < kRimRaysOfASide; ++i) {
      const double share = static_cast<double>(i) / kRimRaysOfASide;
      const std::array<double, 4> u{share, 1.0, 1.0 - share, 0.0};
      const std::array<double, 4> v{0.0, share, 1.0, 1.0 - share};
      const auto at = static_cast<std::size_t>(side);
      rim.push_back(ray(u.at(at), v.at(at)));
    }
  }
  return rim;
}

replay::ReplayCamera StripeCamera(const messages::Camera& camera, const char* name) {
  const auto ray = [&](double u, double v) -> Vector3 {
    const vision::PixelPosition pixel{(u - 0.5) * camera.columns, (v - 0.5) * camera.rows};
    return camera.X_RC.linear() * vision::PixelRay(camera, pixel);
  };
  return {name, camera.X_RC.translation(), Rim(ray)};
}

void AddStereoPair(const sensing::StereoParams& params, messages::LookDirection direction,
                   const std::string& where, replay::ReplaySensor& sensor) {
  const sensing::StereoView view = sensing::MakeStereoView(params, direction);
  // The edges of the outer pixels.
  const auto ray = [&](double u, double v) -> Vector3 {
    return view.Ray(u * view.columns - 0.5, v * view.rows - 0.5).normalized();
  };
  const std::vector<Vector3> rim = Rim(ray);
  if (view.baseline_m == 0.0) {
    sensor.cameras.push_back({where, view.eye, rim});
    return;
  }
  sensor.cameras.push_back({where + " left", view.eye, rim});
  sensor.cameras.push_back({where + " right", view.right_eye, rim});
}

void AddLightStripe(const sensing::LightStripeParams& params, replay::ReplaySensor& sensor) {
  const messages::StripeCalibration calibration = sensing::TrueCalibration(params);
  sensor.reach_m = params.max_range_m;
  for (const messages::StripeLaser& laser : calibration.lasers) {
    sensor.lasers.push_back({laser.p_RoE_R, laser.normal_R, laser.axis_R, laser.half_fan_rad});
  }
  sensor.cameras = {StripeCamera(calibration.cameras[0], "camera 1"),
                    StripeCamera(calibration.cameras[1], "camera 2")};
}

// The light planes and cameras of the sensor that the scenario chooses, as they truly are; neither
// where it has none that can be drawn.
replay::ReplaySensor SensorOf(const scenario::Scenario& scenario) {
  const trial::DriveParams& drive = scenario.drive;
  const trial::TerrainSensorKind& chosen = drive.sensors.terrain_sensors.chosen();
  replay::ReplaySensor sensor;
  sensor.name = chosen.name();
  if (const sensing::StereoParams* stereo = chosen.cameras(drive)) {
    sensor.reach_m = stereo->max_range_m;
    AddStereoPair(*stereo, messages::LookDirection::kAhead, "ahead", sensor);
    AddStereoPair(*stereo, messages::LookDirection::kBehind, "behind", sensor);
  } else if (sensor.name == kLightStripe) {
    AddLightStripe(drive.sensors.light_stripe, sensor);
  }
  return sensor;
}

// The moment at which the rover was found stuck: the last one, or the one before a stall that runs
// on (referee.stuck_rover).
const truth::TraceSample& StuckMoment(const std::vector<replay::ReplayPose>& poses) {
  const bool runs_on = poses.size() > 1 && poses.back().sample.activity == "stall";
  return poses[poses.size() - (runs_on ? 2 : 1)].sample;
}

// What motion and record tell beyond the events of the trace: where turns in place begin, where the
// rover was found stuck, and a simulator fault, which the drive does not live to tell.
std::vector<truth::TraceEvent> EventsOf(const truth::TracedTrial& traced,
                                        const std::vector<replay::ReplayPose>& poses) {
  std::vector<truth::TraceEvent> events;
  if (truth::IsStuck(traced.record.outcome) && !poses.empty()) {
    const truth::TraceSample& stuck = StuckMoment(poses);
    events.push_back({stuck.time_s, stuck.pose, "stall", ""});
  }
  events.insert(events.end(), traced.trace.events.begin(), traced.trace.events.end());
  std::string before;
  double since_s = 0.0;  // the end of the stretch before
  for (const replay::ReplayPose& pose : poses) {
    const std::string& activity = pose.sample.activity;
    if (activity != before && activity == "turn") {
      events.push_back({since_s, pose.sample.pose, activity, ""});
    }
    if (!activity.empty()) before = activity;
    since_s = pose.sample.time_s;
  }
  if (truth::IsFault(traced.record) && !poses.empty()) {
    events.push_back({since_s, poses.back().sample.pose, "end", traced.record.detail});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return events;
}

}  // namespace

ReplayedTrial ReplayTrial(const TrialSource& source, std::uint64_t trial) {
  DriveRecording recording = RecordDrive(source.scenario, source.seed, trial);
  const truth::TracedTrial& traced = recording.traced;
  ReplayedTrial replayed;
  replay::ReplayData& data = replayed.data;
  data.title = fmt::format("{}, seed {}, trial {}", source.scenario.name, source.seed, trial);
  data.scenario = source.scenario.name;
  data.cell = source.cell;
  data.seed = source.seed;
  if (source.stored) {
    data.repeats_stored =
        report::RecordDifferences(traced.schema, *source.stored, traced.record).empty();
  }
  data.record_hash = batch::TrialHash(std::span(&traced.record, 1));
  data.command = ReplayCommandLine(source, trial);
  data.provenance = core::CurrentProvenance();
  data.schema = traced.schema;
  data.record = traced.record;
  AddScene(source.scenario, traced, data);
  data.rock_moves = traced.trace.rock_moves;
  data.links = LinksOf(source.scenario);
  data.sensor = SensorOf(source.scenario);
  data.poses = PosesOf(source.scenario, traced.trace);
  data.events = EventsOf(traced, data.poses);
  data.scans = std::move(recording.scans);
  data.steps = std::move(recording.steps);
  data.looks = std::move(recording.looks);
  replayed.plan_svg = PlanView(source.scenario, traced);
  return replayed;
}

std::string ReplayPayload(const ReplayedTrial& replayed, const ReplayedTrial* beside) {
  return replay::ReplayJson(replayed.data, beside == nullptr ? nullptr : &beside->data);
}

bool WriteReplayPage(const TrialSource& source, std::uint64_t trial,
                     const std::filesystem::path& path) {
  const ReplayedTrial replayed = ReplayTrial(source, trial);
  if (!replayed.data.repeats_stored.value_or(true)) return false;
  report::WriteFileAtomically(
      path, web::MakePage(web::Page::kReplay, replayed.data.title, ReplayPayload(replayed)));
  return true;
}

}  // namespace rockyard::campaign
