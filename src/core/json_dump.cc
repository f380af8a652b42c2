#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/check.h"
#include "core/json_text.h"

namespace rockyard::core {
namespace {

using Type = JsonValue::Type;

std::string Quote(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Reals keep a point or an exponent, so that they read back as reals.
std::string RealText(double value) {
  EXPECT(std::isfinite(value));
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string PlainText(const JsonValue& value) {
  switch (value.type()) {
    case Type::kBoolean:
      return value.boolean() ? "true" : "false";
    case Type::kInteger:
      return fmt::format("{}", value.integer());
    case Type::kReal:
      return RealText(value.number());
    case Type::kText:
      return Quote(value.text());
    default:
      return "null";
  }
}

bool IsPlain(const JsonValue& value) { return !value.Is(Type::kList) && !value.Is(Type::kObject); }

void Append(const JsonValue& value, int depth, std::string& out);

void AppendList(const JsonValue::List& list, int depth, std::string& out) {
  const bool one_line = std::all_of(list.begin(), list.end(), IsPlain);
  out += '[';
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) out += one_line ? ", " : ",";
    if (!one_line) out += '\n' + std::string(2 * (depth + 1), ' ');
    Append(list[i], depth + 1, out);
  }
  if (!one_line) out += '\n' + std::string(2 * depth, ' ');
  out += ']';
}

void AppendObject(const JsonValue::Members& members, int depth, std::string& out) {
  if (members.empty()) {
    out += "{}";
    return;
  }
  out += '{';
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (i > 0) out += ',';
    out += '\n' + std::string(2 * (depth + 1), ' ') + Quote(members[i].key) + ": ";
    Append(members[i].value, depth + 1, out);
  }
  out += '\n' + std::string(2 * depth, ' ') + '}';
}

void Append(const JsonValue& value, int depth, std::string& out) {
  if (value.Is(Type::kList)) {
    AppendList(value.list(), depth, out);
  } else if (value.Is(Type::kObject)) {
    AppendObject(value.members(), depth, out);
  } else {
    out += PlainText(value);
  }
}

}  // namespace

std::string DumpJson(const JsonValue& value) {
  std::string out;
  Append(value, 0, out);
  out += '\n';
  return out;
}

std::string Abbreviate(const JsonValue& value) {
  constexpr std::size_t kLongest = 60;
  if (!IsPlain(value)) return std::string(Describe(value.type()));
  if (value.Is(Type::kText) && value.text().size() > kLongest) {
    return Quote(value.text().substr(0, kLongest) + "...");
  }
  return PlainText(value);
}

}  // namespace rockyard::core
