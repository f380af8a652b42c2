/// @file
/// What plugins of navigators, estimators and readers share. Parameters between plugin and command:
/// listed as JSON, set from values, their conditions told. Messages that both get; what a library
/// hands over. A part of the headers of these three, which alone include it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/fields.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/look_images.h"
#include "messages/navigation_view.h"
#include "messages/vehicle_state.h"
#include "plugin/abi.h"

namespace rockyard::plugin::layer {

/// JSON that is written from front to back.
class JsonLine {
 public:
  JsonLine& Raw(std::string_view text) {
    text_ += text;
    return *this;
  }
  JsonLine& Text(std::string_view text) {
    text_ += '"';
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        text_ += '\\';
        text_ += c;
      } else if (byte < 0x20) {
        std::array<char, 8> escaped{};
        std::snprintf(escaped.data(), escaped.size(), "\\u%04x", static_cast<unsigned>(byte));
        text_ += escaped.data();
      } else {
        text_ += c;
      }
    }
    text_ += '"';
    return *this;
  }
  JsonLine& Number(double value) {
    if (!std::isfinite(value)) return Raw("null");
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g", value);
    std::replace(digits.begin(), digits.end(), ',', '.');
    return Raw(digits.data());
  }
  JsonLine& Integer(std::int64_t value) { return Raw(std::to_string(value)); }
  /// Begins a member, after a comma unless it is the first of its object.
  JsonLine& Key(std::string_view key) {
    if (!text_.empty() && text_.back() != '{' && text_.back() != '[') text_ += ',';
    return Text(key).Raw(":");
  }
  JsonLine& Member(std::string_view key, std::string_view value) { return Key(key).Text(value); }
  JsonLine& Comma() {
    if (!text_.empty() && text_.back() != '[') text_ += ',';
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Lists parameters as JSON, with their defaults.
class FieldLister final : public core::FieldVisitor {
 public:
  explicit FieldLister(JsonLine& json) : json_(json) {}

  void Real(std::string_view name, double& value, const core::FieldInfo& info) override {
    Begin(name, "real", info).Number(value).Raw("}");
  }
  void Angle(std::string_view name, double& value_rad, const core::FieldInfo& info) override {
    Begin(name, "angle", info).Number(value_rad).Raw("}");
  }
  void Integer(std::string_view name, std::int64_t& value, const core::FieldInfo& info) override {
    Begin(name, "integer", info).Integer(value).Raw("}");
  }
  void Boolean(std::string_view name, bool& value, const core::FieldInfo& info) override {
    Begin(name, "boolean", info).Raw(value ? "true}" : "false}");
  }
  void Text(std::string_view name, std::string& value, const core::FieldInfo& info) override {
    Begin(name, "text", info).Text(value).Raw("}");
  }
  void Reals(std::string_view name, std::vector<double>& values,
             const core::FieldInfo& info) override {
    List(Begin(name, "reals", info), values);
  }
  void FixedReals(std::string_view name, std::span<double> values,
                  const core::FieldInfo& info) override {
    List(Begin(name, "fixed_reals", info), values);
  }
  void Integers(std::string_view name, std::vector<std::int64_t>& values,
                const core::FieldInfo& info) override {
    List(Begin(name, "integers", info), values);
  }
  void Require(std::string_view, bool, std::string_view, std::string_view) override {}

 protected:
  void ChoiceIndex(std::string_view name, int& index, std::span<const std::string_view> names,
                   const core::FieldInfo& info) override {
    json_.Comma().Raw("{").Member("name", name).Member("type", "choice");
    Describe(info);
    json_.Key("choices").Raw("[");
    for (const std::string_view choice : names) json_.Comma().Text(choice);
    json_.Raw("]").Key("default").Integer(index).Raw("}");
  }
  void BeginGroup(std::string_view name, std::string_view doc) override {
    json_.Comma().Raw("{").Member("name", name).Member("type", "group").Member("doc", doc);
    json_.Key("parameters").Raw("[");
  }
  void EndGroup() override { json_.Raw("]}"); }

 private:
  JsonLine& Begin(std::string_view name, std::string_view type, const core::FieldInfo& info) {
    json_.Comma().Raw("{").Member("name", name).Member("type", type);
    Describe(info);
    return json_.Key("default");
  }
  void Describe(const core::FieldInfo& info) {
    constexpr std::array<std::string_view, 4> kOrigins{"published", "calibrated", "assumed",
                                                       "setting"};
    json_.Member("doc", info.doc).Member("source", info.source);
    json_.Member("origin", kOrigins[static_cast<std::size_t>(info.origin)]);
    if (std::isfinite(info.min)) json_.Key("min").Number(info.min);
    if (std::isfinite(info.max)) json_.Key("max").Number(info.max);
    if (info.study_low < info.study_high) {
      json_.Key("study").Raw("[").Number(info.study_low).Raw(",").Number(info.study_high).Raw("]");
    }
    json_.Key("max_entries").Integer(static_cast<std::int64_t>(info.max_entries));
  }
  template <typename Values>
  static void List(JsonLine& json, const Values& values) {
    json.Raw("[");
    for (const auto value : values) {
      json.Comma();
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
        json.Number(value);
      } else {
        json.Integer(value);
      }
    }
    json.Raw("]}");
  }

  JsonLine& json_;
};

