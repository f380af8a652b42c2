#include "campaign/replay_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "batch/trial_hash.h"
#include "campaign/trial_source.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "report/trace_view.h"
#include "rover/part_shapes.h"
#include "rover/rover_links.h"
#include "scenario/scenario.h"
#include "sensing/stereo_view.h"
#include "sensing/stripe_layout_params.h"
#include "statistics/drive_summary.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "trial/course/layout.h"
#include "vision/lens.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

using math::Vector3;

// Directions that are kept along each side of the image of a camera.
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

// Returns the light planes and cameras of the sensor that the scenario chooses, as they truly are;
// a sensor that cannot be drawn has neither.
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

// Returns the moment at which the rover was found stuck: the last one, or the one before a stall
// that runs on (referee.stuck_rover).
const truth::TraceSample& StuckMoment(const std::vector<replay::ReplayPose>& poses) {
  const bool runs_on = poses.size() > 1 && poses.back().sample.activity == "stall";
  return poses[poses.size() - (runs_on ? 2 : 1)].sample;
}

// Returns the events of the trace, and what motion and record tell beyond them: where turns in
// place begin, where the rover was found stuck, and a simulator fault, which the drive does not
// live to tell.
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

replay::ReplayData DataOf(const scenario::Scenario& scenario, const std::string& cell,
                          DriveRecording recording) {
  const truth::TracedTrial& traced = recording.traced;
  replay::ReplayData data;
  data.scenario = scenario.name;
  data.cell = cell;
  data.seed = traced.seed;
  data.record_hash = batch::TrialHash(std::span(&traced.record, 1));
  data.provenance = core::CurrentProvenance();
  data.schema = traced.schema;
  data.record = traced.record;
  AddScene(scenario, traced, data);
  data.rock_moves = traced.trace.rock_moves;
  data.links = LinksOf(scenario);
  data.sensor = SensorOf(scenario);
  data.poses = PosesOf(scenario, traced.trace);
  data.events = EventsOf(traced, data.poses);
  data.scans = std::move(recording.scans);
  data.steps = std::move(recording.steps);
  data.looks = std::move(recording.looks);
  data.overlays = std::move(recording.overlays);
  data.overlay_every = recording.overlay_every;
  return data;
}

