// The JSON text of a replay page (ReplayJson), as src/web/replay/payload.ts says; world, terrain
// sensor, and the pieces that payload_text.h declares.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_pieces.h"
#include "replay/data.h"
#include "replay/payload_text.h"
#include "truth/end_cause.h"

namespace rockyard::replay {
namespace {

using core::JsonList;
using core::JsonObject;

// Pages read numbers as doubles, in which larger integers lose digits: such a seed is written as
// text.
constexpr std::uint64_t kMaxExactInteger = std::uint64_t{1} << 53;

std::string RecordText(const ReplayData& data) {
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < std::min(data.schema.size(), data.record.values.size()); ++i) {
    columns.push_back(JsonObject()
                          .AddText("name", data.schema[i].name)
                          .AddText("unit", data.schema[i].unit)
                          .AddNumber("value", data.record.values[i])
                          .Text());
  }
  return JsonList(columns);
}

std::string CourseText(const ReplayCourse& course) {
  return JsonObject()
      .Add("start", PoseText(course.start))
      .Add("goal", JsonObject()
                       .Add("x", Length(course.goal.x_m))
                       .Add("y", Length(course.goal.y_m))
                       .Add("radius", Length(course.goal_radius_m))
                       .Text())
      .Add("told_goal", JsonObject()
                            .Add("x", Length(course.told_goal.x_m))
                            .Add("y", Length(course.told_goal.y_m))
                            .Text())
      .Add("waypoints",
           JsonList(
               course.waypoints,
               [](const messages::Goal& place) {
                 return JsonObject().Add("x", Length(place.x_m)).Add("y", Length(place.y_m)).Text();
               }))
      .Add("bounds", JsonObject()
                         .Add("x_min", Length(course.x_min_m))
                         .Add("x_max", Length(course.x_max_m))
                         .Add("y_min", Length(course.y_min_m))
                         .Add("y_max", Length(course.y_max_m))
                         .Text())
      .Add("walls", JsonList(course.walls,
                             [](const ReplayWall& wall) {
                               return JsonObject()
                                   .Add("nx", Angle(wall.normal_W.x()))
                                   .Add("ny", Angle(wall.normal_W.y()))
                                   .Add("offset", Length(wall.offset_m))
                                   .Text();
                             }))
      .Add("mirror_lines", JsonList(course.mirror_lines_m, Length))
      .Text();
}

std::string GroundText(const ReplayGround& ground) {
  return JsonObject()
      .Add("x0", Length(ground.x0_m))
      .Add("y0", Length(ground.y0_m))
      .AddNumber("step", ground.step_m)
      .AddInteger("nx", static_cast<std::int64_t>(ground.nx))
      .AddInteger("ny", static_cast<std::int64_t>(ground.ny))
      .Add("z", JsonList(ground.z_m, Length))
      .Text();
}

std::string RockText(const ReplayRock& rock) {
  JsonObject object;
  object.Add("x", Length(rock.center_W.x()))
      .Add("y", Length(rock.center_W.y()))
      .Add("z", Length(rock.center_W.z()))
      .Add("a", Length(rock.semi_axes_m.x()))
      .Add("b", Length(rock.semi_axes_m.y()))
      .Add("c", Length(rock.semi_axes_m.z()))
      .Add("yaw", Angle(rock.yaw_rad))
      .Add("height", Length(rock.height_m));
  if (rock.cap_growth > 0.0) object.AddNumber("growth", rock.cap_growth);
  return object.Text();
}

std::string MoveText(const truth::RockMove& move) {
  return JsonObject()
      .AddInteger("rock", move.rock)
      .Add("t", Length(move.time_s))
      .Add("x", Length(move.center_W.x()))
      .Add("y", Length(move.center_W.y()))
      .Add("z", Length(move.center_W.z()))
      .Text();
}

std::string ShapeText(const ReplayShape& shape) {
  constexpr std::array<std::string_view, 4> kKinds{"box", "wheel", "capsule", "sphere"};
  JsonObject object;
  object.AddText("kind", kKinds.at(static_cast<std::size_t>(shape.kind)))
      .AddText("part", shape.part);
  switch (shape.kind) {
    case ShapeKind::kBox:
      return object.Add("center", Point(shape.a_m)).Add("size", Point(shape.b_m)).Text();
    case ShapeKind::kWheel:
      return object.Add("center", Point(shape.a_m))
          .Add("radius", Length(shape.radius_m))
          .Add("width", Length(shape.width_m))
          .Text();
    case ShapeKind::kCapsule:
      return object.Add("from", Point(shape.a_m))
          .Add("to", Point(shape.b_m))
          .Add("radius", Length(shape.radius_m))
          .Text();
    case ShapeKind::kSphere:
      break;
  }
  return object.Add("center", Point(shape.a_m)).Add("radius", Length(shape.radius_m)).Text();
}

std::string LinkText(const ReplayLink& link) {
  return JsonObject()
      .AddText("name", link.name)
      .AddInteger("parent", link.parent)
      .Add("pivot", Point(link.pivot_P))
      .Add("axis", Point(link.axis))
      .Add("shapes", JsonList(link.shapes, ShapeText))
      .Text();
}

std::string_view SettingOfEnd(const truth::Record& record) {
  const auto cause = truth::CauseOf(record);
  return cause ? truth::Info(*cause).setting : std::string_view();
}

}  // namespace