/// Sets parameters to the values of the command, in the order of the lister.
class FieldSetter final : public core::FieldVisitor {
 public:
  explicit FieldSetter(const rockyard_values& values) : values_(values) {}

  void Real(std::string_view, double& value, const core::FieldInfo&) override {
    value = Next().real;
  }
  void Angle(std::string_view, double& value_rad, const core::FieldInfo&) override {
    value_rad = Next().real;
  }
  void Integer(std::string_view, std::int64_t& value, const core::FieldInfo&) override {
    value = Next().integer;
  }
  void Boolean(std::string_view, bool& value, const core::FieldInfo&) override {
    value = Next().integer != 0;
  }
  void Text(std::string_view, std::string& value, const core::FieldInfo&) override {
    value = Next().text;
  }
  void Reals(std::string_view, std::vector<double>& values, const core::FieldInfo&) override {
    const rockyard_value& value = Next();
    values.assign(value.reals, value.reals + value.count);
  }
  void FixedReals(std::string_view, std::span<double> values, const core::FieldInfo&) override {
    const rockyard_value& value = Next();
    std::copy_n(value.reals, std::min(values.size(), value.count), values.begin());
  }
  void Integers(std::string_view, std::vector<std::int64_t>& values,
                const core::FieldInfo&) override {
    const rockyard_value& value = Next();
    values.assign(value.integers, value.integers + value.count);
  }
  void Require(std::string_view, bool, std::string_view, std::string_view) override {}

 protected:
  void ChoiceIndex(std::string_view, int& index, std::span<const std::string_view>,
                   const core::FieldInfo&) override {
    index = static_cast<int>(Next().integer);
  }
  void BeginGroup(std::string_view, std::string_view) override {}
  void EndGroup() override {}

 private:
  const rockyard_value& Next() {
    if (next_ >= values_.count) throw std::runtime_error("the command handed too few parameters");
    return values_.values[next_++];
  }

  const rockyard_values& values_;
  std::size_t next_ = 0;
};

/// Lists the conditions across parameters that do not hold.
class Conditions final : public core::FieldVisitor {
 public:
  explicit Conditions(JsonLine& json) : json_(json) {}

  void Real(std::string_view, double&, const core::FieldInfo&) override {}
  void Angle(std::string_view, double&, const core::FieldInfo&) override {}
  void Integer(std::string_view, std::int64_t&, const core::FieldInfo&) override {}
  void Boolean(std::string_view, bool&, const core::FieldInfo&) override {}
  void Text(std::string_view, std::string&, const core::FieldInfo&) override {}
  void Reals(std::string_view, std::vector<double>&, const core::FieldInfo&) override {}
  void FixedReals(std::string_view, std::span<double>, const core::FieldInfo&) override {}
  void Integers(std::string_view, std::vector<std::int64_t>&, const core::FieldInfo&) override {}
  void Require(std::string_view name, bool holds, std::string_view reason,
               std::string_view suggestion) override {
    if (holds) return;
    json_.Comma().Raw("{").Member("parameter", prefix_ + std::string(name));
    json_.Member("reason", reason).Member("suggestion", suggestion).Raw("}");
  }

