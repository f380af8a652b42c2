// Where a replayed drive takes place and what its terrain sensor sees, as JSON.
#include <array>

#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

using core::JsonList;
using core::JsonObject;

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

}  // namespace rockyard::replay
