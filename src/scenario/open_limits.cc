#include "scenario/open_limits.h"

#include <string_view>
#include <utility>

namespace rockyard::scenario {
namespace {

using core::JsonValue;

// The group and the key of "group.key".
std::pair<std::string_view, std::string_view> Parts(std::string_view path) {
  const std::size_t dot = path.find('.');
  return {path.substr(0, dot), path.substr(dot + 1)};
}

}  // namespace

std::vector<trial::OpenLimit> TakeOpenLimits(JsonValue& document) {
  std::vector<trial::OpenLimit> open;
  for (const trial::OpenLimit& limit : trial::kOpenLimits) {
    const auto [group_name, key] = Parts(limit.path);
    JsonValue* group = document.Find(group_name);
    const JsonValue* value = group == nullptr ? nullptr : group->Find(key);
    if (value != nullptr && !value->Is(JsonValue::Type::kNull)) continue;
    if (value != nullptr) group->Erase(key);
    open.push_back(limit);
  }
  return open;
}

void SetOpenLimits(const std::vector<trial::OpenLimit>& open, Scenario& scenario) {
  const trial::RefereeParams patience = trial::PatienceFor(scenario.drive);
  for (const trial::OpenLimit& limit : open) {
    scenario.drive.referee.*limit.value = patience.*limit.value;
  }
}

void AllowOpenLimits(JsonValue& schema) {
  for (const trial::OpenLimit& limit : trial::kOpenLimits) {
    const auto [group, key] = Parts(limit.path);
    JsonValue* at = &schema;
    for (const std::string_view name :
         {std::string_view("properties"), group, std::string_view("properties"), key}) {
      at = at->Find(name);
    }
    at->Set("type", JsonValue(JsonValue::List{JsonValue("number"), JsonValue("null")}));
  }
}

}  // namespace rockyard::scenario