 protected:
  void ChoiceIndex(std::string_view, int&, std::span<const std::string_view>,
                   const core::FieldInfo&) override {}
  void BeginGroup(std::string_view name, std::string_view) override {
    prefix_ += std::string(name) + ".";
  }
  void EndGroup() override {
    prefix_.pop_back();
    const std::size_t dot = prefix_.find_last_of('.');
    prefix_.resize(dot == std::string::npos ? 0 : dot + 1);
  }

 private:
  JsonLine& json_;
  std::string prefix_;
};

/// Returns the parameters with the values of the command.
template <typename Params>
Params WithValues(const rockyard_values& values) {
  Params params;
  FieldSetter setter(values);
  params.Visit(setter);
  return params;
}

/// Writes what a description says, as an object without its end.
template <typename Params, typename Description>
void WriteDescription(const Description& description, JsonLine& json) {
  json.Raw("{").Member("name", description.name).Member("doc", description.doc);
  json.Key("parameters").Raw("[");
  Params params;
  FieldLister lister(json);
  params.Visit(lister);
  json.Raw("]");
  if constexpr (requires { description.own_values; }) {
    json.Key("own_values").Raw("[");
    for (const messages::OwnValue& value : description.own_values) {
      json.Comma().Raw("{").Member("name", value.name).Member("unit", value.unit);
      json.Member("meaning", value.meaning).Raw("}");
    }
    json.Raw("]");
  }
}

/// Runs `call`; returns 0, or 1 and what it threw.
template <typename Call>
int Guarded(rockyard_error* error, const Call& call) noexcept {
  const auto fail = [error](const char* text) {
    std::snprintf(error->text, sizeof error->text, "%s", text);
    return 1;
  };
  try {
    call();
    return 0;
  } catch (const std::exception& thrown) {
    return fail(thrown.what());
  } catch (...) {
    return fail("it threw something that is no std::exception");
  }
}

/// Copies own values. Throws where there are others than the description declares.
inline void CopyOwnValues(std::span<const double> own, double* values, std::size_t count) {
  if (own.size() != count) {
    throw std::runtime_error("own_values() returns " + std::to_string(own.size()) +
                             " values, and its description declares " + std::to_string(count));
  }
  std::copy(own.begin(), own.end(), values);
}

/// Return what the command hands over as messages.
inline messages::PoseEstimate Pose(const rockyard_pose& pose) {
  return {pose.x_m, pose.y_m, pose.heading_rad, pose.distance_m};
}
inline messages::AttitudeEstimate Attitude(const rockyard_attitude& attitude) {
  return {attitude.roll_rad, attitude.pitch_rad, attitude.z_m};
}
inline messages::VehicleState Felt(const rockyard_felt& from) {
  messages::VehicleState felt;
  if (from.articulation_rad != nullptr) {
    felt.articulation = {from.articulation_rad[0], from.articulation_rad[1],
                         from.articulation_rad[2], from.articulation_rad[3]};
  }
  if (from.specific_force_R != nullptr) {
    felt.specific_force_R = Eigen::Map<const math::Vector3>(from.specific_force_R);
  }
  if (from.motor_current_A != nullptr) {
    felt.motor_current_A.emplace();
    std::copy_n(from.motor_current_A, messages::kWheelCount, felt.motor_current_A->begin());
  }
  if (from.contact != nullptr) {
    felt.contact.emplace();
    for (std::size_t i = 0; i < messages::kContactSwitchCount; ++i) {
      (*felt.contact)[i] = from.contact[i] != 0;
    }
  }
  return felt;
}

/// Hands over what is wrong with parameters.
template <typename Params>
int Check(const rockyard_values* values, rockyard_take_text take, void* to,
          rockyard_error* error) noexcept {
  return Guarded(error, [&] {
    Params params = WithValues<Params>(*values);
    JsonLine json;
    json.Raw("{").Key("problems").Raw("[");
    Conditions conditions(json);
    params.Visit(conditions);
    json.Raw("]}");
    take(to, json.text().data(), json.text().size());
  });
}

