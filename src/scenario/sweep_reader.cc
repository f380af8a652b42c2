#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "core/archive.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/spelling.h"
#include "scenario/load.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;
using core::Problem;
using Type = JsonValue::Type;

std::string LastPart(const std::string& path) { return path.substr(path.rfind('.') + 1); }

std::string LevelText(const JsonValue& value) {
  return value.Is(Type::kText) ? value.text() : core::Abbreviate(value);
}

class SpecReader {
 public:
  SpecReader(const fs::path& folder, std::vector<Problem>& problems)
      : folder_(folder), problems_(problems), parameters_(ListParameters()) {}

  SweepSpec Read(JsonValue document) {
    SweepSpec spec;
    spec.document = std::move(document);
    ReadPart(spec.document, "", kFreeSweepKeys, spec.params);
    spec.scenario = ReadBase(spec.document, "");
    spec.settings = ReadSettings(spec.document.Find("set"), "set");
    for (JsonValue* axis : Elements(spec.document, "axes", "")) {
      spec.axes.push_back(ReadAxis(*axis, fmt::format("axes[{}]", spec.axes.size())));
    }
    for (JsonValue* cell : Elements(spec.document, "cells", "")) {
      spec.cells.push_back(ReadLevel(*cell, fmt::format("cells[{}]", spec.cells.size())));
    }
    return spec;
  }

 private:
  void Add(std::string path, std::string reason, std::string suggestion) {
    problems_.push_back({std::move(path), std::move(reason), std::move(suggestion)});
  }

  // The fixed keys of an object; free keys are only checked for being known.
  template <typename Params>
  void ReadPart(const JsonValue& part, const std::string& path,
                std::span<const std::string_view> free_keys, Params& params) {
    JsonValue fixed = part;
    for (const std::string_view key : free_keys) {
      if (fixed.Find(key) != nullptr) fixed.Set(key, JsonValue(""));
    }
    try {
      core::ReadParams(fixed, params);
    } catch (const core::UserError& error) {
      for (Problem problem : error.problems()) {
        const bool root = problem.path.starts_with('(');
        if (!path.empty()) problem.path = root ? path : path + "." + problem.path;
        problems_.push_back(std::move(problem));
      }
    }
  }

  // The elements of a list member; none where it is absent or no list.
  std::vector<JsonValue*> Elements(JsonValue& object, std::string_view key,
                                   const std::string& path) {
    std::vector<JsonValue*> elements;
    JsonValue* list = object.Find(key);
    if (list == nullptr) return elements;
    const std::string at = path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
    if (!list->Is(Type::kList) || list->list().empty()) {
      Add(at, fmt::format("is {}, not a list with elements", core::Abbreviate(*list)),
          "write [...]");
      return elements;
    }
    for (JsonValue& element : list->list()) elements.push_back(&element);
    return elements;
  }

  JsonValue ReadSettings(const JsonValue* set, const std::string& path) {
    if (set == nullptr) return JsonValue::Object();
    if (set->Is(Type::kObject)) return *set;
    Add(path, fmt::format("is {}, not an object", core::Abbreviate(*set)),
        "write {\"terrain.rocks.k_per_m2\": 0.01}");
    return JsonValue::Object();
  }

  JsonValue LoadScenarioFile(const std::string& name, const std::string& path) {
    try {
      return core::LoadJsonFile(folder_ / name);
    } catch (const core::UserError& error) {
      for (const Problem& problem : error.problems()) {
        Add(path, fmt::format("names {}: {}: {}", name, problem.path, problem.reason),
            problem.suggestion);
      }
      return JsonValue::Object();
    }
  }

  // The member "scenario"; a file's name there is replaced by what the file holds.
  std::shared_ptr<const JsonValue> ReadBase(JsonValue& object, const std::string& path) {
    JsonValue* scenario = object.Find("scenario");
    if (scenario == nullptr) return nullptr;
    const std::string at = path.empty() ? "scenario" : path + ".scenario";
    if (scenario->Is(Type::kText)) *scenario = LoadScenarioFile(scenario->text(), at);
    if (!scenario->Is(Type::kObject)) {
      Add(at, fmt::format("is {}, not a scenario", core::Abbreviate(*scenario)),
          "name a scenario file, or write an object");
    } else if (IsSweep(*scenario)) {
      Add(at, "is a sweep, not a scenario", "name a scenario file");
    }
    return std::make_shared<const JsonValue>(*scenario);
  }

