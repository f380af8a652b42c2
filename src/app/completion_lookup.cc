#include "app/completion_lookup.h"

#include <filesystem>
#include <utility>

#include "app/run_folders.h"
#include "app/scenario_names.h"
#include "core/field_table.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

std::vector<std::string> ValuesOf(const core::ParameterInfo& parameter) {
  if (parameter.kind == core::FieldKind::kBoolean) return {"true", "false"};
  return parameter.choices;
}

std::vector<std::string> Settings(std::string_view typed) {
  const bool has_path = typed.find('=') != std::string_view::npos;
  std::vector<std::string> words;
  for (const core::ParameterInfo& parameter : scenario::ListParameters()) {
    const std::string path = parameter.path + "=";
    if (!has_path) {
      words.push_back(path);
    } else if (typed.starts_with(path)) {
      for (const std::string& value : ValuesOf(parameter)) words.push_back(path + value);
    }
  }
  return words;
}

std::vector<std::string> Runs() {
  std::vector<std::string> words;
  for (const std::filesystem::path& run : RunFolders("results/runs")) {
    words.push_back(run.generic_string());
  }
  return words;
}

// The shortest ones, or paths for somebody who types one.
std::vector<std::string> Names(Wanted wanted, std::string_view typed) {
  return typed.find('/') == std::string_view::npos ? ScenarioNames(wanted) : ScenarioPaths(wanted);
}

std::vector<std::string> WordsOf(std::string_view kind, std::string_view typed) {
  if (kind == "settings") return Settings(typed);
  if (kind == "scenarios") return Names(Wanted::kScenario, typed);
  if (kind == "sweeps") return Names(Wanted::kSweep, typed);
  if (kind == "rovers") return Names(Wanted::kRover, typed);
  return kind == "runs" ? Runs() : std::vector<std::string>();
}

}  // namespace

std::vector<std::string> LookUp(std::string_view asked) {
  const std::size_t colon = asked.find(':');
  if (colon == std::string_view::npos) return {};
  const std::string_view typed = asked.substr(colon + 1);
  std::vector<std::string> words = WordsOf(asked.substr(0, colon), typed);
  std::erase_if(words, [&](const std::string& word) { return !word.starts_with(typed); });
  return words;
}

std::vector<std::string> LookupKinds(std::string_view positional) {
  std::vector<std::string> kinds;
  for (const auto& [part, kind] :
       {std::pair{"SCENARIO", "scenarios"}, std::pair{"SWEEP", "sweeps"},
        std::pair{"ROVER", "rovers"}, std::pair{"RUN", "runs"}, std::pair{"SHARD", "runs"}}) {
    if (positional.find(part) != std::string_view::npos) kinds.emplace_back(kind);
  }
  return kinds;
}

}  // namespace rockyard::app
