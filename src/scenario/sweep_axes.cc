// Reads the axes of sweep files, and these files as a whole, for LoadSweep.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/field_table.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/json_value.h"
#include "core/text.h"
#include "scenario/load.h"
#include "scenario/sweep_parts.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {
namespace {

using core::JsonValue;
using Type = JsonValue::Type;

std::string LastPart(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// The name of a level by its value. Names of cells, and so seeds, depend on the digits.
std::string LevelText(const JsonValue& value) {
  if (value.Is(Type::kText)) return value.text();
  return value.IsNumber() ? fmt::format("{}", value.number()) : core::Abbreviate(value);
}

bool Has(const JsonValue& value, std::string_view key) { return value.Find(key) != nullptr; }

class AxisReader {
 public:
  // `parts` must outlive the reader.
  // The parameters that axes may vary are those of `scenario`.
  AxisReader(PartReader& parts, const Scenario& scenario);

  // Reads an element of "axes", which stands at `path`. Names of scenario files in it are replaced
  // by what the files hold.
  AxisSpec Read(core::JsonValue& value, const std::string& path);

 private:
  void ReadLevels(core::JsonValue& value, const AxisParams& params, const std::string& path,
                  AxisSpec& axis);
  void ReadValues(core::JsonValue& value, const std::string& path, AxisSpec& axis);
  void ReadScenarios(core::JsonValue& value, const std::string& path, AxisSpec& axis);
  void ReadAblation(const AxisParams& params, AxisSpec& axis);
  void ReadRange(const core::JsonValue& value, const AxisParams& params, const std::string& path,
                 AxisSpec& axis);
  // Returns what is known of the parameter that an axis varies; nullptr where the path names none.
  const core::ParameterInfo* Describe(const std::string& path, AxisSpec& axis);
  bool IsGroup(const std::string& path) const;
  std::string Nearest(const std::string& path) const;
  void CheckLevels(const AxisSpec& axis, const std::string& path);

  PartReader& parts_;
  std::vector<core::ParameterInfo> parameters_;
};

}  // namespace

AxisReader::AxisReader(PartReader& parts, const Scenario& scenario)
    : parts_(parts), parameters_(ListParameters(scenario)) {}

AxisSpec AxisReader::Read(JsonValue& value, const std::string& path) {
  AxisSpec axis;
  const auto params = parts_.Fixed<AxisParams>(value, path, kFreeAxisKeys);
  if (!value.Is(Type::kObject)) return axis;
  axis.axis.name = params.name.empty() ? LastPart(params.path) : params.name;
  axis.axis.scale = params.scale;
  axis.path = params.path;
  ReadLevels(value, params, path, axis);
  parts_.CheckName(axis.axis.name, path + ".name");
  CheckLevels(axis, path);
  return axis;
}

// Reads the levels, of which a file must say in exactly one way what they are.
void AxisReader::ReadLevels(JsonValue& value, const AxisParams& params, const std::string& path,
                            AxisSpec& axis) {
  const std::array<std::string_view, 4> ways{"values", "levels", "scenarios", "ablation"};
  const auto given = std::count_if(ways.begin(), ways.end(),
                                   [&](std::string_view way) { return Has(value, way); });
  const bool takes_path = given == 0 || Has(value, "values");
  if (given > 1) {
    parts_.Add(path, "has several of values, levels, scenarios and ablation", "keep one of them");
  } else if (takes_path == params.path.empty()) {
    parts_.Add(path + ".path", takes_path ? "is missing" : "has no meaning beside named levels",
               takes_path ? "name a parameter, such as terrain.rocks.k_per_m2" : "remove it");
  } else if (given == 1 && (Has(value, "from") || Has(value, "to") || Has(value, "steps"))) {
    parts_.Add(path, "has a range beside its levels", "remove from, to and steps");
  } else if (Has(value, "values")) {
    ReadValues(value, path, axis);
  } else if (Has(value, "levels")) {
    for (JsonValue* level : parts_.Elements(value, "levels", path)) {
      axis.levels.push_back(
          parts_.Level(*level, fmt::format("{}.levels[{}]", path, axis.levels.size())));
    }
  } else if (Has(value, "scenarios")) {
    ReadScenarios(value, path, axis);
  } else if (Has(value, "ablation")) {
    ReadAblation(params, axis);
  } else {
    ReadRange(value, params, path, axis);
  }
}

void AxisReader::ReadValues(JsonValue& value, const std::string& path, AxisSpec& axis) {
  Describe(path, axis);
  axis.axis.numeric = true;
  for (const JsonValue* element : parts_.Elements(value, "values", path)) {
    LevelSpec level{.text = LevelText(*element)};
    parts_.CheckName(level.text, fmt::format("{}.values[{}]", path, axis.levels.size()));
    if (element->IsNumber()) level.number = element->number();
    axis.axis.numeric = axis.axis.numeric && level.number.has_value();
    level.settings.Set(axis.path, *element);
    axis.levels.push_back(std::move(level));
  }
}

// The list becomes one of levels that hold their scenarios, so that the document needs no files.
void AxisReader::ReadScenarios(JsonValue& value, const std::string& path, AxisSpec& axis) {
  if (axis.axis.name.empty()) axis.axis.name = "scenario";
  JsonValue::List levels;
  for (JsonValue* element : parts_.Elements(value, "scenarios", path)) {
    const std::string at = fmt::format("{}.scenarios[{}]", path, axis.levels.size());
    JsonValue level = JsonValue::Object();
    if (element->Is(Type::kText)) {
      level.Set("name", JsonValue(std::filesystem::path(element->text()).stem().string()));
      level.Set("scenario", parts_.ScenarioFile(element->text(), at));
      axis.levels.push_back(parts_.Level(level, at));
    } else {
      parts_.Add(at, fmt::format("is {}, not the name of a file", core::Abbreviate(*element)),
                 "write a path relative to this file");
    }
    levels.push_back(std::move(level));
  }
  value.Erase("scenarios");
  value.Set("name", JsonValue(axis.axis.name));
  value.Set("levels", JsonValue(std::move(levels)));
}

void AxisReader::ReadAblation(const AxisParams& params, AxisSpec& axis) {
  if (axis.axis.name.empty()) axis.axis.name = params.ablation;
  axis.axis.ablation = params.ablation;
  axis.levels = {LevelSpec{.text = "off"}, LevelSpec{.text = "on"}};
  axis.levels[1].ablation = params.ablation;
}

// Reads a range from "from" to "to", or takes the study range of the parameter.
void AxisReader::ReadRange(const JsonValue& value, const AxisParams& params,
                           const std::string& path, AxisSpec& axis) {
  axis.axis.numeric = true;
  const core::ParameterInfo* parameter = Describe(path, axis);
  if (parameter == nullptr) return;
  if (!(Has(value, "from") && Has(value, "to")) && !parameter->HasStudyRange()) {
    parts_.Add(path, "has neither values nor a range, and the parameter has no study range",
               "write \"values\", or \"from\" and \"to\"");
    return;
  }
  axis.from = Has(value, "from") ? params.from : parameter->study_low;
  axis.to = Has(value, "to") ? params.to : parameter->study_high;
  if (!(axis.from < axis.to)) {
    parts_.Add(path + ".to", fmt::format("is {}, not above from, {}", axis.to, axis.from),
               "write the smaller value first");
  } else if (params.scale == AxisScale::kLog && axis.from <= 0.0) {
    parts_.Add(path + ".from", fmt::format("is {}, which has no logarithm", axis.from),
               "use a positive value, or scale linear");
  } else if (Has(value, "steps")) {
    const auto last = static_cast<double>(params.steps - 1);
    std::vector<LevelSpec> levels;
    for (std::int64_t i = 0; i < params.steps; ++i) {
      levels.push_back(axis.At(static_cast<double>(i) / last));
    }
    axis.levels = std::move(levels);
  }
}

const core::ParameterInfo* AxisReader::Describe(const std::string& path, AxisSpec& axis) {
  const auto found = std::find_if(
      parameters_.begin(), parameters_.end(),
      [&](const core::ParameterInfo& parameter) { return parameter.path == axis.path; });
  if (found != parameters_.end()) {
    axis.axis.unit = found->unit;
    axis.whole = found->kind == core::FieldKind::kInteger;
    return &*found;
  }
  const std::string shown = axis.path.substr(0, 80);
  if (IsGroup(axis.path)) {
    parts_.Add(path + ".path", fmt::format("is {}, a group of parameters", shown),
               "name one of them, or write \"levels\"");
  } else {
    parts_.Add(path + ".path", fmt::format("is {}, which is no parameter", shown),
               Nearest(axis.path));
  }
  return nullptr;
}

bool AxisReader::IsGroup(const std::string& path) const {
  const std::string group = path + ".";
  return std::any_of(
      parameters_.begin(), parameters_.end(),
      [&](const core::ParameterInfo& parameter) { return parameter.path.starts_with(group); });
}

std::string AxisReader::Nearest(const std::string& path) const {
  std::vector<std::string_view> names;
  for (const core::ParameterInfo& parameter : parameters_) names.push_back(parameter.path);
  const std::string_view nearest = core::Nearest(path, names);
  return nearest.empty() ? "rockyard parameters lists them"
                         : fmt::format("did you mean \"{}\"?", nearest);
}

// Must refuse equal names: names decide cells' names and seeds.
void AxisReader::CheckLevels(const AxisSpec& axis, const std::string& path) {
  std::set<std::string_view> seen;
  for (const LevelSpec& level : axis.levels) {
    if (level.text.empty() || seen.insert(level.text).second) continue;
    parts_.Add(path, fmt::format("has the level \"{}\" twice", level.text.substr(0, 80)),
               "keep one of them");
    return;
  }
}

namespace {

// Returns `defaults` with the plugins of the base; those of "set" replace them.
Scenario DefaultsOf(const SweepSpec& spec, const Scenario& defaults,
                    std::vector<core::Problem>& problems) {
  const core::JsonValue* list = spec.settings.Find(plugin::kPluginsKey);
  if (list == nullptr && spec.scenario != nullptr) {
    list = spec.scenario->Find(plugin::kPluginsKey);
  }
  if (list == nullptr) return defaults;
  core::JsonValue document = core::JsonValue::Object();
  document.Set(plugin::kPluginsKey, *list);
  try {
    return ReadScenario(document, defaults);
  } catch (const core::UserError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    return defaults;
  }
}

// Returns the defaults of a sweep whose plugins are not opened, with stand-ins for the navigators,
// estimators and readers that base, settings and axes name a parameter of.
Scenario SealedDefaults(const SweepSpec& spec, const Scenario& defaults) {
  core::JsonValue document = core::JsonValue::Object();
  if (spec.scenario != nullptr) document = *spec.scenario;
  const auto set = [&](const std::string& path, const core::JsonValue& value) {
    const auto in = [&](const char* group) { return path.starts_with(group); };
    if (!in("navigation.") && !in("localization.") && !in("perception.")) return;
    try {
      core::SetPath(document, path, value);
    } catch (const core::UserError&) {
      // No path: whoever reads the settings or the axis says so.
    }
  };
  for (const core::JsonMember& member : spec.settings.members()) set(member.key, member.value);
  const core::JsonValue* axes = spec.document.Find("axes");
  if (axes != nullptr && axes->Is(Type::kList)) {
    for (const core::JsonValue& axis : axes->list()) {
      const core::JsonValue* path = axis.Find("path");
      const core::JsonValue* values = axis.Find("values");
      const bool has = values != nullptr && values->Is(Type::kList) && !values->list().empty();
      if (path != nullptr && path->Is(Type::kText)) {
        set(path->text(), has ? values->list().front() : core::JsonValue(0.0));
      }
    }
  }
  Scenario sealed = defaults;
  plugin::AddStandIns(document, PluginSetsOf(sealed));
  return sealed;
}

}  // namespace

SweepSpec ReadSweepSpec(core::JsonValue document, const std::filesystem::path& folder,
                        const SweepChanges& changes, std::vector<core::Problem>& problems) {
  PartReader parts(folder, problems);
  SweepSpec spec;
  spec.document = std::move(document);
  spec.params = parts.Fixed<SweepParams>(spec.document, "", kFreeSweepKeys);
  parts.CheckName(spec.params.name, "name");
  spec.scenario = parts.Base(spec.document, "");
  spec.settings = parts.Settings(spec.document.Find("set"), "set");
  spec.sealed = changes.sealed;
  spec.defaults = changes.sealed ? changes.defaults : DefaultsOf(spec, changes.defaults, problems);
  AxisReader axes(parts,
                  spec.sealed ? SealedDefaults(spec, spec.defaults) : Scenario(spec.defaults));
  for (core::JsonValue* axis : parts.Elements(spec.document, "axes", "")) {
    spec.axes.push_back(axes.Read(*axis, fmt::format("axes[{}]", spec.axes.size())));
  }
  for (core::JsonValue* cell : parts.Elements(spec.document, "cells", "")) {
    spec.cells.push_back(parts.Level(*cell, fmt::format("cells[{}]", spec.cells.size())));
  }
  return spec;
}

}  // namespace rockyard::scenario