  LevelSpec ReadLevel(JsonValue& value, const std::string& path) {
    LevelSpec level;
    LevelParams params;
    ReadPart(value, path, kFreeLevelKeys, params);
    if (!value.Is(Type::kObject)) return level;
    level.text = params.name;
    if (level.text.empty()) Add(path + ".name", "is missing", "give the level a name");
    level.settings = ReadSettings(value.Find("set"), path + ".set");
    level.scenario = ReadBase(value, path);
    return level;
  }

  AxisSpec ReadAxis(JsonValue& value, const std::string& path) {
    AxisSpec axis;
    AxisParams params;
    ReadPart(value, path, kFreeAxisKeys, params);
    if (!value.Is(Type::kObject)) return axis;
    axis.axis.name = params.name.empty() ? LastPart(params.path) : params.name;
    axis.axis.scale = params.scale;
    axis.path = params.path;
    ReadLevels(value, params, path, axis);
    if (axis.axis.name.empty()) Add(path + ".name", "is missing", "give the axis a name");
    CheckLevels(axis, path);
    return axis;
  }

  // Exactly one of the ways to say what the levels are.
  void ReadLevels(JsonValue& value, const AxisParams& params, const std::string& path,
                  AxisSpec& axis) {
    const std::array<std::string_view, 4> ways{"values", "levels", "scenarios", "ablation"};
    const auto given = std::count_if(
        ways.begin(), ways.end(), [&](std::string_view way) { return value.Find(way) != nullptr; });
    const bool takes_path = given == 0 || value.Find("values") != nullptr;
    if (given > 1) {
      Add(path, "has several of values, levels, scenarios and ablation", "keep one of them");
    } else if (takes_path != !params.path.empty()) {
      Add(path + ".path", takes_path ? "is missing" : "has no meaning beside named levels",
          takes_path ? "name a parameter, such as terrain.rocks.k_per_m2" : "remove it");
    } else if (value.Find("values") != nullptr) {
      ReadValues(value, path, axis);
    } else if (value.Find("levels") != nullptr) {
      for (JsonValue* level : Elements(value, "levels", path)) {
        axis.levels.push_back(
            ReadLevel(*level, fmt::format("{}.levels[{}]", path, axis.levels.size())));
      }
    } else if (value.Find("scenarios") != nullptr) {
      ReadScenarios(value, path, axis);
    } else if (!params.ablation.empty()) {
      if (params.name.empty()) axis.axis.name = params.ablation;
      axis.levels = {LevelSpec{.text = "off"}, LevelSpec{.text = "on"}};
      axis.levels[1].ablation = params.ablation;
    } else {
      ReadRange(value, params, path, axis);
    }
    if (given == 1 && (value.Find("from") != nullptr || value.Find("to") != nullptr ||
                       value.Find("steps") != nullptr)) {
      Add(path, "has a range beside its levels", "remove from, to and steps");
    }
  }

  void ReadValues(JsonValue& value, const std::string& path, AxisSpec& axis) {
    DescribeParameter(path, axis);
    axis.axis.numeric = true;
    for (const JsonValue* element : Elements(value, "values", path)) {
      LevelSpec level{.text = LevelText(*element)};
      if (element->IsNumber()) level.number = element->number();
      axis.axis.numeric = axis.axis.numeric && level.number.has_value();
      level.settings.Set(axis.path, *element);
      axis.levels.push_back(std::move(level));
    }
  }

