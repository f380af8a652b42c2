#include "plugin/messages_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "core/base64.h"
#include "core/numbers.h"
#include "navigation/navigator_fault.h"

namespace rockyard::plugin {
namespace {

using core::JsonValue;
using navigation::FaultKind;
using navigation::NavigatorFault;

// In the order of the bits of navigation::Event.
constexpr std::array<std::string_view, 13> kEvents{
    "tick",        "start",      "look", "manoeuvre", "period",       "near_goal", "end_of_plan",
    "pose_update", "correction", "goal", "hazard",    "touch_behind", "stuck"};
// In the order of the enumerations.
constexpr std::array<std::string_view, 5> kHazards{"contact", "tilt", "articulation",
                                                   "motor_current", "slip"};
constexpr std::array<std::string_view, 4> kSides{"left", "ahead", "right", "behind"};
constexpr std::array<std::string_view, 4> kStatuses{"driving", "arrived", "gave_up", "stuck"};
constexpr std::array<std::string_view, 3> kMotions{"stop", "arc", "turn"};
constexpr std::array<std::string_view, 2> kDirections{"ahead", "behind"};

template <typename Enum, std::size_t kCount>
JsonValue NameOf(const std::array<std::string_view, kCount>& names, Enum value) {
  return JsonValue(names[static_cast<std::size_t>(value)]);
}

JsonValue AttitudeToJson(const messages::AttitudeEstimate& attitude) {
  return JsonValue::Object({{"roll_rad", JsonValue(attitude.roll_rad)},
                            {"pitch_rad", JsonValue(attitude.pitch_rad)},
                            {"z_m", JsonValue(attitude.z_m)}});
}

JsonValue RoverToJson(const messages::RoverBelief& rover) {
  JsonValue object = JsonValue::Object();
  const auto add = [&](std::string name, double value) {
    object.Append(std::move(name), JsonValue(value));
  };
  add("length_m", rover.length_m);
  add("width_m", rover.width_m);
  add("belly_clearance_m", rover.belly_clearance_m);
  add("wheel_width_m", rover.wheel_width_m);
  add("max_rocker_rad", rover.max_rocker_rad);
  add("max_bogie_rad", rover.max_bogie_rad);
  add("max_tilt_rad", rover.max_tilt_rad);
  add("wheel_radius_m", rover.drive.wheel_radius_m);
  add("max_wheel_speed_m_s", rover.drive.max_wheel_speed_m_s);
  add("max_steer_rad", rover.drive.max_steer_rad);
  add("steering_offset_rad", rover.drive.steering_offset_rad);
  object.Append("wheel_x_m", core::ListOf(rover.drive.wheel_x_m));
  object.Append("wheel_y_m", core::ListOf(rover.drive.wheel_y_m));
  object.Append("radius_ratio", core::ListOf(rover.drive.radius_ratio));
  object.Append("steered", core::ListOf(rover.drive.steered));
  return object;
}

JsonValue SiteMapToJson(const messages::SiteMap& map) {
  JsonValue object = JsonValue::Object({{"x0_m", JsonValue(map.x0_m)},
                                        {"y0_m", JsonValue(map.y0_m)},
                                        {"step_m", JsonValue(map.step_m)},
                                        {"nx", JsonValue(map.nx)},
                                        {"ny", JsonValue(map.ny)},
                                        {"height_sd_m", JsonValue(map.height_sd_m)}});
  if (!map.height_m.empty()) object.Append("height_m", core::ListOf(map.height_m));
  if (!map.rock_share.empty()) object.Append("rock_share", core::ListOf(map.rock_share));
  return object;
}

JsonValue CloudToJson(const messages::PointCloud& cloud) {
  JsonValue::List points;
  points.reserve(3 * cloud.points_R.size());
  for (const math::Vector3& point : cloud.points_R) {
    for (const double coordinate : point) points.emplace_back(coordinate);
  }
  JsonValue object = JsonValue::Object(
      {{"number", JsonValue(cloud.number)}, {"direction", NameOf(kDirections, cloud.direction)}});
  object.Append("points_R", JsonValue(std::move(points)));
  return object;
}

JsonValue ImageToJson(const messages::LookImage& image) {
  const auto vector = [](const math::Vector3& v) {
    return core::ListOf(std::array{v.x(), v.y(), v.z()});
  };
  return JsonValue::Object({{"width", JsonValue(image.width)},
                            {"height", JsonValue(image.height)},
                            {"C_R", vector(image.camera.C_R)},
                            {"A_R", vector(image.camera.A_R)},
                            {"H_R", vector(image.camera.H_R)},
                            {"V_R", vector(image.camera.V_R)},
                            {"grey", JsonValue(core::Base64(image.grey))}});
}

JsonValue ImagesToJson(const messages::LookImages& images) {
  return JsonValue::Object({{"number", JsonValue(images.number)},
                            {"direction", NameOf(kDirections, images.direction)},
                            {"left", ImageToJson(images.left)},
                            {"right", ImageToJson(images.right)}});
}

JsonValue FeltToJson(const messages::VehicleState& felt) {
  JsonValue object = JsonValue::Object();
  if (felt.articulation) {
    const messages::Articulation& joints = *felt.articulation;
    object.Append("articulation_rad",
                  core::ListOf(std::array{joints.left_rocker_rad, joints.right_rocker_rad,
                                          joints.left_bogie_rad, joints.right_bogie_rad}));
  }
  if (felt.specific_force_R) {
    const math::Vector3& force = *felt.specific_force_R;
    object.Append("specific_force_R", core::ListOf(std::array{force.x(), force.y(), force.z()}));
  }
  if (felt.motor_current_A) object.Append("motor_current_A", core::ListOf(*felt.motor_current_A));
  if (felt.contact) object.Append("contact", core::ListOf(*felt.contact));
  return object;
}

JsonValue EventsToJson(const navigation::Events& events) {
  JsonValue::List names;
  for (std::size_t i = 0; i < kEvents.size(); ++i) {
    if ((events.bits() >> i & 1u) != 0) names.emplace_back(kEvents[i]);
  }
  return JsonValue(std::move(names));
}

}  // namespace

JsonValue PlaceToJson(const messages::Goal& place) {
  return JsonValue::Object({{"x_m", JsonValue(place.x_m)}, {"y_m", JsonValue(place.y_m)}});
}

JsonValue PoseToJson(const messages::PoseEstimate& pose) {
  return JsonValue::Object({{"x_m", JsonValue(pose.x_m)},
                            {"y_m", JsonValue(pose.y_m)},
                            {"heading_rad", JsonValue(pose.heading_rad)},
                            {"distance_m", JsonValue(pose.distance_m)}});
}

JsonValue SetupToJson(const navigation::NavigatorSetup& setup) {
  JsonValue object =
      JsonValue::Object({{"goal", PlaceToJson(setup.goal)},
                         {"places", core::ListOf(setup.places, PlaceToJson)},
                         {"judges_hazards", JsonValue(setup.judges_hazards)},
                         {"full_speed_m_s", JsonValue(setup.full_speed_m_s)},
                         {"control_period_s", JsonValue(setup.control_period_s)},
                         {"operations_per_s", JsonValue(setup.operations_per_s)},
                         // Not every reader of JSON keeps 64 bits.
                         {"random_seed", JsonValue(std::to_string(setup.random_seed))},
                         {"rover", RoverToJson(setup.rover)}});
  if (setup.site_map) object.Append("site_map", SiteMapToJson(*setup.site_map));
  return object;
}

JsonValue InputToJson(const navigation::NavigatorInput& input) {
  JsonValue object = JsonValue::Object({{"time_s", JsonValue(input.time_s)},
                                        {"events", EventsToJson(input.events)},
                                        {"estimate", PoseToJson(input.estimate)},
                                        {"odometry", PoseToJson(input.odometry)},
                                        {"attitude", AttitudeToJson(input.attitude)},
                                        {"touches_behind", JsonValue(input.touches_behind)},
                                        {"notices_stuck", JsonValue(input.notices_stuck)}});
  if (input.report != nullptr) {
    object.Append("report",
                  JsonValue::Object({{"scan_number", JsonValue(input.report->scan_number)},
                                     {"hazards", core::ListOf(input.report->stripe_hazard)}}));
  }
  if (input.cloud != nullptr) object.Append("cloud", CloudToJson(*input.cloud));
  if (input.look != nullptr) {
    object.Append("look", JsonValue::Object({{"number", JsonValue(input.look->number)},
                                             {"time_s", JsonValue(input.look->time_s)},
                                             {"estimate", PoseToJson(input.look->estimate)},
                                             {"odometry", PoseToJson(input.look->odometry)},
                                             {"attitude", AttitudeToJson(input.look->attitude)}}));
  }
  if (input.vehicle_hazard != nullptr) {
    object.Append("hazard",
                  JsonValue::Object({{"kind", NameOf(kHazards, input.vehicle_hazard->kind)},
                                     {"side", NameOf(kSides, input.vehicle_hazard->side)}}));
  }
  if (input.felt != nullptr) object.Append("felt", FeltToJson(*input.felt));
  if (input.covariance != nullptr) {
    object.Append("covariance",
                  core::ListOf(std::span(input.covariance->data(),
                                         static_cast<std::size_t>(input.covariance->size()))));
  }
  if (input.images != nullptr) object.Append("images", ImagesToJson(*input.images));
  return object;
}

namespace {

[[noreturn]] void Fail(std::string_view member, std::string_view reason) {
  throw NavigatorFault(FaultKind::kMessage, fmt::format("in its answer {} {}", member, reason));
}

// null stands for "none", as JSON has no infinity.
double NumberIn(const JsonValue& object, std::string_view key, double absent) {
  const JsonValue* member = object.Find(key);
  if (member == nullptr || member->Is(JsonValue::Type::kNull)) return absent;
  if (!member->IsNumber()) Fail(key, "is no number");
  return member->number();
}

std::int64_t IntegerIn(const JsonValue& object, std::string_view key, std::int64_t absent) {
  const JsonValue* member = object.Find(key);
  if (member == nullptr) return absent;
  if (!member->Is(JsonValue::Type::kInteger)) Fail(key, "is no integer");
  return member->integer();
}

bool FlagIn(const JsonValue& object, std::string_view key) {
  const JsonValue* member = object.Find(key);
  if (member == nullptr) return false;
  if (!member->Is(JsonValue::Type::kBoolean)) Fail(key, "is neither true nor false");
  return member->boolean();
}

const std::string& TextIn(const JsonValue& object, std::string_view key) {
  const JsonValue* member = object.Find(key);
  if (member == nullptr || !member->Is(JsonValue::Type::kText)) Fail(key, "is no text");
  return member->text();
}

template <typename Enum, std::size_t kCount>
Enum EnumIn(const JsonValue& object, std::string_view key,
            const std::array<std::string_view, kCount>& names, Enum absent) {
  if (object.Find(key) == nullptr) return absent;
  const std::string& text = TextIn(object, key);
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    Fail(key, fmt::format("is \"{}\", not one of {}", text.substr(0, 60), fmt::join(names, ", ")));
  }
  return static_cast<Enum>(found - names.begin());
}

const JsonValue* ObjectIn(const JsonValue& object, std::string_view key) {
  const JsonValue* member = object.Find(key);
  if (member != nullptr && !member->Is(JsonValue::Type::kObject)) Fail(key, "is no object");
  return member;
}

const JsonValue::List& ListIn(const JsonValue& object, std::string_view key) {
  static const JsonValue::List kNone;
  const JsonValue* member = object.Find(key);
  if (member == nullptr) return kNone;
  if (!member->Is(JsonValue::Type::kList)) Fail(key, "is no list");
  return member->list();
}

double NumberOf(const JsonValue& value, std::string_view what) {
  if (!value.IsNumber()) Fail(what, "holds what is no number");
  return value.number();
}

}  // namespace

