#include "campaign/site/site_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <system_error>
#include <utility>

#include "campaign/run_source.h"
#include "campaign/site/site_course.h"
#include "campaign/site/site_rocks.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "math/angles.h"
#include "math/functions.h"
#include "scenario/load.h"
#include "terrain/arena.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Four significant digits are more than an estimate has.
double Rounded(double value, double steps) { return std::round(value * steps) / steps; }

// Returns the base as the new file names it: by its path from there, so that both can be moved
// together, where that is shorter than the whole path.
std::string BaseSeenFrom(const fs::path& base, const fs::path& out) {
  if (base.is_absolute()) return base.string();
  const fs::path folder = fs::weakly_canonical(fs::absolute(out)).parent_path();
  return fs::weakly_canonical(base).lexically_relative(folder).string();
}

core::JsonValue ElevationJson(const SiteElevation& site, const std::string& credit) {
  core::JsonValue json = core::JsonValue::Object();
  json.Set("cell_m", core::JsonValue(site.grid.cell_m));
  json.Set("columns", core::JsonValue(site.grid.columns));
  json.Set("origin_column", core::JsonValue(site.origin_column));
  json.Set("origin_row", core::JsonValue(site.origin_row));
  json.Set("source", core::JsonValue(credit.empty() ? site.source : site.source + "; " + credit));
  json.Set("heights_m", core::ListOf(site.grid.heights_m));
  return json;
}

core::JsonValue GroundJson(const SiteFigures& figures, const SiteRequest& request,
                           const terrain::GroundParams& base, std::vector<std::string>& notes) {
  core::JsonValue ground = core::JsonValue::Object();
  if (base.slope_rad != 0.0) {
    ground.Set("slope_deg", core::JsonValue(0.0));
    notes.emplace_back("the slope of the scenario's plane is left out: the model has its own");
  }
  if (request.roughness && figures.roughness) {
    ground.Set("roughness_rms_m", core::JsonValue(figures.roughness->rms_m));
    ground.Set("hurst_exponent", core::JsonValue(figures.roughness->hurst));
    ground.Set("roughness_wavelength_m", core::JsonValue(figures.roughness->wavelength_m));
  } else if (base.roughness_rms_m > 0.0) {
    ground.Set("roughness_rms_m", core::JsonValue(0.0));
  }
  ground.Set("elevation", ElevationJson(figures.elevation, request.credit));
  return ground;
}

// Returns how places of the catalogue become places of the world.
std::function<SitePoint(const CatalogueRock&)> PlacesOf(const RockCatalogue& catalogue,
                                                        const SiteRequest& request,
                                                        const std::optional<SiteFigures>& figures,
                                                        double& turned_rad) {
  std::optional<LinearPlaces> places;
  if (catalogue.geographic) {
    if (figures) places = figures->elevation.from_geographic;
    if (request.around) {
      const double degree_m = math::DegToRad(request.radius_m);
      const double parallel = math::Cos(math::DegToRad((*request.around)[0]));
      places = LinearPlaces{
          (*request.around)[1], (*request.around)[0], degree_m * parallel, 0.0, 0.0, degree_m};
    }
    if (!places) {
      throw core::UserError(request.rocks->file.string(),
                            "has longitudes and latitudes, and nothing says where the world's "
                            "origin lies",
                            "name an elevation model that has a frame (--dem), or the origin: "
                            "--around LAT,LON");
    }
  } else if (request.rock_places == RockPlaces::kMap) {
    if (!figures) {
      throw core::UserError("--rock-places", "is map, and there is no elevation model",
                            "name one by --dem, or use site: metres from the origin");
    }
    places = figures->elevation.from_map;
  }
  if (!places) return [](const CatalogueRock& rock) { return SitePoint{rock.x, rock.y}; };
  turned_rad = places->TurnedRad();
  return [places = *places, wraps = catalogue.geographic](const CatalogueRock& rock) {
    // Longitudes may be told from -180 or from 0.
    const double x = wraps ? places.first + std::remainder(rock.x - places.first, 360.0) : rock.x;
    const std::array<double, 2> at = places.At(x, rock.y);
    return SitePoint{at[0], at[1]};
  };
}

std::string Description(const SiteRequest& request, const SiteScenario& site,
                        const std::string& base) {
  std::string text = fmt::format("{} on a site", base);
  if (site.figures) text += " of " + site.figures->elevation.source;
  if (request.rocks) {
    text +=
        fmt::format(", with {} rocks of {}", site.listed, request.rocks->file.filename().string());
  }
  return text + ".";
}

