#include "app/site_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "campaign/output_folder.h"
#include "campaign/scenario_names.h"
#include "campaign/site/rock_catalogue.h"
#include "campaign/site/rock_fit.h"
#include "campaign/site/site_scan.h"
#include "campaign/site/site_scenario.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/text.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

// Returns the numbers of "A,B", or of "A..B".
template <std::size_t kCount>
std::array<double, kCount> NumbersOf(const char* option, const std::string& text,
                                     std::string_view between, const char* form) {
  std::array<double, kCount> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < kCount; ++i) {
    const bool last = i + 1 == kCount;
    const std::size_t end = last ? rest.size() : rest.find(between);
    const auto number =
        end == std::string_view::npos ? std::nullopt : core::FiniteNumber(rest.substr(0, end));
    if (!number) {
      throw core::UserError(option, fmt::format("is \"{}\"", text), fmt::format("use {}", form));
    }
    numbers[i] = *number;
    rest.remove_prefix(last ? end : end + between.size());
  }
  return numbers;
}

std::optional<std::array<double, 2>> PairOf(const char* option, const std::string& text,
                                            const char* form) {
  if (text.empty()) return std::nullopt;
  return NumbersOf<2>(option, text, ",", form);
}

std::optional<campaign::Range> RangeOf(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto [low, high] = NumbersOf<2>(option, text, "..", "LOW..HIGH, in degrees: 2..6");
  if (low > high) {
    throw core::UserError(option, "begins above its end", "use LOW..HIGH");
  }
  return campaign::Range{low, high};
}

campaign::ElevationRequest ElevationOf(const SiteOptions& options) {
  campaign::ElevationRequest request;
  request.file = options.dem;
  if (!options.crop.empty()) {
    const auto numbers =
        NumbersOf<4>("--crop", options.crop, ",", "ROW,COLUMN,ROWS,COLUMNS, from 0");
    std::array<std::int64_t, 4> whole{};
    for (std::size_t i = 0; i < whole.size(); ++i) {
      constexpr double kMost = 1e9;
      if (!(numbers[i] >= 0.0 && numbers[i] <= kMost && numbers[i] == std::floor(numbers[i]))) {
        throw core::UserError("--crop", "has a number that is no row or column",
                              "use whole numbers from 0");
      }
      whole[i] = static_cast<std::int64_t>(numbers[i]);
    }
    request.crop = image_files::RasterWindow{whole[0], whole[1], whole[2], whole[3]};
  }
  request.at = PairOf("--at", options.at, "LAT,LON, in degrees, or X,Y of the map");
  request.size_m = options.size_m;
  request.by_map = options.crs == "map";
  request.cell_m = options.cell_m;
  request.height_scale = options.height_scale;
  request.fill = options.fill;
  return request;
}

std::string Row(std::string_view what, const std::string& text) {
  return fmt::format("  {:<18}{}\n", what, text);
}

std::string FiguresText(const campaign::SiteFigures& figures) {
  const campaign::HeightGrid& grid = figures.elevation.grid;
  const campaign::Resolution& resolution = figures.resolution;
  const auto side_m = [&](std::int64_t nodes) {
    return static_cast<double>(nodes - 1) * grid.cell_m;
  };
  const char* how = figures.resolution_stated ? "as stated"
                    : resolution.at_least ? "at least: the part is too small or too smooth to tell"
                                          : "estimated";
  std::string text = Row("model", report::Printable(figures.elevation.source));
  text += Row("extent", fmt::format("{:.2f} m east, {:.2f} m north: {} x {} nodes of {:.4g} m",
                                    side_m(grid.columns), side_m(grid.rows), grid.columns,
                                    grid.rows, grid.cell_m));
  text += Row("resolution", fmt::format("{:.3g} m, {}", resolution.effective_m, how));
  text += Row("relief",
              fmt::format("{:.3f} m, from {:.3f} to {:.3f} m", figures.highest_m - figures.lowest_m,
                          figures.lowest_m, figures.highest_m));
  text += Row("slopes", fmt::format("median {:.2f} deg, 90 % below {:.2f} deg",
                                    figures.slopes.median_deg, figures.slopes.high_deg));
  text += Row("without data", figures.elevation.filled == 0
                                  ? "none"
                                  : fmt::format("{} nodes, filled", figures.elevation.filled));
  return text;
}

std::string RoughnessText(const campaign::SiteFigures& figures, bool wanted) {
  if (!wanted) return Row("roughness", "none, as asked for");
  if (!figures.roughness) return Row("roughness", "none: the part is too small or too level");
  return Row("roughness",
             fmt::format("{:.4f} m below {:.3g} m, Hurst exponent {:.2f}", figures.roughness->rms_m,
                         figures.roughness->wavelength_m, figures.roughness->hurst));
}

