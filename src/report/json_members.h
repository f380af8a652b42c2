// Objects of JSON in one call: each member's name, then its value, as tree or as text.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>

#include "core/json_pieces.h"
#include "core/json_value.h"
#include "statistics/proportions.h"

namespace rockyard::report {

// [low, high], null where there is none.
inline core::JsonValue EndsOf(const statistics::Interval& interval) {
  return core::JsonValue(
      core::JsonValue::List{core::NumberOrNull(interval.low), core::NumberOrNull(interval.high)});
}

// A double that is not finite becomes null, an interval a list of its ends.
template <typename Value>
core::JsonValue TreeOf(Value&& value) {
  using Plain = std::remove_cvref_t<Value>;
  if constexpr (std::floating_point<Plain>) {
    return core::NumberOrNull(value);
  } else if constexpr (std::same_as<Plain, statistics::Interval>) {
    return EndsOf(value);
  } else {
    return core::JsonValue(std::forward<Value>(value));
  }
}

inline void SetMembers(core::JsonValue&) {}

template <typename Value, typename... Rest>
void SetMembers(core::JsonValue& json, std::string_view name, Value&& value, Rest&&... rest) {
  json.Set(name, TreeOf(std::forward<Value>(value)));
  SetMembers(json, std::forward<Rest>(rest)...);
}

template <typename... Members>
core::JsonValue ObjectTree(Members&&... members) {
  core::JsonValue json = core::JsonValue::Object();
  SetMembers(json, std::forward<Members>(members)...);
  return json;
}

// What is JSON already, for ObjectText. It must outlive the call only.
struct Json {
  std::string_view text;
};

inline void AddMembers(core::JsonObject&) {}

template <typename Value, typename... Rest>
void AddMembers(core::JsonObject& json, std::string_view name, const Value& value,
                const Rest&... rest) {
  if constexpr (std::same_as<Value, Json>) {
    json.Add(name, value.text);
  } else if constexpr (std::convertible_to<Value, std::string_view>) {
    json.AddText(name, value);
  } else if constexpr (std::same_as<Value, bool>) {
    json.AddFlag(name, value);
  } else if constexpr (std::integral<Value>) {
    json.AddInteger(name, static_cast<std::int64_t>(value));
  } else if constexpr (std::floating_point<Value>) {
    json.AddNumber(name, value);
  } else {
    json.Add(name, core::JsonTexts(value));
  }
  AddMembers(json, rest...);
}

// Numbers as core::JsonNumber has them; a list is one of texts.
template <typename... Members>
std::string ObjectText(const Members&... members) {
  core::JsonObject json;
  AddMembers(json, members...);
  return json.Text();
}

}  // namespace rockyard::report