std::string ReplayJson(const ReplayData& data, const ReplayData* beside) {
  JsonObject object;
  object.AddInteger("version", 1)
      .AddText("title", data.title)
      .AddText("scenario", data.scenario)
      .AddText("cell", data.cell);
  if (data.seed < kMaxExactInteger) {
    object.AddInteger("seed", static_cast<std::int64_t>(data.seed));
  } else {
    object.AddText("seed", std::to_string(data.seed));
  }
  object.AddInteger("trial", static_cast<std::int64_t>(data.record.trial))
      .AddText("outcome", truth::Name(data.record.outcome))
      .AddText("detail", data.record.detail)
      .AddText("cause_setting", SettingOfEnd(data.record))
      .Add("repeats_stored",
           !data.repeats_stored ? "null" : (*data.repeats_stored ? "true" : "false"))
      .AddText("record_hash", data.record_hash)
      .AddText("command", data.command)
      .Add("provenance", ProvenanceText(data.provenance))
      .Add("record", RecordText(data))
      .Add("course", CourseText(data.course))
      .Add("world", WorldJson(data.world))
      .Add("ground", GroundText(data.ground))
      .Add("rocks", JsonList(data.rocks, RockText))
      .Add("rock_moves", JsonList(data.rock_moves, MoveText))
      .Add("rover", JsonObject().Add("links", JsonList(data.links, LinkText)).Text())
      .Add("sensor", SensorJson(data.sensor))
      .Add("motion", MotionJson(data.links, data.poses))
      .Add("scans", ScansJson(data.scans))
      .Add("steps", StepsJson(data.steps))
      .Add("eyes", EyesJson(data.looks))
      .Add("overlays", OverlaysJson(data.overlays, data.overlay_every))
      .Add("events", EventsJson(data.events))
      .Add("beside", beside == nullptr ? "null" : ReplayJson(*beside));
  return object.Text();
}

namespace {

std::string Direction(const math::Vector3& unit) {
  return JsonList(std::array{Angle(unit.x()), Angle(unit.y()), Angle(unit.z())});
}

std::string LaserText(const ReplayLaser& laser) {
  return JsonObject()
      .Add("emitter", Point(laser.emitter_R))
      .Add("normal", Direction(laser.normal_R))
      .Add("axis", Direction(laser.axis_R))
      .Add("half_fan", Angle(laser.half_fan_rad))
      .Text();
}

std::string CameraText(const ReplayCamera& camera) {
  return JsonObject()
      .AddText("name", camera.name)
      .Add("eye", Point(camera.eye_R))
      .Add("rim", JsonList(camera.rim_R, Direction))
      .Text();
}

}  // namespace

std::string WorldJson(const ReplayWorld& world) {
  return JsonObject()
      .AddNumber("gravity", world.gravity_m_s2)
      .Add("sun", JsonObject()
                      .Add("elevation", Angle(world.sun_elevation_rad))
                      .Add("azimuth", Angle(world.sun_azimuth_rad))
                      .Text())
      .Add("arena", JsonObject()
                        .AddText("kind", world.arena)
                        .Add("x_min", Length(world.x_min_m))
                        .Add("x_max", Length(world.x_max_m))
                        .Add("y_min", Length(world.y_min_m))
                        .Add("y_max", Length(world.y_max_m))
                        .Add("mirror_line", Length(world.mirror_line_m))
                        .Text())
      .Text();
}

std::string SensorJson(const ReplaySensor& sensor) {
  return JsonObject()
      .AddText("name", sensor.name)
      .Add("reach", Length(sensor.reach_m))
      .Add("lasers", JsonList(sensor.lasers, LaserText))
      .Add("cameras", JsonList(sensor.cameras, CameraText))
      .Text();
}

namespace {

using core::JsonNumber;

constexpr double kLengthDigits = 1e4;
constexpr double kAngleDigits = 1e5;

}  // namespace

std::string Rounded(double value, double digits) {
  const double rounded = std::round(value * digits) / digits;
  return JsonNumber(rounded == 0.0 ? 0.0 : rounded);
}

std::string Length(double value_m) { return Rounded(value_m, kLengthDigits); }
std::string Angle(double value_rad) { return Rounded(value_rad, kAngleDigits); }

std::string Point(const math::Vector3& p) {
  return JsonList(std::array{Length(p.x()), Length(p.y()), Length(p.z())});
}

JsonObject& AddPose(JsonObject& object, const math::Pose2& pose) {
  return object.Add("x", Length(pose.x_m))
      .Add("y", Length(pose.y_m))
      .Add("heading", Angle(pose.heading_rad));
}

std::string PoseText(const math::Pose2& pose) {
  JsonObject object;
  return AddPose(object, pose).Text();
}

std::string ProvenanceText(const core::Provenance& p) {
  return JsonObject()
      .AddText("version", p.version)
      .AddText("commit", p.commit)
      .AddText("compiler", p.compiler)
      .AddText("flags", p.flags)
      .AddText("build_type", p.build_type)
      .AddText("host", p.host)
      .AddText("cpu_level", p.cpu_level)
      .Text();
}

}  // namespace rockyard::replay
