#include "app/terrain_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/fields.h"
#include "statistics/proportions.h"
#include "terrain/field.h"
#include "trial/course/layout.h"

namespace rockyard::app {
namespace {

using terrain::CorridorClass;
using terrain::LineRule;
using terrain::OverlapRule;

// Returns how far the swath gets in each field, ascending. Fields are independent, also where
// trials of the scenario share layouts.
std::vector<double> Distances(const scenario::Scenario& scenario, std::uint64_t seed,
                              std::int64_t fields, const terrain::BlindSwath& swath,
                              double first_x_m) {
  std::vector<double> distances;
  for (std::int64_t i = 0; i < fields; ++i) {
    const terrain::Field field =
        terrain::BuildField(scenario.drive.terrain, {seed, static_cast<std::uint32_t>(i)},
                            trial::TerrainCourse(scenario.drive.course));
    const std::vector<terrain::Rock> rocks(field.terrain.rocks().begin(),
                                           field.terrain.rocks().end());
    const double contact_m =
        terrain::FirstContact_m(rocks, swath, first_x_m, scenario.drive.course.start_y_m);
    distances.push_back(contact_m - first_x_m);
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

template <class Enum>
std::string_view Name(Enum value) {
  return core::EnumNames<Enum>::kNames[static_cast<std::size_t>(value)];
}

struct Rules {
  LineRule line;
  OverlapRule overlap;
};

// Returns every pair of rules that gives fields of its own: rocks that may overlap may cross a line
// under either line rule, fields of an exact count leave no rock out, and without mirror lines the
// line rule says nothing.
std::vector<Rules> RulesOf(const terrain::TerrainParams& params) {
  std::vector<LineRule> lines{LineRule::kMerge};
  if (params.arena.IsVirtual()) lines.push_back(LineRule::kKeepOff);
  std::vector<Rules> rules;
  for (const LineRule line : lines) {
    rules.push_back({line, OverlapRule::kRelocate});
    if (params.rocks.FollowsLaw()) {
      rules.push_back({line, OverlapRule::kReject});
    }
    if (line == LineRule::kMerge) rules.push_back({line, OverlapRule::kAllow});
  }
  return rules;
}

std::vector<CorridorClass> Counted(const terrain::TerrainParams& params,
                                   const terrain::Course& course, std::uint64_t seed,
                                   std::int64_t fields) {
  std::vector<CorridorClass> classes = terrain::ExpectedInCorridor(params, course);
  for (std::int64_t i = 0; i < fields; ++i) {
    const terrain::Field field =
        terrain::BuildField(params, {seed, static_cast<std::uint32_t>(i)}, course);
    // Mirror images of rocks are not counted: they lie beyond the lines, and the corridor between
    // them.
    terrain::CountInCorridor(field.terrain.rocks(), course, classes);
  }
  return classes;
}

std::string Rows(const terrain::TerrainParams& params, const terrain::Course& course,
                 std::uint64_t seed, std::int64_t fields) {
  const bool lines = params.arena.IsVirtual();
  std::string text;
  for (const CorridorClass& c : Counted(params, course, seed, fields)) {
    const double expected = c.expected * static_cast<double>(fields);
    const statistics::Interval interval = statistics::PoissonInterval(c.observed);
    text +=
        fmt::format("  {:<11} {:<8} {:8.2f} .. {:.2f} {:10.1f} {:9} {:7.3f}  {:.3f} .. {:.3f}\n",
                    lines ? Name(params.rocks.mirror_line) : "none", Name(params.rocks.overlap),
                    c.from_m, c.to_m, expected, c.observed, c.observed / expected,
                    interval.low / expected, interval.high / expected);
  }
  return text;
}

}  // namespace

terrain::BlindSwath SwathOf(const scenario::Scenario& scenario) {
  const terrain::RockFieldParams& rocks = scenario.drive.terrain.rocks;
  const double height_ratio = 0.5 * (rocks.min_height_ratio + rocks.max_height_ratio);
  return {scenario.drive.rover.geometry.width_m, scenario.drive.rover.geometry.belly_clearance_m /
                                                     (height_ratio * (1.0 - rocks.burial_mean))};
}

std::string BlindSwathText(const scenario::Scenario& scenario, std::uint64_t seed,
                           std::int64_t fields, const terrain::BlindSwath& swath) {
  const trial::CourseParams& course = scenario.drive.course;
  if (!course.waypoints.x_m.empty()) {
    throw core::UserError("course.waypoints.x_m",
                          "names waypoints, whose clear zones the law of the swath does not know",
                          "leave the waypoints out: --set course.waypoints={}");
  }
  const double clear_m = scenario.drive.terrain.rocks.clear_radius_m;
  const double first_x_m = course.start_x_m + clear_m;
  const double length_m = course.goal_x_m - clear_m - first_x_m;
  if (length_m <= 0.0) {
    throw core::UserError("course.goal_x_m", "leaves no way along +x between the clear zones",
                          "use a goal farther along +x from the start");
  }
  const double per_m = terrain::BlindContactsPerM(scenario.drive.terrain.rocks, swath);
  const std::vector<double> distances = Distances(scenario, seed, fields, swath, first_x_m);
  std::string text = fmt::format(
      "blind swath of {:.2f} m, rocks of {:.3f} m and more across: {:.4f} contacts per m by the "
      "law",
      swath.width_m, swath.min_diameter_m, per_m);
  text += per_m > 0.0 ? fmt::format(", lambda {:.2f} m\n", 1.0 / per_m) : "\n";
  text += fmt::format("  {} fields, from {:.1f} m behind the start on\n", fields, clear_m);
  text += "  clear to [m]   closed form [%]   fields [%]   95 % interval\n";
  constexpr int kRows = 8;
  for (int i = 1; i <= kRows; ++i) {
    const double x_m = length_m * i / kRows;
    const auto clear = distances.end() - std::lower_bound(distances.begin(), distances.end(), x_m);
    const statistics::Proportion rate = statistics::MakeProportion(clear, fields);
    text += fmt::format("  {:12.2f} {:17.1f} {:12.1f}   {:.1f} .. {:.1f}\n", x_m,
                        100.0 * std::exp(-per_m * x_m), 100.0 * rate.rate,
                        100.0 * rate.interval.low, 100.0 * rate.interval.high);
  }
  return text;
}

std::string CorridorDensityText(const scenario::Scenario& scenario, std::uint64_t seed,
                                std::int64_t fields) {
  terrain::TerrainParams params = scenario.drive.terrain;
  const terrain::Course course = trial::TerrainCourse(scenario.drive.course);
  if (terrain::ExpectedInCorridor(params, course).empty()) {
    throw core::UserError(
        "terrain", "has no expected density of rocks along the course to compare with",
        "use rocks of kind moore, golombek or uniform_count, a course straight along x, and a "
        "layout at least 0.5 m wide on either side of it");
  }
  std::string text = fmt::format(
      "rock centres within {:.1f} m of the course, {} fields, against the law outside the clear "
      "zones\n  mirror_line overlap  diameter [m]    expected  observed   ratio  95 %\n",
      terrain::kCorridorHalfWidth_m, fields);
  for (const auto& [line, overlap] : RulesOf(params)) {
    params.rocks.mirror_line = line;
    params.rocks.overlap = overlap;
    text += Rows(params, course, seed, fields);
  }
  return text;
}

}  // namespace rockyard::app
