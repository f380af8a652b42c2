#include "core/json_pieces.h"

#include <fmt/format.h>

#include <cmath>

#include "core/json_text.h"

namespace rockyard::core {
namespace {

constexpr const char* kNull = "null";

}  // namespace

std::string JsonNumber(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : kNull;
}

std::string JsonSixDigits(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : kNull;
}

std::string JsonList(std::span<const std::string> values) {
  return JsonList(values, [](const std::string& value) -> const std::string& { return value; });
}

std::string JsonTexts(std::span<const std::string> texts) { return JsonList(texts, QuoteJson); }

JsonObject& JsonObject::Add(std::string_view key, std::string_view json) {
  if (text_.size() > 1) text_ += ',';
  text_ += QuoteJson(key);
  text_ += ':';
  text_ += json;
  return *this;
}

JsonObject& JsonObject::AddText(std::string_view key, std::string_view text) {
  return Add(key, QuoteJson(text));
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

}  // namespace rockyard::core
