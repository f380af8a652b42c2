#include "scenario/open_values.h"

#include <string_view>

namespace rockyard::scenario {
namespace {

using core::JsonValue;

// "b.c" of "a.b.c"; what stands before it is cut off and given back.
std::string_view CutFirst(std::string_view& path) {
  const std::size_t dot = path.find('.');
  const std::string_view first = path.substr(0, dot);
  path.remove_prefix(dot == std::string_view::npos ? path.size() : dot + 1);
  return first;
}

// Takes the value out where it is null. Whether the document leaves it open.
bool TakeNull(JsonValue* group, std::string_view path) {
  const std::string_view key = CutFirst(path);
  JsonValue* value = group->Find(key);
  if (value == nullptr) return true;
  if (!path.empty()) return TakeNull(value, path);
  if (!value->Is(JsonValue::Type::kNull)) return false;
  group->Erase(key);
  return true;
}

}  // namespace

std::vector<trial::OpenValue> TakeOpenValues(JsonValue& document) {
  std::vector<trial::OpenValue> open;
  for (const trial::OpenValue& value : trial::kOpenValues) {
    if (TakeNull(&document, value.path)) open.push_back(value);
  }
  return open;
}

void SetOpenValues(const std::vector<trial::OpenValue>& open, Scenario& scenario) {
  for (const trial::OpenValue& value : open) {
    value.in(scenario.drive) = value.suited(scenario.drive);
  }
}

void AllowOpenValues(JsonValue& schema) {
  for (const trial::OpenValue& value : trial::kOpenValues) {
    JsonValue* at = &schema;
    for (std::string_view path = value.path; !path.empty();) {
      at = at->Find("properties")->Find(CutFirst(path));
    }
    at->Set("type", JsonValue(JsonValue::List{JsonValue("number"), JsonValue("null")}));
  }
}

}  // namespace rockyard::scenario
