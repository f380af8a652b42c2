// Scenarios of a place: the ground of an elevation model, roughness below its resolution, rocks of
// a catalogue, and a course on it. The command `terrain --dem` and `--rocks` write them.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "campaign/site/elevation_file.h"
#include "campaign/site/rock_catalogue.h"
#include "campaign/site/surface_statistics.h"
#include "core/json_value.h"

namespace rockyard::campaign {

// How the places of a catalogue are meant where they are no longitudes and latitudes.
enum class RockPlaces {
  kSite,  // metres from the world's origin, east and north
  kMap,   // x and y of the elevation model's map
};

struct SiteRequest {
  std::filesystem::path base;          // a scenario file, which the new one extends
  std::vector<std::string> overrides;  // "PATH=VALUE", written into the new scenario
  std::filesystem::path out;           // where it will lie
  std::optional<ElevationRequest> elevation = {};
  std::optional<double> resolution_m =
      {};                 // effective, of the model; estimated where it is not given
  std::string credit;     // who made the model, under which licence
  bool roughness = true;  // below the resolution
  std::optional<std::array<double, 2>> start = {};  // x, y in the world, m
  std::optional<std::array<double, 2>> goal = {};
  std::optional<CatalogueRequest> rocks = {};
  RockPlaces rock_places = RockPlaces::kSite;
  // Where the world's origin lies, latitude and longitude, and on how large a body, for catalogues
  // of longitudes and latitudes without an elevation model.
  std::optional<std::array<double, 2>> around = {};
  double radius_m = 3389500.0;  // mean radius of Mars (Archinal et al. 2018)
  bool keep_bumps = false;      // listed rocks that the model resolves
  bool rest = false;            // the base's law lays rocks smaller than the listed ones
};

// What is known of a site.
struct SiteFigures {
  SiteElevation elevation;
  double lowest_m = 0.0;  // relative to the origin
  double highest_m = 0.0;
  SlopeFigures slopes;
  Resolution resolution;
  bool resolution_stated = false;
  std::optional<SubRoughness> roughness = {};
};

struct SiteScenario {
  core::JsonValue document;                 // the scenario file
  std::optional<SiteFigures> figures = {};  // with an elevation model
  std::size_t listed = 0;                   // rocks of the catalogue that are in it
  std::vector<std::string> notes;           // what was assumed, changed or left out
};

// Makes the scenario, which is read once to find what is wrong with it. Throws core::UserError.
SiteScenario MakeSiteScenario(const SiteRequest& request);

// Returns the figures of a model.
SiteFigures FiguresOf(SiteElevation elevation, std::optional<double> resolution_m);

}  // namespace rockyard::campaign
