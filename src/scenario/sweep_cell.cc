#include "scenario/sweep_cell.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "core/json_file.h"
#include "core/json_text.h"
#include "math/angles.h"
#include "scenario/ablations.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

using core::JsonValue;
using core::Problem;
using Type = JsonValue::Type;

// Returns whether a number was kept. Angles are kept in radians and written with the fewest digits
// that read back to the same bits.
bool SameNumber(double asked, double found, std::string_view path) {
  if (asked == found) return true;
  const bool angle = path.ends_with("deg");
  return angle && math::DegToRad(asked) == math::DegToRad(found);
}

// Compares what was asked for with what the resolved scenario holds, down to single values.
void ReadBack(const JsonValue& asked, const JsonValue& document, const std::string& path,
              std::vector<Problem>& problems) {
  const JsonValue* found = FindPath(document, path);
  if (found == nullptr) {
    problems.push_back(
        {path, "was set, but the resolved scenario has no such value", "check the path"});
    return;
  }
  if (asked.Is(Type::kObject)) {
    for (const core::JsonMember& member : asked.members()) {
      ReadBack(member.value, document, fmt::format("{}.{}", path, member.key), problems);
    }
    return;
  }
  const bool same = asked.IsNumber() && found->IsNumber()
                        ? SameNumber(asked.number(), found->number(), path)
                        : core::DumpJson(asked) == core::DumpJson(*found);
  if (same) return;
  problems.push_back({path,
                      fmt::format("was set to {}, but is {} in the resolved scenario",
                                  core::Abbreviate(asked), core::Abbreviate(*found)),
                      "another setting, axis or --set lies over it: keep one of them"});
}

// Refuses settings of what a cell gets from the sweep.
void CheckScope(std::string_view path, std::vector<Problem>& problems) {
  for (const std::string_view key : {"name", "seed", "trials"}) {
    if (path != key) continue;
    problems.push_back({std::string(path), "is set, but cells get it from the sweep",
                        fmt::format("write \"{}\" beside \"axes\"", key)});
  }
}

// Refuses experiments that no sweep can be of.
void CheckExperiment(const Scenario& scenario, std::vector<Problem>& problems) {
  const std::string_view name = scenario.experiment.chosen().name();
  if (name == "drive") return;
  problems.push_back({"experiment",
                      fmt::format("is {}, whose studies have factors of their own", name),
                      "use rockyard run, or sweep drives"});
}

std::shared_ptr<const JsonValue> BaseOf(const SweepSpec& spec,
                                        const std::vector<LevelSpec>& levels) {
  std::shared_ptr<const JsonValue> base = spec.scenario;
  for (const LevelSpec& level : levels) {
    if (level.scenario != nullptr) base = level.scenario;
  }
  return base;
}

std::vector<std::string> AblationsOf(const std::vector<LevelSpec>& levels) {
  std::vector<std::string> names;
  for (const LevelSpec& level : levels) {
    if (!level.ablation.empty()) names.push_back(level.ablation);
  }
  return names;
}

}  // namespace

const JsonValue* FindPath(const JsonValue& document, std::string_view path) {
  const JsonValue* at = &document;
  while (at != nullptr && !path.empty()) {
    const std::size_t dot = path.find('.');
    at = at->Find(path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return at;
}

ResolvedCell ResolveCell(const SweepSpec& spec, const std::vector<LevelSpec>& levels) {
  ResolvedCell cell;
  const std::shared_ptr<const JsonValue> base = BaseOf(spec, levels);
  JsonValue document = base == nullptr ? JsonValue::Object() : *base;
  std::vector<std::pair<std::string, JsonValue>> asked;
  const auto apply = [&](const JsonValue& settings) {
    for (const core::JsonMember& member : settings.members()) {
      core::SetPath(document, member.key, member.value);
      asked.emplace_back(member.key, member.value);
    }
  };
  apply(spec.settings);
  for (const LevelSpec& level : levels) apply(level.settings);
  cell.scenario = spec.sealed ? ReadScenarioSealed(document, spec.defaults)
                              : ReadScenario(document, spec.defaults);
  cell.document = WriteScenario(cell.scenario);
  CheckExperiment(cell.scenario, cell.problems);
  for (const auto& [path, value] : asked) {
    CheckScope(path, cell.problems);
    // What is read back of plugins has their hashes, too.
    if (path != plugin::kPluginsKey) ReadBack(value, cell.document, path, cell.problems);
  }
  // Ablations go over all settings, which they may replace; WithAblations refuses one that another
  // undoes.
  const std::vector<std::string> ablations = AblationsOf(levels);
  if (ablations.empty()) return cell;
  cell.scenario = WithAblations(cell.scenario, ablations).scenario;
  cell.document = WriteScenario(cell.scenario);
  return cell;
}

}  // namespace rockyard::scenario