/// Returns what is believed of the wheels: of a rockyard_rover or a rockyard_estimator_setup.
template <typename From>
messages::DriveCalibration Wheels(const From& from) {
  messages::DriveCalibration drive;
  drive.wheel_radius_m = from.wheel_radius_m;
  drive.max_wheel_speed_m_s = from.max_wheel_speed_m_s;
  drive.max_steer_rad = from.max_steer_rad;
  drive.steering_offset_rad = from.steering_offset_rad;
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    drive.wheel_x_m[wheel] = from.wheel_x_m[wheel];
    drive.wheel_y_m[wheel] = from.wheel_y_m[wheel];
    drive.radius_ratio[wheel] = from.radius_ratio[wheel];
    drive.steered[wheel] = from.steered[wheel] != 0;
  }
  return drive;
}

/// Returns the believed rover.
inline messages::RoverBelief Rover(const rockyard_rover& from) {
  messages::RoverBelief rover;
  rover.length_m = from.length_m;
  rover.width_m = from.width_m;
  rover.belly_clearance_m = from.belly_clearance_m;
  rover.wheel_width_m = from.wheel_width_m;
  rover.max_rocker_rad = from.max_rocker_rad;
  rover.max_bogie_rad = from.max_bogie_rad;
  rover.max_tilt_rad = from.max_tilt_rad;
  rover.drive = Wheels(from);
  return rover;
}

/// Return what a camera, and a pair of cameras, took.
inline messages::LookImage Image(const rockyard_image& from) {
  const auto cells = static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height);
  const auto vector = [](const double* place) -> math::Vector3 {
    return Eigen::Map<const math::Vector3>(place);
  };
  return {from.width,
          from.height,
          {from.grey, from.grey + cells},
          {vector(from.C_R), vector(from.A_R), vector(from.H_R), vector(from.V_R)}};
}
inline messages::LookImages Images(const rockyard_images& from) {
  return {from.number,
          from.behind != 0 ? messages::LookDirection::kBehind : messages::LookDirection::kAhead,
          Image(from.left), Image(from.right)};
}

/// The functions of what `Describe` describes, in a member kType.
template <auto Describe, typename Description>
struct TypeOf {
  static_assert(
      sizeof(Description) == 0,
      "ROCKYARD_PLUGIN takes functions that return a NavigatorDescription (include "
      "plugin/navigator_plugin.h), an EstimatorDescription (plugin/estimator_plugin.h) or "
      "a PointReaderDescription (plugin/reader_plugin.h)");
};

/// Returns the functions of all that are of one type, in their order.
template <typename Type, typename... Kinds>
constexpr auto TypesOf() {
  constexpr std::size_t kCount =
      (std::size_t{0} + ... + (std::is_same_v<decltype(Kinds::kType), const Type> ? 1U : 0U));
  std::array<const Type*, kCount> types{};
  [[maybe_unused]] std::size_t next = 0;
  const auto add = [&](const auto& type) {
    if constexpr (std::is_same_v<decltype(type), const Type&>) types[next++] = &type;
  };
  (add(Kinds::kType), ...);
  return types;
}

/// What a library hands over.
template <auto... Describe>
struct Library {
  static constexpr auto kNavigators =
      TypesOf<rockyard_navigator_type, TypeOf<Describe, decltype(Describe())>...>();
  static constexpr auto kEstimators =
      TypesOf<rockyard_estimator_type, TypeOf<Describe, decltype(Describe())>...>();
  static constexpr auto kReaders =
      TypesOf<rockyard_reader_type, TypeOf<Describe, decltype(Describe())>...>();
  static constexpr rockyard_plugin_info kInfo{ROCKYARD_PLUGIN_ABI, 0,
                                              kNavigators.data(),  kNavigators.size(),
                                              kEstimators.data(),  kEstimators.size(),
                                              kReaders.data(),     kReaders.size()};
};

}  // namespace rockyard::plugin::layer

/// Makes the library a plugin of navigators, estimators and readers of images, each named by the
/// function that returns its description, in any order. Stands once in a library, outside of all
/// namespaces.
#define ROCKYARD_PLUGIN(...)                                                                     \
  extern "C" __attribute__((visibility("default"))) const rockyard_plugin_info* rockyard_plugin( \
      void) {                                                                                    \
    return &::rockyard::plugin::layer::Library<__VA_ARGS__>::kInfo;                              \
  }
