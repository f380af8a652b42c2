// The command `rockyard terrain`: a field of rocks as a file, or tables that check fields of a
// scenario against the laws of terrain/blind_swath.h and terrain/field.h.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "campaign/scenario_names.h"
#include "core/error.h"
#include "core/fields.h"
#include "scenario/scenario.h"
#include "statistics/proportions.h"
#include "terrain/blind_swath.h"
#include "terrain/field.h"
#include "terrain/field_export.h"
#include "trial/course/layout.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
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

// Returns the default swath: as wide as the rover, with the rocks that, at mean shape and burial,
// reach its belly.
terrain::BlindSwath SwathOf(const scenario::Scenario& scenario) {
  const terrain::RockFieldParams& rocks = scenario.drive.terrain.rocks;
  const double height_ratio = 0.5 * (rocks.min_height_ratio + rocks.max_height_ratio);
  return {scenario.drive.rover.geometry.width_m, scenario.drive.rover.geometry.belly_clearance_m /
                                                     (height_ratio * (1.0 - rocks.burial_mean))};
}

// Returns a table of the share of swaths that are clear to some distances: by terrain/blind_swath.h
// and in `fields` fields of the scenario, with Wilson intervals (95 %). Swaths run along +x from
// the end of the start's clear zone to the beginning of the goal's. Fields follow their own overlap
// rule, and so their difference from the closed form shows what that rule does.
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
    if (params.rocks.kind == terrain::RockFieldKind::kMoore) {
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

// Returns a table by placement rule and size class: how many rock centres lie in the corridor in
// `fields` fields of the scenario, how many terrain/field.h lets expect, their ratio, and its exact
// 95 % interval (Poisson; conservative for fields of an exact count). Every placement rule is
// shown, not only the scenario's: keep_off is the negative control, which the table must show as
// off. Throws core::UserError where the corridor has no expectation.
std::string CorridorDensityText(const scenario::Scenario& scenario, std::uint64_t seed,
                                std::int64_t fields) {
  terrain::TerrainParams params = scenario.drive.terrain;
  const terrain::Course course = trial::TerrainCourse(scenario.drive.course);
  if (terrain::ExpectedInCorridor(params, course).empty()) {
    throw core::UserError(
        "terrain", "has no expected density of rocks along the course to compare with",
        "use rocks of kind moore or uniform_count, a course straight along x, and a "
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

struct TerrainOptions {
  std::string scenario;
  std::optional<std::uint64_t> seed;  // absent: the scenario's
  std::uint32_t trial = 0;
  std::vector<std::string> overrides;
  std::string out;
  bool blind_swath = false;
  bool density = false;
  std::optional<double> width_m;
  std::optional<double> min_diameter_m;
  std::int64_t fields = 1000;
};

// Must agree: this order and that of kExtensions in FormatOf.
enum class Format { kJson, kCsv, kObj, kSvg };

Format FormatOf(const std::string& path) {
  constexpr std::array<std::string_view, 4> kExtensions{".json", ".csv", ".obj", ".svg"};
  const std::string extension = fs::path(path).extension().string();
  for (std::size_t i = 0; i < kExtensions.size(); ++i) {
    if (extension == kExtensions[i]) return static_cast<Format>(i);
  }
  throw core::UserError("--out", "has no known extension: " + path,
                        "use a file that ends in .json, .csv, .obj or .svg");
}

std::string Export(Format format, const terrain::Field& field, const terrain::TerrainParams& params,
                   const terrain::Course& course) {
  switch (format) {
    case Format::kJson:
      return terrain::ToJson(field, params, course);
    case Format::kCsv:
      return terrain::ToCsv(field);
    case Format::kObj:
      return terrain::ToObj(field, params);
    case Format::kSvg:
      return terrain::ToSvg(field, params, course);
  }
  return {};
}

void WriteTerrain(const TerrainOptions& options) {
  if (options.out.empty()) {
    throw core::UserError("--out", "is not given",
                          "name a file to write, or ask for --blind-swath or --density");
  }
  const Format format = FormatOf(options.out);
  campaign::CheckOutputFile("--out", options.out);
  const scenario::Scenario scenario =
      campaign::LoadScenarioFrom(campaign::ScenarioFile(options.scenario), options.overrides);
  const std::uint64_t seed = options.seed.value_or(static_cast<std::uint64_t>(scenario.seed));
  const terrain::Course course = trial::TerrainCourse(scenario.drive.course);
  const terrain::Field field = terrain::BuildField(
      scenario.drive.terrain, trial::LayoutKey(scenario.drive, {seed, options.trial}), course);
  WriteNamedFile("terrain", options.out, Export(format, field, scenario.drive.terrain, course));
}

void ShowBlindSwath(const TerrainOptions& options) {
  const scenario::Scenario scenario =
      campaign::LoadScenarioFrom(campaign::ScenarioFile(options.scenario), options.overrides);
  const std::uint64_t seed = options.seed.value_or(static_cast<std::uint64_t>(scenario.seed));
  terrain::BlindSwath swath = SwathOf(scenario);
  swath.width_m = options.width_m.value_or(swath.width_m);
  swath.min_diameter_m = options.min_diameter_m.value_or(swath.min_diameter_m);
  const BusyLine busy(fmt::format("building {} fields", options.fields));
  Print(BlindSwathText(scenario, seed, options.fields, swath));
}

void ShowDensity(const TerrainOptions& options) {
  const scenario::Scenario scenario =
      campaign::LoadScenarioFrom(campaign::ScenarioFile(options.scenario), options.overrides);
  const std::uint64_t seed = options.seed.value_or(static_cast<std::uint64_t>(scenario.seed));
  const BusyLine busy(fmt::format("building {} fields", options.fields));
  Print(CorridorDensityText(scenario, seed, options.fields));
}

void AddTableOptions(CLI::App& command, TerrainOptions& options, CLI::Option* out) {
  CLI::Option* blind = command.add_flag(
      "--blind-swath", options.blind_swath,
      "Print how far a straight blind swath gets before it meets a rock; writes no file");
  blind->excludes(out);
  command.add_option("--width", options.width_m, "of the swath, m; the rover's by default")
      ->check(CLI::Range(0.0, 100.0))
      ->needs(blind);
  command
      .add_option("--min-diameter", options.min_diameter_m,
                  "of rocks that count, m; by default those of mean shape that reach the belly")
      ->check(CLI::Range(0.0, 100.0))
      ->needs(blind);
  CLI::Option* density =
      command.add_flag("--density", options.density,
                       "Print how many rocks lie along the course, by size and placement rule, "
                       "against the law; writes no file");
  density->excludes(out)->excludes(blind);
  command.add_option("--fields", options.fields, "number of fields")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->excludes(out);
}

}  // namespace

void AddTerrainCommand(CLI::App& app) {
  auto options = std::make_shared<TerrainOptions>();
  CLI::App* command = app.add_subcommand(
      "terrain",
      "Writes the terrain of one trial as JSON, CSV, OBJ or SVG, by the file's extension, or "
      "tells how far a blind swath gets or how densely rocks lie along the course");
  command->add_option("SCENARIO", options->scenario, "Scenario file or its name")->required();
  command->add_option("--seed", options->seed, "Campaign seed; the scenario's by default");
  command->add_option("--trial", options->trial, "Trial index, from 0")->capture_default_str();
  command->add_option("--set", options->overrides, "Override: PATH=VALUE, may be repeated")
      ->allow_extra_args(false);
  CLI::Option* out =
      command->add_option("--out", options->out, "File to write: .json, .csv, .obj or .svg");
  AddTableOptions(*command, *options, out);
  command->callback([options] {
    if (options->blind_swath) {
      ShowBlindSwath(*options);
    } else if (options->density) {
      ShowDensity(*options);
    } else {
      WriteTerrain(*options);
    }
  });
}

}  // namespace rockyard::app