navigation::NavigatorDecision DecisionFromJson(const JsonValue& answer) {
  navigation::NavigatorDecision decision;
  decision.status = EnumIn(answer, "status", kStatuses, navigation::NavigatorStatus::kDriving);
  if (const JsonValue* look = answer.Find("look"); look != nullptr) {
    if (!look->Is(JsonValue::Type::kNull)) {
      decision.look = EnumIn(answer, "look", kDirections, messages::LookDirection::kAhead);
    }
  }
  decision.looks_on_the_move = FlagIn(answer, "looks_on_the_move");
  if (const JsonValue* motion = ObjectIn(answer, "motion")) {
    messages::MotionCommand& to = decision.motion;
    to.kind = EnumIn(*motion, "kind", kMotions, to.kind);
    to.curvature_per_m = NumberIn(*motion, "curvature_per_m", to.curvature_per_m);
    to.direction = static_cast<int>(
        std::clamp<std::int64_t>(IntegerIn(*motion, "direction", to.direction), -2, 2));
    to.curvature_rate_per_m2 = NumberIn(*motion, "curvature_rate_per_m2", 0.0);
    to.speed_share = NumberIn(*motion, "speed_share", to.speed_share);
    to.end_m = NumberIn(*motion, "end_m", to.end_m);
    to.move = IntegerIn(*motion, "move", to.move);
  }
  decision.until = navigation::AtEvents();
  if (const JsonValue* until = ObjectIn(answer, "until")) {
    navigation::Until& to = decision.until;
    to.period_s = NumberIn(*until, "period_s", to.period_s);
    to.distance_m = NumberIn(*until, "distance_m", to.distance_m);
    to.turn_rad = NumberIn(*until, "turn_rad", to.turn_rad);
    to.near_goal_m = NumberIn(*until, "near_goal_m", to.near_goal_m);
  }
  decision.work_ops = NumberIn(answer, "work_ops", 0.0);
  return decision;
}