std::string SiteText(const campaign::SiteScenario& site, const SiteOptions& options,
                     const std::string& out) {
  std::string text = fmt::format("site in {}\n", report::Printable(out));
  if (site.figures) {
    text += FiguresText(*site.figures) + RoughnessText(*site.figures, !options.no_roughness);
  }
  text += Row("rocks", options.rocks.empty() ? "of the scenario's law"
                                             : fmt::format("{} of the catalogue", site.listed));
  for (const std::string& note : site.notes) text += fmt::format("  - {}\n", note);
  text += fmt::format("next: rockyard run {}\n", campaign::ShellPath(out));
  return text;
}

void CheckNewFile(const std::string& out) {
  if (out.empty()) {
    throw core::UserError("--out", "is not given", "name the scenario file to write: site.json");
  }
  campaign::CheckExtension("--out", out, ".json");
  campaign::CheckOutputFile("--out", out);
  std::error_code error;
  if (fs::exists(fs::symlink_status(out, error))) {
    throw core::UserError("--out", fmt::format("is {}, which is there already", out),
                          "name another file, or remove it");
  }
}

}  // namespace

void WriteSite(const SiteOptions& options, const std::string& scenario,
               const std::vector<std::string>& overrides, const std::string& out) {
  CheckNewFile(out);
  campaign::SiteRequest request;
  request.base = campaign::ScenarioFile(scenario.empty() ? "pathfinder/nominal" : scenario);
  request.overrides = overrides;
  request.out = out;
  if (!options.dem.empty()) request.elevation = ElevationOf(options);
  request.resolution_m = options.resolution_m;
  request.credit = options.credit;
  request.roughness = !options.no_roughness;
  request.start = PairOf("--start", options.start, "X,Y in metres");
  request.goal = PairOf("--goal", options.goal, "X,Y in metres");
  if (!options.rocks.empty())
    request.rocks = campaign::CatalogueRequest{options.rocks, options.columns};
  if (options.rock_places == "map") request.rock_places = campaign::RockPlaces::kMap;
  request.around = PairOf("--around", options.around, "LAT,LON in degrees");
  request.radius_m = options.radius_m.value_or(request.radius_m);
  request.keep_bumps = options.keep_bumps;
  request.rest = options.rest;
  const campaign::SiteScenario site = [&] {
    const BusyLine busy("reading the site");
    return campaign::MakeSiteScenario(request);
  }();
  WriteNamedFile("scenario", out, core::DumpJson(site.document));
  Print(report::Wrapped(SiteText(site, options, out)));
}

void ShowSites(const SiteOptions& options) {
  if (options.dem.empty()) {
    throw core::UserError("--dem", "is not given", "name the elevation model to look for sites in");
  }
  campaign::ScanRequest request;
  request.file = options.dem;
  request.size_m = options.size_m;
  request.median = RangeOf("--slope-median", options.slope_median);
  request.high = RangeOf("--slope-high", options.slope_high);
  request.count = options.count;
  request.by_map = options.crs == "map";
  request.cell_m = options.cell_m;
  request.height_scale = options.height_scale;
  const campaign::SiteScan scan = [&] {
    const BusyLine busy("looking for sites");
    return campaign::ScanSites(request);
  }();
  std::string text = fmt::format("{} windows of {:g} m, half a side apart; {} of them lack data\n",
                                 scan.windows, options.size_m, scan.incomplete);
  if (scan.sites.empty()) {
    text += "  none has such slopes: widen --slope-median or --slope-high\n";
  } else {
    text += "  median [deg]  90 % [deg]  relief [m]  --crop                  --at\n";
  }
  for (const campaign::ScannedSite& site : scan.sites) {
    const image_files::RasterWindow& w = site.window;
    text += fmt::format("  {:12.2f} {:11.2f} {:11.2f}  {:<22}  {}\n", site.slopes.median_deg,
                        site.slopes.high_deg, site.relief_m,
                        fmt::format("{},{},{},{}", w.row, w.column, w.rows, w.columns), site.place);
  }
  Print(text);
}

void ShowRockFit(const SiteOptions& options, std::optional<double> min_diameter_m) {
  if (!options.area_m2 || !min_diameter_m || !options.max_diameter_m) {
    throw core::UserError("--fit", "lacks the part of the catalogue that is complete",
                          "give --area, --min-diameter and --max-diameter");
  }
  const campaign::RockCatalogue catalogue = campaign::ReadCatalogue(
      {.file = options.fit, .columns = options.columns, .needs_places = false});
  std::vector<double> diameters_m;
  for (const campaign::CatalogueRock& rock : catalogue.rocks) {
    diameters_m.push_back(rock.diameter_m);
  }
  const campaign::RockFit fit = campaign::FitRockLaws(
      diameters_m, {*options.area_m2, *min_diameter_m, *options.max_diameter_m}, 1);
  Print(campaign::RockFitText(fit));
}

