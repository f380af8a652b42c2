#include "report/page_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace rockyard::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNull = "null";

std::string Compact(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string JsonText(std::string_view text) { return Compact(Json(text)); }

std::string JsonNumber(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : kNull;
}

std::string JsonSixDigits(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : kNull;
}

std::string JsonList(std::span<const std::string> values) {
  std::string list(1, '[');
  for (const std::string& value : values) {
    if (list.size() > 1) list += ',';
    list += value;
  }
  return list + ']';
}

std::string JsonTexts(std::span<const std::string> texts) {
  std::vector<std::string> values;
  values.reserve(texts.size());
  for (const std::string& text : texts) values.push_back(JsonText(text));
  return JsonList(values);
}

std::string JsonCompact(std::string_view json) { return Compact(Json::parse(json)); }

JsonObject& JsonObject::Add(std::string_view key, std::string_view json) {
  if (text_.size() > 1) text_ += ',';
  text_ += JsonText(key);
  text_ += ':';
  text_ += json;
  return *this;
}

JsonObject& JsonObject::AddText(std::string_view key, std::string_view text) {
  return Add(key, JsonText(text));
}

JsonObject& JsonObject::AddNumber(std::string_view key, double value) {
  return Add(key, JsonNumber(value));
}

JsonObject& JsonObject::AddInteger(std::string_view key, std::int64_t value) {
  return Add(key, std::to_string(value));
}

JsonObject& JsonObject::AddFlag(std::string_view key, bool value) {
  return Add(key, value ? "true" : "false");
}

}  // namespace rockyard::report
