#include "campaign/replay_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "rover/part_shapes.h"
#include "rover/rover_links.h"
#include "statistics/drive_summary.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "trial/course/layout.h"

namespace rockyard::campaign {
namespace {

using replay::ReplayShape;
using replay::ShapeKind;

constexpr double kFinestStep_m = 0.1;
constexpr double kPlaneStep_m = 0.5;
constexpr double kStepGrowth = 1.25;

// Where there is terrain, and wherever the rover went.
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

// The designated goal, which a fault's record does not hold.
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

// Nothing for corners, which belong to boxes.
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
