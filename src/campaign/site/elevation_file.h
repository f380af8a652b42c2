// A part of an elevation model of others as heights over a plane: x east, y north, metres. The
// command `terrain --dem` makes scenarios of it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "campaign/site/height_grid.h"
#include "campaign/site/site_place.h"
#include "image_files/elevation_raster.h"

namespace rockyard::campaign {

// Which part of which file.
struct ElevationRequest {
  std::filesystem::path file = {};
  std::optional<image_files::RasterWindow> crop = {};  // rows and columns, or
  std::optional<std::array<double, 2>> at = {};  // a square around a place: latitude and longitude,
                                                 // or x and y of the map
  double size_m = 60.0;                          // the side of that square
  bool by_map = false;                           // `at` is x and y though the file has a frame
  std::optional<double> cell_m = {};             // of a file that does not say
  std::optional<double> height_scale = {};       // metres per unit of a height
  bool fill = false;                             // small gaps
};

// The heights of a site.
struct SiteElevation {
  HeightGrid grid;  // relative to the height at the origin, whole tenths of millimetres
  // The node at the world's origin.
  std::int64_t origin_column = 0;
  std::int64_t origin_row = 0;
  double origin_height_m = 0.0;  // in the file's datum
  std::int64_t filled = 0;       // nodes without data that were filled
  bool resampled = false;        // nodes lie between those of the file
  // Places of others in the world.
  LinearPlaces from_map;
  std::optional<LinearPlaces> from_geographic = {};  // where the file has such a frame
  std::string source;                                // file, part and place, in one line
  std::vector<std::string> notes;                    // what was assumed or changed, a sentence each
};

// Largest number of nodes: of terrain.ground.elevation.
inline constexpr std::int64_t kMostNodes = 1000000;

// Reads the part. Cells that are squares along the axes of the plane that touches the body in the
// part's middle, within 1e-3, are taken as nodes as they are; else the nodes are interpolated
// (CubicAt), which a note says. The origin is the node nearest to `at`, or in the middle. Throws
// core::UserError: a part beyond the file, of fewer than 4 x 4 nodes or more than kMostNodes, a
// wrong place or unit, nodes without data (with the nearest part of that size that has none).
SiteElevation ReadElevation(const ElevationRequest& request);

}  // namespace rockyard::campaign
