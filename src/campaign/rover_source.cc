#include "campaign/rover_source.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "campaign/run_source.h"
#include "campaign/scenario_list.h"
#include "campaign/scenario_names.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "report/line_text.h"
#include "scenario/load.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Returns whether the first character of a file that is no blank is that of XML. What cannot be
// read is for the reader of scenarios to refuse.
bool IsXmlFile(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  constexpr std::size_t kHead = 256;
  std::string head(kHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(kHead));
  head.resize(static_cast<std::size_t>(file.gcount()));
  constexpr std::string_view kMark = "\xef\xbb\xbf";  // which editors put before UTF-8
  if (head.starts_with(kMark)) head.erase(0, kMark.size());
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string::npos && head[first] == '<';
}

scenario::Scenario ScenarioOfGroup(const fs::path& file, const core::JsonValue& group,
                                   const std::vector<std::string>& overrides,
                                   core::JsonValue& changed) {
  core::JsonValue document = core::JsonValue::Object();
  document.Set("name", core::JsonValue(file.stem().string()));
  document.Set("rover", group);
  for (const std::string& assignment : overrides) core::ApplyOverride(document, assignment);
  changed = *document.Find("rover");
  return scenario::ReadScenario(document);
}

RoverSource OfScenario(const scenario::Scenario& scenario) {
  return {scenario.name,
          scenario.drive.rover,
          core::WriteParams(scenario.drive.rover),
          {},
          scenario.drive.terrain.ground.soil};
}

RoverSource OfUrdf(const fs::path& file, const std::vector<std::string>& overrides) {
  RoverSource source;
  source.reading = rover::ReadUrdf(core::ReadTextFile(file, rover::kMostUrdfBytes, "a URDF file"),
                                   file.string());
  source.name = file.stem().string();
  try {
    const scenario::Scenario scenario =
        ScenarioOfGroup(file, source.reading->group, overrides, source.group);
    source.params = scenario.drive.rover;
    source.soil = scenario.drive.terrain.ground.soil;
  } catch (const core::MachineError&) {
    throw;
  } catch (const core::UserError& error) {
    std::vector<core::Problem> problems = source.reading->WithPlaces(error.problems());
    for (core::Problem& problem : problems) {
      problem.path = fmt::format("{}: {}", file.string(), problem.path);
    }
    throw core::UserError(std::move(problems));
  }
  return source;
}

// Returns the member at a dotted path, or nullptr.
const core::JsonValue* At(const core::JsonValue& value, std::string_view path) {
  const core::JsonValue* at = &value;
  while (at != nullptr && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    at = at->Find(path.substr(0, dot));
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return at;
}

}  // namespace

RoverSource LoadRover(const std::string& word, const std::vector<std::string>& overrides) {
  const fs::path file = ScenarioFile(word, Wanted::kRover);
  std::error_code error;
  if (fs::is_directory(file, error)) {
    return OfScenario(LoadScenarioFrom(file, overrides));
  }
  if (IsXmlFile(file)) return OfUrdf(file, overrides);
  const core::JsonValue group = core::LoadJsonFile(file);
  if (!IsGroup(group)) return OfScenario(LoadScenarioFrom(file, overrides));
  core::JsonValue changed;
  return OfScenario(ScenarioOfGroup(file, group, overrides, changed));
}

std::string LeftOutText(const RoverSource& source) {
  std::string text;
  if (!source.reading->not_taken.empty()) {
    text += "the file says, and rockyard's rover has not:\n";
  }
  for (const core::Problem& each : source.reading->not_taken) {
    text += fmt::format("  {} {}\n", report::Printable(each.path), report::Printable(each.reason));
  }
  text += "the file does not say, so that the default stays until a scenario says it:\n";
  for (const core::ParameterInfo& parameter : source.reading->left_out) {
    if (At(source.group, parameter.path) != nullptr) continue;  // --set says it
    text += fmt::format("  rover.{} = {}\n", parameter.path, core::Abbreviate(parameter.value));
  }
  return report::Wrapped(text);
}

}  // namespace rockyard::campaign
