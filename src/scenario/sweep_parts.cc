#include "scenario/sweep_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/json_file.h"
#include "core/json_text.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

using core::JsonValue;
using core::Problem;
using Type = JsonValue::Type;

constexpr std::size_t kLongestName = 100;

std::string Join(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

}  // namespace

void PartReader::Add(std::string path, std::string reason, std::string suggestion) {
  problems_.push_back({std::move(path), std::move(reason), std::move(suggestion)});
}

void PartReader::AddBelow(const std::string& path, const core::UserError& error) {
  for (Problem problem : error.problems()) {
    const bool root = problem.path.starts_with('(');
    if (!path.empty()) problem.path = root ? path : Join(path, problem.path);
    problems_.push_back(std::move(problem));
  }
}

std::vector<JsonValue*> PartReader::Elements(JsonValue& object, std::string_view key,
                                             const std::string& path) {
  std::vector<JsonValue*> elements;
  JsonValue* list = object.Find(key);
  if (list == nullptr) return elements;
  if (!list->Is(Type::kList) || list->list().empty()) {
    Add(Join(path, key), fmt::format("is {}, not a list with elements", core::Abbreviate(*list)),
        "write [...]");
    return elements;
  }
  for (JsonValue& element : list->list()) elements.push_back(&element);
  return elements;
}

JsonValue PartReader::Settings(const JsonValue* set, const std::string& path) {
  if (set == nullptr) return JsonValue::Object();
  if (set->Is(Type::kObject)) return *set;
  Add(path, fmt::format("is {}, not an object", core::Abbreviate(*set)),
      "write {\"terrain.rocks.k_per_m2\": 0.01}");
  return JsonValue::Object();
}

JsonValue PartReader::ScenarioFile(const std::string& name, const std::string& path) {
  try {
    core::JsonValue document = core::LoadJsonFile(folder_ / name);
    AnchorPlugins(document, (folder_ / name).parent_path());
    return document;
  } catch (const core::UserError& error) {
    for (const Problem& problem : error.problems()) {
      Add(path, fmt::format("names {}: {}: {}", name, problem.path, problem.reason),
          problem.suggestion);
    }
    return JsonValue::Object();
  }
}

std::shared_ptr<const JsonValue> PartReader::Base(JsonValue& object, const std::string& path) {
  JsonValue* scenario = object.Find("scenario");
  if (scenario == nullptr) return nullptr;
  const std::string at = Join(path, "scenario");
  if (scenario->Is(Type::kText)) *scenario = ScenarioFile(scenario->text(), at);
  if (!scenario->Is(Type::kObject)) {
    Add(at, fmt::format("is {}, not a scenario", core::Abbreviate(*scenario)),
        "name a scenario file, or write an object");
  } else if (IsSweep(*scenario)) {
    Add(at, "is a sweep, not a scenario", "name a scenario file");
  }
  return std::make_shared<const JsonValue>(*scenario);
}

LevelSpec PartReader::Level(JsonValue& value, const std::string& path) {
  LevelSpec level;
  level.text = Fixed<LevelParams>(value, path, kFreeLevelKeys).name;
  if (!value.Is(Type::kObject)) return level;
  CheckName(level.text, Join(path, "name"));
  level.settings = Settings(value.Find("set"), Join(path, "set"));
  level.scenario = Base(value, path);
  return level;
}

void PartReader::CheckName(const std::string& name, const std::string& path) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (name.empty()) {
    Add(path, "is missing", "give it a name");
  } else if (name.size() > kLongestName) {
    Add(path, fmt::format("has {} bytes", name.size()),
        fmt::format("use at most {}", kLongestName));
  } else if (std::any_of(name.begin(), name.end(), is_control)) {
    Add(path, "holds a control character", "use letters, digits and signs");
  }
}

}  // namespace rockyard::scenario
