#include "scenario/load.h"

#include <string_view>
#include <utility>

#include "core/archive.h"
#include "core/hash.h"
#include "core/json_file.h"
#include "core/json_text.h"

namespace rockyard::scenario {

namespace {

Scenario Finish(core::JsonValue document, std::span<const std::string> overrides,
                const Scenario& defaults) {
  for (const std::string& assignment : overrides) core::ApplyOverride(document, assignment);
  return ReadScenario(document, defaults);
}

// Adds "extends" to an object's schema and to those of the groups in it.
void AllowExtends(core::JsonValue& schema) {
  core::JsonValue* properties = schema.Find("properties");
  if (properties == nullptr) return;
  for (core::JsonMember& member : properties->members()) AllowExtends(member.value);
  core::JsonValue extends = core::JsonValue::Object();
  extends.Set(
      "description",
      core::JsonValue("file, relative to this one, with an object that this one changes; or "
                      "a list of such files, each over the one before"));
  extends.Set("type", core::JsonValue(core::JsonValue::List{core::JsonValue("string"),
                                                            core::JsonValue("array")}));
  properties->Set("extends", std::move(extends));
}

}  // namespace

Scenario LoadScenario(const std::filesystem::path& path, std::span<const std::string> overrides,
                      const Scenario& defaults) {
  core::JsonValue document = core::LoadJsonFile(path);
  AnchorPlugins(document, path.parent_path());
  return Finish(std::move(document), overrides, defaults);
}

Scenario ParseScenario(std::string_view text, std::span<const std::string> overrides,
                       const std::filesystem::path& folder, const Scenario& defaults) {
  core::JsonValue document = core::ResolveExtends(core::ParseJson(text, "scenario"), folder);
  AnchorPlugins(document, folder);
  return Finish(std::move(document), overrides, defaults);
}

plugin::PluginSets PluginSetsOf(Scenario& scenario) {
  return {scenario.drive.navigation.navigators, scenario.drive.localization.estimators,
          scenario.drive.perception.readers};
}

void AnchorPlugins(core::JsonValue& document, const std::filesystem::path& folder) {
  core::JsonValue* list = document.Find(plugin::kPluginsKey);
  if (list != nullptr) *list = plugin::Anchored(*list, folder);
}

Scenario ReadScenario(const core::JsonValue& document, const Scenario& defaults) {
  Scenario scenario = defaults;
  core::JsonValue current = document;
  if (const core::JsonValue* list = document.Find(plugin::kPluginsKey)) {
    scenario.plugins = plugin::OpenPlugins(*list, ".", defaults.plugins);
    plugin::AddKinds(scenario.plugins, PluginSetsOf(scenario));
    current.Erase(plugin::kPluginsKey);
  }
  // Nulls of open values are taken out before reading, which refuses null. The values are set after
  // it, as they follow what was read.
  const auto open = TakeOpenValues(current);
  core::ReadParams(current, scenario);
  SetOpenValues(open, scenario);
  return scenario;
}

Scenario ReadScenarioSealed(const core::JsonValue& document, const Scenario& defaults) {
  core::JsonValue sealed = document;
  sealed.Erase(plugin::kPluginsKey);
  Scenario scenario = defaults;
  plugin::AddStandIns(document, PluginSetsOf(scenario));
  return ReadScenario(sealed, scenario);
}

core::JsonValue WriteScenario(const Scenario& scenario) {
  core::JsonValue document = core::WriteParams(scenario);
  // Only where there are some, so that all other scenarios keep their fingerprints.
  if (!scenario.plugins.empty()) {
    document.Set(plugin::kPluginsKey, plugin::ToJson(scenario.plugins));
  }
  return document;
}

std::string ResolvedJson(const Scenario& scenario) {
  return core::DumpJson(WriteScenario(scenario));
}

std::uint64_t Fingerprint(const Scenario& scenario) {
  return ResolvedFingerprint(WriteScenario(scenario));
}

std::uint64_t ResolvedFingerprint(core::JsonValue resolved) {
  for (const std::string_view key : kNoInfluence) resolved.Erase(key);
  if (core::JsonValue* list = resolved.Find(plugin::kPluginsKey)) *list = plugin::IdentityOf(*list);
  return core::Hasher().Text(core::DumpJson(resolved)).value();
}

std::string SchemaJson(const Scenario& scenario) {
  core::JsonValue schema = core::MakeSchema(core::ListParams(scenario), "rockyard scenario");
  AllowOpenValues(schema);
  schema.Find("properties")->Set(plugin::kPluginsKey, plugin::SchemaOfPlugins());
  AllowExtends(schema);
  return core::DumpJson(schema);
}

std::string DefaultsJson() { return ResolvedJson({}); }

std::vector<core::ParameterInfo> ListParameters(const Scenario& scenario) {
  return core::ListParams(scenario).parameters();
}

namespace {

using core::JsonValue;

// Returns "a" of "a.b.c" and leaves "b.c" in `path`.
std::string_view CutFirst(std::string_view& path) {
  const std::size_t dot = path.find('.');
  const std::string_view first = path.substr(0, dot);
  path.remove_prefix(dot == std::string_view::npos ? path.size() : dot + 1);
  return first;
}

// Takes the value at `path` out where it is null. Returns whether the document leaves it open.
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
