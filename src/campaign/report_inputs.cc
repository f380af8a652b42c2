#include "campaign/report_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "batch/run_folder.h"
#include "campaign/output_folder.h"
#include "core/error.h"
#include "core/json_text.h"
#include "report/parameter_table.h"
#include "report/trial_outcomes.h"
#include "scenario/load.h"
#include "terrain/arena.h"
#include "terrain/contours.h"
#include "terrain/ground.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Returns the path whole and without a trailing separator, so that its last part is the name of the
// folder.
fs::path Absolute(const fs::path& folder) {
  std::error_code error;
  fs::path path = fs::weakly_canonical(folder, error);
  if (error) path = fs::absolute(folder, error).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

// Returns the names of a folder, from short to long: "nominal", "runs/nominal",
// "results/runs/nominal", ...
std::vector<std::string> FolderNames(const fs::path& folder) {
  std::vector<std::string> names;
  fs::path name;
  fs::path rest = Absolute(folder);
  for (; rest.has_filename(); rest = rest.parent_path()) {
    name = name.empty() ? rest.filename() : rest.filename() / name;
    names.push_back(name.string());
  }
  if (names.empty()) names.push_back(folder.string());
  return names;
}

std::vector<std::string> With(std::vector<std::string> names, const std::string& cell) {
  for (std::string& name : names) name += ": " + cell;
  return names;
}

ReportInput Open(const fs::path& folder, const std::string& cell) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  ReportInput input;
  input.folder = folder;
  input.cell = cell;
  if (!store.identity().shard.whole() || !cell.empty()) {
    // ReadRun says what is wrong, the same way as for every other command.
    const StoredRun run = ReadRun(folder, cell.empty() ? "0" : cell);
    RequireWhole(run);
    input.cells = {run.identity.name};
    return input;
  }
  input.sweep = !store.identity().design.empty();
  for (const batch::CellIdentity& each : store.identity().cells) input.cells.push_back(each.name);
  return input;
}

void AddLabels(std::vector<ReportInput>& inputs) {
  std::vector<std::vector<std::string>> candidates;
  for (const ReportInput& input : inputs) {
    const std::vector<std::string> folders = FolderNames(input.folder);
    const bool one_cell = !input.sweep && !input.cells.front().empty();
    candidates.push_back(one_cell ? With(folders, input.cells.front()) : folders);
    for (std::size_t i = 0; input.sweep && i < input.cells.size(); ++i) {
      candidates.push_back(With(folders, input.cells[i]));
      candidates.back().insert(candidates.back().begin(), input.cells[i]);
    }
  }
  const std::vector<std::string> labels = UniqueLabels(candidates);
  auto next = labels.begin();
  for (ReportInput& input : inputs) {
    input.label = *next++;
    const auto end = next + (input.sweep ? static_cast<std::ptrdiff_t>(input.cells.size()) : 0);
    input.cell_labels.assign(next, end);
    next = end;
  }
}

// Returns the name of the rover, where it has one: Rocky 3.2 is the default of every parameter of a
// rover's shape.
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

std::vector<std::string> UniqueLabels(const std::vector<std::vector<std::string>>& candidates) {
  std::vector<std::size_t> level(candidates.size(), 0);
  const auto label = [&](std::size_t i) { return candidates[i][level[i]]; };
  // Every round makes a label longer, so that it ends.
  for (bool changed = true; changed;) {
    changed = false;
    std::map<std::string, int> uses;
    for (std::size_t i = 0; i < candidates.size(); ++i) ++uses[label(i)];
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (uses[label(i)] < 2 || level[i] + 1 >= candidates[i].size()) continue;
      ++level[i];
      changed = true;
    }
  }
  std::vector<std::string> labels;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::string unique = label(i);
    for (int number = 2; !taken.insert(unique).second; ++number) {
      unique = fmt::format("{} ({})", label(i), number);
    }
    labels.push_back(unique);
  }
  return labels;
}

std::vector<ReportInput> FindReportInputs(const std::vector<std::string>& paths,
                                          const std::string& cell) {
  std::vector<ReportInput> inputs;
  std::vector<core::Problem> problems;
  std::set<fs::path> known;
  for (const std::string& path : paths) {
    try {
      for (const fs::path& folder : batch::FindRuns(path)) {
        if (!known.insert(Absolute(folder)).second) {
          throw core::UserError(folder.string(), "is named twice", "name each run once");
        }
        inputs.push_back(Open(folder, cell));
      }
    } catch (const core::UserError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  AddLabels(inputs);
  return inputs;
}

std::optional<scenario::Scenario> ScenarioOf(const StoredRun& run) {
  try {
    return scenario::ReadScenarioSealed(
        core::ParseJson(run.identity.resolved, "resolved scenario"));
  } catch (const core::UserError&) {
    return std::nullopt;
  }
}

std::vector<core::ParameterInfo> ParametersOf(const StoredRun& run) {
  const auto scenario = ScenarioOf(run);
  if (!scenario) return {};
  return scenario::ListParameters(*scenario);
}

// Returns the part of the arena around the course where most paths lead.
terrain::Rectangle MapArea(const terrain::ArenaParams& arena, const report::PageCourse& course) {
  constexpr double kBeside_m = 4.0;
  terrain::Rectangle area = terrain::DrivableBounds(arena);
  std::vector<messages::Goal> places = course.waypoints;
  places.push_back(course.goal);
  places.push_back({course.start.x_m, course.start.y_m});
  const auto [west, east] = std::ranges::minmax(places, {}, &messages::Goal::x_m);
  const auto [south, north] = std::ranges::minmax(places, {}, &messages::Goal::y_m);
  area.x_min_m = std::max(area.x_min_m, west.x_m - kBeside_m);
  area.x_max_m = std::min(area.x_max_m, east.x_m + kBeside_m);
  area.y_min_m = std::max(area.y_min_m, south.y_m - kBeside_m);
  area.y_max_m = std::min(area.y_max_m, north.y_m + kBeside_m);
  return area;
}

// Adds what the map shows of an elevation model, which is the same in every trial; roughness is
// not.
void AddContours(const terrain::TerrainParams& terrain, report::PageCourse& shown) {
  constexpr int kMostHeights = 20;
  constexpr int kCells = 4000;
  if (!terrain.ground.elevation.IsGiven()) return;
  terrain::GroundParams smooth = terrain.ground;
  smooth.roughness_rms_m = 0.0;
  const terrain::ContourMap map = terrain::Contours(
      terrain::Ground(smooth, {}), MapArea(terrain.arena, shown), kMostHeights, kCells);
  shown.contour_interval_m = map.interval_m;
  for (const terrain::Contour& contour : map.lines) {
    report::PageContour line{.height_m = contour.height_m, .line = {}};
    for (const terrain::CoursePoint& point : contour.line) {
      line.line.push_back({point.x_m, point.y_m});
    }
    shown.contours.push_back(std::move(line));
  }
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
                           .mirror_lines_m = {},
                           .contours = {}};
  AddContours(scenario->drive.terrain, shown);
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
    scenario::Sweep sweep = StoredSweep(store);
    if (sweep.cells.size() == static_cast<std::size_t>(store.cells())) return sweep;
  } catch (const core::UserError&) {
    // Said below: problems of the design are about a file that the user has not got.
  }
  throw core::UserError(folder.string(),
                        "holds a sweep that this version of the program reads differently",
                        "use the program that made it: " + store.Builds().front());
}

}  // namespace rockyard::campaign
