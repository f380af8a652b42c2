// rockyard terrain
#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/output_file.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "scenario/load.h"
#include "terrain/field.h"
#include "terrain/field_export.h"
#include "trial/layout.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

struct TerrainOptions {
  std::string scenario;
  std::optional<std::uint64_t> seed;  // absent: the scenario's
  std::uint32_t trial = 0;
  std::vector<std::string> overrides;
  std::string out;
};

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
  const Format format = FormatOf(options.out);
  CheckOutputFile("--out", options.out);
  const scenario::Scenario scenario = scenario::LoadScenario(options.scenario, options.overrides);
  const std::uint64_t seed = options.seed.value_or(static_cast<std::uint64_t>(scenario.seed));
  const terrain::Course course = trial::TerrainCourse(scenario.course);
  const terrain::Field field = terrain::BuildField(
      scenario.terrain, trial::LayoutKey(scenario, {seed, options.trial}), course);
  report::WriteFileAtomically(options.out, Export(format, field, scenario.terrain, course));
}

}  // namespace

void AddTerrainCommand(CLI::App& app) {
  auto options = std::make_shared<TerrainOptions>();
  CLI::App* command = app.add_subcommand(
      "terrain",
      "Writes the terrain of one trial as JSON, CSV, OBJ or SVG, by the file's extension");
  command->add_option("scenario", options->scenario, "Scenario file")->required();
  command->add_option("--seed", options->seed, "Campaign seed; the scenario's by default");
  command->add_option("--trial", options->trial, "Trial index, from 0")->capture_default_str();
  command->add_option("--set", options->overrides, "Override: PATH=VALUE, may be repeated")
      ->allow_extra_args(false);
  command->add_option("--out", options->out, "File to write: .json, .csv, .obj or .svg")
      ->required();
  command->callback([options] { WriteTerrain(*options); });
}

}  // namespace rockyard::app
