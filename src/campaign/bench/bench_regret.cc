#include "campaign/bench/bench_regret.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "batch/executor.h"
#include "batch/parallel_tasks.h"
#include "core/error.h"
#include "core/json_text.h"
#include "scenario/load.h"
#include "terrain/field.h"
#include "trial/course/layout.h"
#include "trial/course/route_planner.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

constexpr double kNoWay = std::numeric_limits<double>::quiet_NaN();

// A cell whose layouts are to be driven.
struct OptimistCourse {
  trial::DriveParams drive;
  std::uint64_t seed = 0;
  double range_m = 0.0;
  std::vector<truth::Record> records;
};

// Returns how far the cameras see; nothing where the cell is no case for an optimist.
std::optional<double> RangeOf(const trial::DriveParams& drive) {
  const terrain::GroundParams& ground = drive.terrain.ground;
  const terrain::RockFieldKind kind = drive.terrain.rocks.kind;
  const bool drawn =
      kind == terrain::RockFieldKind::kNone || kind == terrain::RockFieldKind::kListed;
  const sensing::StereoParams* cameras = drive.sensors.terrain_sensors.chosen().cameras(drive);
  if (cameras == nullptr || drawn || ground.elevation.IsGiven() || ground.HasDepressions() ||
      drive.course.Goals().size() != 1 || drive.course.target_speed_m_s != 0.0 ||
      drive.course.goal_rock.enabled) {
    return std::nullopt;
  }
  return cameras->max_range_m;
}

// Returns the way on a layout. Throws core::UserError where its rocks are not those of the record.
double WayOn(const OptimistCourse& course, const truth::Record& record, std::size_t rocks,
             std::size_t cover) {
  const core::TrialKey key{course.seed, static_cast<std::uint32_t>(record.trial)};
  const trial::CourseParams& params = course.drive.course;
  const terrain::Field field = terrain::BuildField(
      course.drive.terrain, trial::LayoutKey(course.drive, key), trial::TerrainCourse(params));
  const bool known = !record.values.empty();
  if (known && (record.values.at(rocks) != static_cast<double>(field.terrain.rocks().size()) ||
                record.values.at(cover) != field.audit.outline_cover)) {
    throw core::UserError("rocks", "are others than those that were driven among", "");
  }
  return trial::OptimisticWay_m(course.drive, field.terrain.rocks(),
                                {params.goal_x_m, params.goal_y_m}, course.range_m)
      .value_or(kNoWay);
}

// Returns what decides the way of a cell: cells that differ in the rest of a navigator's task share
// it.
std::string CourseText(const core::JsonValue& resolved, std::uint64_t seed, double range_m) {
  std::string text = fmt::format("{} {}", seed, range_m);
  for (const char* group : {"terrain", "course", "rover"}) {
    if (const core::JsonValue* found = resolved.Find(group)) text += core::CompactJson(*found);
  }
  return text;
}

}  // namespace

OptimisticWays MakeOptimisticWays(const batch::ResultStore& store) {
  OptimisticWays made;
  const auto& cells = store.identity().cells;
  std::vector<OptimistCourse> courses;
  std::map<std::string, std::size_t> known;
  std::vector<std::optional<std::size_t>> course_of(cells.size());
  struct Task {
    std::size_t course;
    std::size_t layout;
    double way_m = kNoWay;
  };
  std::vector<Task> tasks;
  try {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const core::JsonValue resolved = core::ParseJson(cells[i].resolved, cells[i].name);
      // Who navigates does not matter: plugins are not opened.
      scenario::Scenario scenario = scenario::ReadScenarioSealed(resolved);
      const std::optional<double> range_m = RangeOf(scenario.drive);
      if (!range_m) continue;
      const auto [at, anew] =
          known.emplace(CourseText(resolved, cells[i].seed, *range_m), courses.size());
      course_of[i] = at->second;
      if (!anew) continue;
      courses.push_back(
          {std::move(scenario.drive), cells[i].seed, *range_m, store.Load(static_cast<int>(i))});
      for (std::size_t layout = 0; layout < courses.back().records.size(); ++layout) {
        tasks.push_back({at->second, layout});
      }
    }
    const truth::RecordSchema& schema = store.identity().schema;
    const auto place = [&](std::string_view name) {
      return static_cast<std::size_t>(truth::FindColumn(schema, name) - schema.data());
    };
    const std::size_t rocks = place("rocks");
    const std::size_t cover = place("rock_cover");
    const std::atomic<bool> never = false;
    batch::RunTasks(tasks.size(), batch::ThreadCount({}), never, [&](std::size_t i) {
      const OptimistCourse& course = courses[tasks[i].course];
      tasks[i].way_m = WayOn(course, course.records[tasks[i].layout], rocks, cover);
    });
  } catch (const core::UserError& error) {
    made.why_none = fmt::format("no regret is told: {} {}", error.problems().front().path,
                                error.problems().front().reason);
  }
  std::vector<std::vector<double>> by_course(courses.size());
  for (const Task& task : tasks) by_course[task.course].push_back(task.way_m);
  for (const std::optional<std::size_t>& course : course_of) {
    const bool told = course && made.why_none.empty();
    made.ways_m.push_back(
        told ? by_course[*course]
             : std::vector<double>(static_cast<std::size_t>(store.planned()), kNoWay));
  }
  return made;
}

}  // namespace rockyard::campaign
