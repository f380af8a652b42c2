#include "campaign/plugin_settings.h"

#include "core/json_text.h"
#include "core/json_value.h"
#include "plugin/foreign_navigator.h"
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
  return {"navigation.navigator=" + opened.front().navigators.front()->description().name,
          std::string(plugin::kPluginsKey) + "=" + core::CompactJson(anchored)};
}

}  // namespace rockyard::campaign
