#include "campaign/report_facts.h"

#include <algorithm>

#include "campaign/shell_word.h"
#include "core/error.h"
#include "report/example_trials.h"
#include "report/parameter_table.h"
#include "scenario/load.h"
#include "terrain/arena.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

// Rocky 3.2 is the default of every parameter of a rover's shape.
std::string RoverName(const scenario::Scenario& scenario) {
  const auto own = scenario::ListParameters(scenario);
  const auto known = scenario::ListParameters();
  const auto same = [](const core::ParameterInfo& a, const core::ParameterInfo& b) {
    return !a.path.starts_with("rover.geometry.") ||
           (a.path == b.path && report::ParameterValue(a) == report::ParameterValue(b));
  };
  return std::equal(own.begin(), own.end(), known.begin(), known.end(), same) ? "Rocky 3.2" : "";
}

}  // namespace

std::optional<scenario::Scenario> ScenarioOf(const StoredRun& run) {
  try {
    return scenario::ParseScenario(run.identity.resolved);
  } catch (const core::UserError&) {
    return std::nullopt;
  }
}

std::vector<core::ParameterInfo> ParametersOf(const StoredRun& run) {
  const auto scenario = ScenarioOf(run);
  if (!scenario) return {};
  return scenario::ListParameters(*scenario);
}

std::optional<report::PageCourse> CourseOf(const StoredRun& run) {
  if (truth::IsMeasurement(run.schema)) return std::nullopt;
  const auto scenario = ScenarioOf(run);
  if (!scenario) return std::nullopt;
  const trial::CourseParams& course = scenario->drive.course;
  const terrain::ArenaParams& arena = scenario->drive.terrain.arena;
  report::PageCourse shown{.rover = RoverName(*scenario),
                           .start = course.Start(),
                           .goal = {course.goal_x_m, course.goal_y_m},
                           .goal_radius_m = course.goal_radius_m,
                           .waypoints = course.waypoints.Places(),
                           .mirror_lines_m = {}};
  if (arena.kind == terrain::ArenaKind::kVirtualReflected) {
    shown.mirror_lines_m = {-arena.MirrorLine(), arena.MirrorLine()};
  }
  return shown;
}

std::vector<std::uint64_t> ExamplesOf(const StoredRun& run) {
  if (truth::IsMeasurement(run.schema)) return {};
  return report::ExampleTrials(run.schema, run.prefix());
}

std::string ReplayCommand(const StoredRun& run) {
  std::string command = "rockyard replay " + ShellPath(run.folder.string());
  if (!run.identity.name.empty()) command += " --cell " + ShellWord(run.identity.name);
  return command + " --trial {trial}";
}

scenario::Sweep SweepOf(const batch::ResultStore& store, const std::filesystem::path& folder) {
  try {
    scenario::Sweep sweep = scenario::ParseSweep(store.identity().design);
    if (sweep.cells.size() == static_cast<std::size_t>(store.cells())) return sweep;
  } catch (const core::UserError&) {
    // Said below: its problems are about a file that the user has not got.
  }
  throw core::UserError(folder.string(),
                        "holds a sweep that this version of the program reads differently",
                        "use the program that made it: " + store.Builds().front());
}

}  // namespace rockyard::campaign
