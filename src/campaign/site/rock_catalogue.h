// Catalogues of rocks of others: tables (CSV, or columns between blanks as in PDS .TAB files) and
// GeoJSON. Scenarios of sites get their listed rocks from them, and laws are fitted to them.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rockyard::campaign {

// A rock as a catalogue has it.
struct CatalogueRock {
  double x = 0.0;           // in the frame of the catalogue: metres, or the longitude in degrees
  double y = 0.0;           // metres, or the latitude
  double diameter_m = 0.0;  // the longest horizontal axis
  std::optional<double> height_m = {};      // above the ground
  std::optional<double> buried_share = {};  // of the full height
  std::optional<double> width_ratio = {};   // the shorter horizontal axis over the longer
  std::optional<double> yaw_deg = {};       // of the longer axis, from +x towards +y
};

struct RockCatalogue {
  std::vector<CatalogueRock> rocks;
  bool placed = false;             // x and y are there
  bool geographic = false;         // they are longitude and latitude
  std::vector<std::string> notes;  // what was assumed, a sentence each
};

struct CatalogueRequest {
  std::filesystem::path file;
  // "x=East_m,y=North_m,diameter=D:cm": the column or property of a field, by its name or, in
  // tables, its number from 1; after a colon its unit. Fields: x, y, lon, lat, diameter, length,
  // width, height, burial, yaw.
  std::string columns = {};
  bool needs_places = true;
};

// Bounds on what is read.
inline constexpr std::size_t kMostCatalogueBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMostCatalogueRocks = 100000;

// Reads a catalogue. Fields that `columns` leaves out are found by their names: x_m, y_m, lon, lat,
// diameter_m, length_m, width_m, height_m, burial, yaw_deg and the like; a unit may stand at the
// end of a name (D_cm, "width (m)"), m, cm and mm are known. Length and width replace a diameter.
// Burial is a share of the full height, or a class: perched 0, partially buried 1/3, buried 2/3,
// which is assumed and noted. GeoJSON (RFC 7946) is a FeatureCollection of points, longitude and
// latitude, unless `columns` names x and y. Throws core::UserError with every wrong line (at most
// 20), its number and a remedy; also where columns are missing, for px, and beyond the bounds.
RockCatalogue ReadCatalogue(const CatalogueRequest& request);

}  // namespace rockyard::campaign