void AddSiteOptions(CLI::App& command, SiteOptions& o) {
  const auto positive = CLI::Range(1e-6, 1e6);
  CLI::Option* dem = command.add_option("--dem", o.dem,
                                        "Elevation model (GeoTIFF, PDS3, PDS4, ISIS3, ESRI ASCII, "
                                        ".npy): writes a scenario of a part");
  command.add_option("--crop", o.crop, "part of it: ROW,COLUMN,ROWS,COLUMNS, from 0")->needs(dem);
  command.add_option("--at", o.at, "or a square around LAT,LON (degrees), or X,Y of its map")
      ->needs(dem);
  command.add_option("--size", o.size_m, "side of that square, m")
      ->check(positive)
      ->capture_default_str()
      ->needs(dem);
  command.add_option("--crs", o.crs, "map: --at is X,Y of the map, whose units are metres")
      ->check(CLI::IsMember({"map"}))
      ->needs(dem);
  command.add_option("--cell", o.cell_m, "side of a cell, m, of a file that does not say")
      ->check(positive)
      ->needs(dem);
  command.add_option("--height-scale", o.height_scale, "metres per unit of its heights")
      ->check(CLI::Range(-1e6, 1e6))
      ->needs(dem);
  command.add_flag("--fill", o.fill, "fill small gaps in its data")->needs(dem);
  command
      .add_option("--resolution", o.resolution_m,
                  "its effective resolution, m; estimated by default")
      ->check(positive)
      ->needs(dem);
  command.add_option("--credit", o.credit, "who made it, under which licence")->needs(dem);
  command.add_flag("--no-roughness", o.no_roughness, "no roughness below its resolution")
      ->needs(dem);
  command.add_option("--start", o.start, "of the course on it: X,Y, m")->needs(dem);
  command.add_option("--goal", o.goal, "of the course on it: X,Y, m")->needs(dem);
  CLI::Option* rocks = command.add_option(
      "--rocks", o.rocks, "Catalogue of rocks (CSV, GeoJSON, table): writes a scenario with them");
  command.add_option("--columns", o.columns,
                     "of a catalogue: x=East_m,y=North_m,diameter=D:cm; also lon, lat, length, "
                     "width, height, burial, yaw");
  command
      .add_option("--rock-places", o.rock_places,
                  "x and y of a catalogue: site, m from the origin, or map, the model's")
      ->check(CLI::IsMember({"site", "map"}))
      ->needs(rocks);
  command
      .add_option("--around", o.around,
                  "LAT,LON of the origin, for a catalogue of longitudes without --dem")
      ->needs(rocks)
      ->excludes(dem);
  command.add_option("--radius", o.radius_m, "of that body, m; that of Mars by default")
      ->check(CLI::Range(1.0, 1e9))
      ->needs(rocks);
  command.add_flag("--keep-bumps", o.keep_bumps, "keep rocks that the model resolves")
      ->needs(rocks);
  command.add_flag("--rest", o.rest, "the scenario's law lays rocks smaller than the catalogue's")
      ->needs(rocks);
  CLI::Option* scan = command.add_flag(
      "--scan-sites", o.scan, "List parts of --dem, of --size, by their slopes; writes no file");
  scan->needs(dem)->excludes(rocks);
  command.add_option("--slope-median", o.slope_median, "their median slope: LOW..HIGH, deg")
      ->needs(scan);
  command.add_option("--slope-high", o.slope_high, "the slope that 90 % are below: LOW..HIGH, deg")
      ->needs(scan);
  command.add_option("--count", o.count, "number of parts that are listed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->needs(scan);
  CLI::Option* fit = command.add_option(
      "--fit", o.fit, "Catalogue of rocks: print which law fits it; writes no file");
  fit->excludes(dem)->excludes(rocks);
  command.add_option("--area", o.area_m2, "m2 that the catalogue covers")
      ->check(CLI::Range(1e-3, 1e12))
      ->needs(fit);
  command.add_option("--max-diameter", o.max_diameter_m, "up to which it is complete, m")
      ->check(CLI::Range(0.0, 100.0))
      ->needs(fit);
  // One trial of a scenario, and tables of one, are other questions.
  for (CLI::Option* site : {dem, rocks, fit}) {
    for (const char* other : {"--seed", "--trial", "--blind-swath", "--density", "--fields"}) {
      site->excludes(command.get_option(other));
    }
  }
  for (CLI::Option* table : {scan, fit}) {
    table->excludes(command.get_option("--out"))->excludes(command.get_option("--set"));
  }
  for (const char* part : {"--crop", "--at"}) scan->excludes(command.get_option(part));
}

}  // namespace rockyard::app
