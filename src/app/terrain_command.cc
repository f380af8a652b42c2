// The command `rockyard terrain`: a field of rocks as a file, tables that check fields of a
// scenario against laws, or a scenario of a place.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
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
#include "app/site_options.h"
#include "app/terrain_tables.h"
#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "campaign/scenario_names.h"
#include "core/error.h"
#include "scenario/scenario.h"
#include "terrain/blind_swath.h"
#include "terrain/field.h"
#include "terrain/field_export.h"
#include "trial/course/layout.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

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
  SiteOptions site;
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
                  "of rocks that count, m: with --blind-swath by default those of mean shape that "
                  "reach the belly; with --fit from which on the catalogue is complete")
      ->check(CLI::Range(0.0, 100.0));
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
      "Writes the terrain of one trial as JSON, CSV, OBJ or SVG, by the file's extension, makes a "
      "scenario of a place, or tells how far a blind swath gets or how densely rocks lie along the "
      "course");
  command->add_option("SCENARIO", options->scenario,
                      "Scenario file or its name; with --dem and --rocks by default "
                      "pathfinder/nominal");
  command->add_option("--seed", options->seed, "Campaign seed; the scenario's by default");
  command->add_option("--trial", options->trial, "Trial index, from 0")->capture_default_str();
  command->add_option("--set", options->overrides, "Override: PATH=VALUE, may be repeated")
      ->allow_extra_args(false);
  CLI::Option* out =
      command->add_option("--out", options->out, "File to write: .json, .csv, .obj or .svg");
  AddTableOptions(*command, *options, out);
  AddSiteOptions(*command, options->site);
  command->callback([options] {
    const bool of_site = options->site.MakesScenario() || !options->site.fit.empty();
    if (!of_site && options->scenario.empty()) {
      throw core::UserError("SCENARIO", "is not given", "name a scenario: nominal");
    }
    if (options->site.scan) {
      ShowSites(options->site);
    } else if (!options->site.fit.empty()) {
      ShowRockFit(options->site, options->min_diameter_m);
    } else if (of_site) {
      WriteSite(options->site, options->scenario, options->overrides, options->out);
    } else if (options->blind_swath) {
      ShowBlindSwath(*options);
    } else if (options->density) {
      ShowDensity(*options);
    } else {
      WriteTerrain(*options);
    }
  });
}

}  // namespace rockyard::app