// Adds the groups `terrain` and `course`.
void AddGroups(const SiteRequest& request, const scenario::Scenario& base, SiteScenario& site) {
  const terrain::TerrainParams& old = base.drive.terrain;
  core::JsonValue terrain = core::JsonValue::Object();
  core::JsonValue rocks = core::JsonValue::Object();
  terrain::ArenaParams arena = old.arena;
  if (site.figures) {
    terrain.Set("ground", GroundJson(*site.figures, request, old.ground, site.notes));
    core::JsonValue arena_json = ArenaOfSite(site.figures->elevation, old.arena);
    core::ReadParams(arena_json, arena);
    terrain.Set("arena", std::move(arena_json));
    if (!request.rocks) {
      rocks = RocksBelow(old.rocks, site.figures->resolution.effective_m, site.notes);
    }
  }
  if (request.rocks) {
    RockCatalogue catalogue = ReadCatalogue(*request.rocks);
    site.notes.insert(site.notes.end(), catalogue.notes.begin(), catalogue.notes.end());
    ListedRequest wanted{.bounds = terrain::DrivableBounds(arena), .rest = request.rest};
    if (site.figures && !request.keep_bumps) {
      wanted.largest_m = site.figures->resolution.effective_m;
    }
    const auto place = PlacesOf(catalogue, request, site.figures, wanted.turned_rad);
    rocks = ListedRocks(catalogue, wanted, old.rocks, place, site.notes);
    site.listed = rocks.Find("listed")->Find("x_m")->list().size();
  }
  if (site.figures && old.rocks.pointedness > 0.0) {
    rocks.Set("pointedness", core::JsonValue(0.0));
    site.notes.emplace_back("rocks are ellipsoids: pointed ones need level ground");
  }
  core::JsonValue course = core::JsonValue::Object();
  if (site.figures || request.start || request.goal) {
    course = CourseOfSite(base, arena, request.start, request.goal, site.notes);
  }
  if (site.figures && old.rocks.kind == terrain::RockFieldKind::kUniformCount && !request.rocks) {
    // The count area goes with the course.
    const double moved_m = course.Find("start_x_m")->number() - base.drive.course.start_x_m;
    rocks.Set("count_area_x_m", core::JsonValue(old.rocks.count_area_x_m + moved_m));
  }
  if (!rocks.members().empty()) terrain.Set("rocks", std::move(rocks));
  site.document.Set("terrain", std::move(terrain));
  if (!course.members().empty()) site.document.Set("course", std::move(course));
}

}  // namespace

SiteFigures FiguresOf(SiteElevation elevation, std::optional<double> resolution_m) {
  SiteFigures figures;
  const auto [lowest, highest] = std::ranges::minmax_element(elevation.grid.heights_m);
  figures.lowest_m = *lowest;
  figures.highest_m = *highest;
  figures.slopes = SlopesOf(elevation.grid);
  figures.resolution_stated = resolution_m.has_value();
  figures.resolution = resolution_m
                           ? Resolution{std::max(*resolution_m, elevation.grid.cell_m), false}
                           : EstimateResolution(elevation.grid);
  constexpr double kThousand = 1000.0;
  figures.resolution.effective_m = Rounded(figures.resolution.effective_m, kThousand);
  figures.roughness = RoughnessBelow(elevation.grid, figures.resolution.effective_m);
  if (figures.roughness) {
    constexpr double kTenThousand = 10000.0;
    constexpr double kRoughest_m = 0.5;  // of terrain.ground.roughness_rms_m
    if (figures.roughness->rms_m > kRoughest_m) {
      elevation.notes.push_back(
          fmt::format("the roughness below its resolution, {:.3g} m, is cut to {:g} m",
                      figures.roughness->rms_m, kRoughest_m));
    }
    figures.roughness->rms_m =
        std::min(Rounded(figures.roughness->rms_m, kTenThousand), kRoughest_m);
    figures.roughness->hurst = Rounded(figures.roughness->hurst, kThousand);
    if (figures.roughness->rms_m == 0.0) figures.roughness.reset();
  }
  figures.elevation = std::move(elevation);
  return figures;
}

SiteScenario MakeSiteScenario(const SiteRequest& request) {
  const scenario::Scenario base = LoadScenarioFrom(request.base);
  SiteScenario site;
  site.document = core::JsonValue::Object();
  site.document.Set("schema_version", core::JsonValue(base.schema_version));
  site.document.Set("extends", core::JsonValue(BaseSeenFrom(request.base, request.out)));
  site.document.Set("name", core::JsonValue(request.out.stem().string()));
  site.document.Set("description", core::JsonValue(""));
  if (request.elevation) {
    site.figures = FiguresOf(ReadElevation(*request.elevation), request.resolution_m);
    site.notes = site.figures->elevation.notes;
  }
  AddGroups(request, base, site);
  site.document.Set("description", core::JsonValue(Description(request, site, base.name)));
  for (const std::string& assignment : request.overrides) {
    core::ApplyOverride(site.document, assignment);
  }
  const fs::path folder = fs::absolute(request.out).parent_path();
  scenario::ReadScenario(core::ResolveExtends(site.document, folder));
  return site;
}

}  // namespace rockyard::campaign
