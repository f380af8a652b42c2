#include "campaign/plugin_settings.h"

#include <algorithm>

#include "core/json_text.h"
#include "core/json_value.h"
#include "plugin/foreign_estimator.h"
#include "plugin/foreign_navigator.h"
#include "plugin/foreign_reader.h"
#include "plugin/plugin_use.h"

namespace rockyard::campaign {

std::vector<std::string> SettingsOf(const GivenPlugins& given) {
  using core::JsonValue;
  JsonValue::List list;
  const auto add = [&](const char* key, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      list.push_back(JsonValue::Object({{key, JsonValue(value)}}));
    }
  };
  add("library", given.libraries);
  add("process", given.processes);
  if (list.empty()) return {};
  const JsonValue anchored = plugin::Anchored(JsonValue(std::move(list)), ".");
  const std::vector<plugin::PluginUse> opened = plugin::OpenPlugins(anchored, ".");
  std::vector<std::string> settings;
  const auto choose = [&](const char* key, const auto& found) {
    settings.push_back(std::string(key) + "=" + found->description().name);
  };
  const auto navigates = [](const plugin::PluginUse& use) { return !use.navigators.empty(); };
  const auto estimates = [](const plugin::PluginUse& use) {
    return use.navigators.empty() && use.estimators.size() == 1;
  };
  const auto navigator = std::ranges::find_if(opened, navigates);
  if (navigator != opened.end()) choose("navigation.navigator", navigator->navigators.front());
  const auto estimator = std::ranges::find_if(opened, estimates);
  if (estimator != opened.end()) choose("localization.estimator", estimator->estimators.front());
  const auto reads = [](const plugin::PluginUse& use) {
    return use.navigators.empty() && use.estimators.empty() && use.readers.size() == 1;
  };
  const auto reader = std::ranges::find_if(opened, reads);
  if (reader != opened.end()) choose("perception.reader", reader->readers.front());
  settings.push_back(std::string(plugin::kPluginsKey) + "=" + core::CompactJson(anchored));
  return settings;
}

}  // namespace rockyard::campaign