ReplayedTrial ReplayTrial(const TrialSource& source, std::uint64_t trial) {
  DriveRecording recording = RecordDrive(source.scenario, source.seed, trial);
  const truth::TracedTrial traced = recording.traced;
  ReplayedTrial replayed;
  replay::ReplayData& data = replayed.data;
  data = DataOf(source.scenario, source.cell, std::move(recording));
  data.title = fmt::format("{}, seed {}, trial {}", source.scenario.name, source.seed, trial);
  if (source.stored) {
    data.repeats_stored =
        report::RecordDifferences(traced.schema, *source.stored, traced.record).empty();
  }
  data.command = ReplayCommandLine(source, trial);
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

namespace {

using replay::ReplayShape;
using replay::ShapeKind;

constexpr double kFinestStep_m = 0.1;
constexpr double kPlaneStep_m = 0.5;
constexpr double kStepGrowth = 1.25;

// Returns a rectangle that holds the terrain and all places of the rover.
terrain::Rectangle SceneBounds(const scenario::Scenario& scenario, const truth::Trace& trace) {
  constexpr double kBorder_m = 1.0;
  terrain::Rectangle bounds = terrain::DrivableBounds(scenario.drive.terrain.arena);
  for (const truth::TraceSample& sample : trace.samples) {
    bounds.x_min_m = std::min(bounds.x_min_m, sample.pose.x_m - kBorder_m);
    bounds.x_max_m = std::max(bounds.x_max_m, sample.pose.x_m + kBorder_m);
    bounds.y_min_m = std::min(bounds.y_min_m, sample.pose.y_m - kBorder_m);
    bounds.y_max_m = std::max(bounds.y_max_m, sample.pose.y_m + kBorder_m);
  }
  return bounds;
}

// Returns the designated goal; the true one where the record does not hold it, as that of a fault.
messages::Goal DesignatedGoal(const truth::TracedTrial& traced) {
  const auto x = statistics::ColumnIndex(traced.schema, "told_goal_x_m");
  const auto y = statistics::ColumnIndex(traced.schema, "told_goal_y_m");
  if (!x || !y || traced.record.values.empty()) return traced.goal;
  return {traced.record.values.at(*x), traced.record.values.at(*y)};
}

replay::ReplayCourse CourseOf(const scenario::Scenario& scenario, const truth::TracedTrial& traced,
                              const terrain::Terrain& terrain, const terrain::Rectangle& bounds) {
  const trial::CourseParams& course = scenario.drive.course;
  replay::ReplayCourse shown{.start = course.Start(),
                             .goal = traced.goal,
                             .goal_radius_m = course.goal_radius_m,
                             .told_goal = DesignatedGoal(traced),
                             .waypoints = course.waypoints.Places(),
                             .x_min_m = bounds.x_min_m,
                             .x_max_m = bounds.x_max_m,
                             .y_min_m = bounds.y_min_m,
                             .y_max_m = bounds.y_max_m,
                             .walls = {},
                             .mirror_lines_m = {}};
  for (const terrain::Wall& wall : terrain.walls()) {
    shown.walls.push_back({wall.normal_W, wall.offset_m});
  }
  const terrain::ArenaParams& arena = scenario.drive.terrain.arena;
  if (arena.kind == terrain::ArenaKind::kVirtualReflected) {
    shown.mirror_lines_m = {-arena.MirrorLine(), arena.MirrorLine()};
  }
  return shown;
}

replay::ReplayWorld WorldOf(const scenario::Scenario& scenario) {
  const trial::DriveParams& drive = scenario.drive;
  const terrain::ArenaParams& arena = drive.terrain.arena;
  const terrain::Rectangle bounds = terrain::ArenaBounds(arena);
  return {.gravity_m_s2 = drive.rover.physics.gravity_m_s2,
          .sun_elevation_rad = drive.sensors.sun.elevation_rad,
          .sun_azimuth_rad = drive.sensors.sun.azimuth_rad,
          .arena = std::string(
              core::EnumNames<terrain::ArenaKind>::kNames.at(static_cast<std::size_t>(arena.kind))),
          .x_min_m = bounds.x_min_m,
          .x_max_m = bounds.x_max_m,
          .y_min_m = bounds.y_min_m,
          .y_max_m = bounds.y_max_m,
          .mirror_line_m = arena.IsVirtual() ? arena.MirrorLine() : 0.0};
}

replay::ReplayGround GroundOf(const terrain::Ground& ground, const terrain::Rectangle& bounds) {
  const double width_m = bounds.x_max_m - bounds.x_min_m;
  const double depth_m = bounds.y_max_m - bounds.y_min_m;
  replay::ReplayGround grid{.x0_m = bounds.x_min_m, .y0_m = bounds.y_min_m, .z_m = {}};
  const auto points = [&](double extent_m) {
    return static_cast<std::size_t>(std::ceil(extent_m / grid.step_m)) + 1;
  };
  grid.step_m = ground.IsPlane() ? kPlaneStep_m : kFinestStep_m;
  while (points(width_m) * points(depth_m) > kMaxHeights) grid.step_m *= kStepGrowth;
  grid.nx = points(width_m);
  grid.ny = points(depth_m);
  grid.z_m.reserve(grid.nx * grid.ny);
  for (std::size_t iy = 0; iy < grid.ny; ++iy) {
    for (std::size_t ix = 0; ix < grid.nx; ++ix) {
      grid.z_m.push_back(ground.Height(grid.x0_m + static_cast<double>(ix) * grid.step_m,
                                       grid.y0_m + static_cast<double>(iy) * grid.step_m));
    }
  }
  return grid;
}

std::string_view NameOf(truth::BodyPart part) {
  switch (part) {
    case truth::BodyPart::kBelly:
      return "belly";
    case truth::BodyPart::kRocker:
      return "rocker";
    case truth::BodyPart::kHub:
      return "hub";
    case truth::BodyPart::kPanelEdge:
      return "panel";
    case truth::BodyPart::kWheel:
      return "wheel";
  }
  return "";
}

// Adds the shape of a part; corners add none, as they belong to boxes.
void AddShape(const rover::Part& part, replay::ReplayLink& link) {
  ReplayShape shape{.part = std::string(NameOf(part.kind)), .a_m = part.a_B};
  const math::Vector3 margin = math::Vector3::Constant(part.margin_m);
  switch (part.core) {
    case rover::Core::kPoint:
      return;
    case rover::Core::kSegment:
      shape.kind = part.a_B == part.b_B ? ShapeKind::kSphere : ShapeKind::kCapsule;
      shape.b_m = part.b_B;
      shape.radius_m = part.margin_m;
      break;
    case rover::Core::kCylinder:
      shape.kind = ShapeKind::kWheel;
      shape.radius_m = part.b_B.x() + part.margin_m;
      shape.width_m = 2.0 * (part.b_B.y() + part.margin_m);
      break;
    case rover::Core::kBox:
      shape.kind = ShapeKind::kBox;
      shape.b_m = 2.0 * (part.b_B + margin);
      break;
  }
  link.shapes.push_back(std::move(shape));
}

// Builds the field that the trial met: no record holds it, scenario and key give it again.
terrain::Field BuildField(const scenario::Scenario& scenario, const truth::TracedTrial& traced) {
  const core::TrialKey key{traced.seed, static_cast<std::uint32_t>(traced.record.trial)};
  try {
    return terrain::BuildField(scenario.drive.terrain, trial::LayoutKey(scenario.drive, key),
                               trial::TerrainCourse(scenario.drive.course));
  } catch (const std::runtime_error& error) {
    throw core::UserError(fmt::format("trial {}", traced.record.trial),
                          fmt::format("has no terrain to show: {}", error.what()),
                          "choose another trial");
  }
}

}  // namespace

void AddScene(const scenario::Scenario& scenario, const truth::TracedTrial& traced,
              replay::ReplayData& data) {
  const terrain::Field field = BuildField(scenario, traced);
  const terrain::Rectangle bounds = SceneBounds(scenario, traced.trace);
  data.course = CourseOf(scenario, traced, field.terrain, bounds);
  data.world = WorldOf(scenario);
  data.ground = GroundOf(field.terrain.ground(), bounds);
  for (const terrain::Rock& rock : field.terrain.rocks()) {
    data.rocks.push_back(
        {rock.center_W, rock.semi_axes_m, rock.yaw_rad, rock.height_m, rock.cap_growth});
  }
}

std::vector<replay::ReplayLink> LinksOf(const scenario::Scenario& scenario) {
  const std::vector<rover::Part> parts = rover::MakeParts(scenario.drive.rover.geometry);
  std::vector<replay::ReplayLink> shown;
  for (const rover::Link& link : rover::MakeLinks(scenario.drive.rover.geometry)) {
    replay::ReplayLink& to = shown.emplace_back(replay::ReplayLink{.name = link.name,
                                                                   .parent = link.parent,
                                                                   .pivot_P = link.pivot_P,
                                                                   .axis = link.axis,
                                                                   .shapes = {}});
    for (const rover::Part& part : parts) {
      if (part.body == link.body) AddShape(part, to);
    }
  }
  return shown;
}

}  // namespace rockyard::campaign