messages::Overlay OverlayFromJson(const JsonValue& answer) {
  messages::Overlay overlay;
  for (const JsonValue& line : ListIn(answer, "lines")) {
    messages::OverlayLine& to = overlay.lines.emplace_back();
    to.name = TextIn(line, "name");
    for (const JsonValue& point : ListIn(line, "points")) {
      const bool pair = point.Is(JsonValue::Type::kList) && point.list().size() == 2;
      if (!pair) Fail("points", "holds what is no pair [x, y]");
      to.points.push_back(
          {NumberOf(point.list()[0], "points"), NumberOf(point.list()[1], "points")});
    }
  }
  for (const JsonValue& grid : ListIn(answer, "grids")) {
    messages::OverlayGrid& to = overlay.grids.emplace_back();
    to.name = TextIn(grid, "name");
    to.x0_m = NumberIn(grid, "x0_m", 0.0);
    to.y0_m = NumberIn(grid, "y0_m", 0.0);
    to.step_m = NumberIn(grid, "step_m", 0.0);
    to.nx = static_cast<int>(std::clamp<std::int64_t>(IntegerIn(grid, "nx", 0), -1, 1 << 20));
    to.ny = static_cast<int>(std::clamp<std::int64_t>(IntegerIn(grid, "ny", 0), -1, 1 << 20));
    for (const JsonValue& value : ListIn(grid, "values")) {
      const bool unknown = value.Is(JsonValue::Type::kNull);
      to.values.push_back(unknown ? core::kNaN : NumberOf(value, "values"));
    }
  }
  return overlay;
}

void OwnValuesFromJson(const JsonValue& list, std::span<double> values) {
  if (!list.Is(JsonValue::Type::kList)) Fail("own_values", "is no list");
  if (list.list().size() != values.size()) {
    Fail("own_values", fmt::format("has {} values, and its description declares {}",
                                   list.list().size(), values.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const JsonValue& value = list.list()[i];
    values[i] = value.Is(JsonValue::Type::kNull) ? core::kNaN : NumberOf(value, "own_values");
  }
}

}  // namespace rockyard::plugin
