#include "campaign/baseline_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/json_text.h"
#include "scenario/load.h"

namespace rockyard::campaign {
namespace {

using batch::ScenarioDifference;

// A setting, or a group of them that is new as a whole.
bool AtDefault(const std::string& path, const std::vector<ScenarioDifference>& from_defaults) {
  return std::none_of(from_defaults.begin(), from_defaults.end(), [&](const auto& each) {
    return each.path == path || each.path.starts_with(path + ".");
  });
}

bool DecidesFields(const std::string& path) {
  return path.starts_with("terrain.") || path.starts_with("course.");
}

}  // namespace

BaselineScenario CompareWithBaseline(const std::string& baseline, const std::string& run) {
  const std::vector<ScenarioDifference> from_defaults =
      batch::FindScenarioDifferences(scenario::DefaultsJson(), run);
  BaselineScenario compared;
  for (ScenarioDifference& each : batch::FindScenarioDifferences(baseline, run)) {
    if (each.path == "seed") continue;
    if (each.first == "absent" && AtDefault(each.path, from_defaults)) {
      compared.younger.push_back(std::move(each.path));
      continue;
    }
    if (DecidesFields(each.path)) compared.same_fields = false;
    compared.differences.push_back(std::move(each));
  }
  return compared;
}

std::vector<core::Problem> SharedLayoutProblems(const std::string& label,
                                                const std::string& resolved) {
  const core::JsonValue document = core::ParseJson(resolved, "resolved scenario");
  const core::JsonValue* course = document.Find("course");
  const core::JsonValue* group = course == nullptr ? nullptr : course->Find("trials_per_layout");
  if (group == nullptr || !group->IsNumber() || group->number() <= 1.0) return {};
  return {
      {label,
       fmt::format("has {:g} trials on each field of rocks: they are not independent, so that "
                   "no false-alarm rate holds",
                   group->number()),
       "run it anew, by `rockyard run` or `rockyard sweep` with --set course.trials_per_layout=1"}};
}

}  // namespace rockyard::campaign