  void ReadScenarios(JsonValue& value, const std::string& path, AxisSpec& axis) {
    if (axis.axis.name.empty()) axis.axis.name = "scenario";
    for (JsonValue* element : Elements(value, "scenarios", path)) {
      const std::string at = fmt::format("{}.scenarios[{}]", path, axis.levels.size());
      LevelSpec level;
      if (!element->Is(Type::kText)) {
        Add(at, fmt::format("is {}, not the name of a file", core::Abbreviate(*element)),
            "write a path relative to this file");
      } else {
        level.text = fs::path(element->text()).stem().string();
        level.scenario = std::make_shared<const JsonValue>(LoadScenarioFile(element->text(), at));
      }
      axis.levels.push_back(std::move(level));
    }
  }

  // What is known of the parameter that an axis varies; nullptr where the path is that of a group
  // or of nothing.
  const core::ParameterInfo* DescribeParameter(const std::string& path, AxisSpec& axis) {
    const auto found = std::find_if(
        parameters_.begin(), parameters_.end(),
        [&](const core::ParameterInfo& parameter) { return parameter.path == axis.path; });
    if (found == parameters_.end()) {
      const std::string group = axis.path + ".";
      const bool is_group = std::any_of(
          parameters_.begin(), parameters_.end(),
          [&](const core::ParameterInfo& parameter) { return parameter.path.starts_with(group); });
      if (!is_group) {
        Add(path + ".path", fmt::format("is {}, which is no parameter", axis.path.substr(0, 80)),
            Nearest(axis.path));
      }
      return nullptr;
    }
    axis.axis.unit = found->unit;
    axis.whole = found->kind == core::FieldKind::kInteger;
    return &*found;
  }

  std::string Nearest(const std::string& path) const {
    std::vector<std::string_view> names;
    for (const core::ParameterInfo& parameter : parameters_) names.push_back(parameter.path);
    const std::string_view nearest = core::Nearest(path, names);
    return nearest.empty() ? "rockyard parameters SCENARIO lists them"
                           : fmt::format("did you mean \"{}\"?", nearest);
  }

  // From "from" to "to", or over the study range of the parameter.
  void ReadRange(const JsonValue& value, const AxisParams& params, const std::string& path,
                 AxisSpec& axis) {
    axis.axis.numeric = true;
    const core::ParameterInfo* parameter = DescribeParameter(path, axis);
    if (parameter == nullptr) return;
    const bool known = value.Find("from") != nullptr && value.Find("to") != nullptr;
    if (!known && !parameter->HasStudyRange()) {
      Add(path, "has neither values nor a range, and the parameter has no study range",
          "write \"values\", or \"from\" and \"to\"");
      return;
    }
    axis.from = value.Find("from") != nullptr ? params.from : parameter->study_low;
    axis.to = value.Find("to") != nullptr ? params.to : parameter->study_high;
    if (!(axis.from < axis.to)) {
      Add(path + ".to", fmt::format("is {}, not above from, {}", axis.to, axis.from),
          "write the smaller value first");
    } else if (params.scale == AxisScale::kLog && axis.from <= 0.0) {
      Add(path + ".from", fmt::format("is {}, which has no logarithm", axis.from),
          "use a positive value, or scale linear");
    } else if (value.Find("steps") != nullptr) {
      const auto last = static_cast<double>(params.steps - 1);
      std::vector<LevelSpec> levels;
      for (std::int64_t i = 0; i < params.steps; ++i) {
        levels.push_back(axis.At(static_cast<double>(i) / last));
      }
      axis.levels = std::move(levels);
    }
  }

  // Names decide cells' names and seeds, so that two equal ones cannot be.
  void CheckLevels(const AxisSpec& axis, const std::string& path) {
    for (std::size_t i = 0; i < axis.levels.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (axis.levels[i].text != axis.levels[j].text) continue;
        Add(path, fmt::format("has the level \"{}\" twice", axis.levels[i].text.substr(0, 80)),
            "keep one of them");
        return;
      }
    }
  }

  const fs::path& folder_;
  std::vector<Problem>& problems_;
  std::vector<core::ParameterInfo> parameters_;
};

}  // namespace

SweepSpec ReadSweepSpec(JsonValue document, const fs::path& folder,
                        std::vector<Problem>& problems) {
  return SpecReader(folder, problems).Read(std::move(document));
}

}  // namespace rockyard::scenario
