// Rocks of a site: those of a catalogue as listed rocks of a scenario, and what of a scenario's law
// an elevation model leaves to it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "campaign/site/rock_catalogue.h"
#include "core/json_value.h"
#include "terrain/arena.h"
#include "terrain/rock_params.h"

namespace rockyard::campaign {

// A place in the world, m.
struct SitePoint {
  double x_m = 0.0;
  double y_m = 0.0;
};

// Which rocks of a catalogue are taken, and how.
struct ListedRequest {
  terrain::Rectangle bounds;  // others are left out
  double largest_m = 0.0;     // larger ones are bumps of the model; 0: none are
  bool rest = false;          // the base's law goes on below the smallest
  double turned_rad = 0.0;    // of the catalogue's x axis against the world's
};

// Returns the group `terrain.rocks` of a scenario with the catalogue's rocks; `place` brings their
// places into the world. Heights that are missing follow the mean shape of the base's rocks: D
// times the mean height ratio, less the buried share. Notes say what was left out or assumed.
// Throws core::UserError where no rock is left or a law is asked to go on that the base has not.
core::JsonValue ListedRocks(const RockCatalogue& catalogue, const ListedRequest& request,
                            const terrain::RockFieldParams& base,
                            const std::function<SitePoint(const CatalogueRock&)>& place,
                            std::vector<std::string>& notes);

// Returns what of `terrain.rocks` has to differ where a model resolves rocks of effective_m: laws
// end there.
core::JsonValue RocksBelow(const terrain::RockFieldParams& base, double effective_m,
                           std::vector<std::string>& notes);

}  // namespace rockyard::campaign
