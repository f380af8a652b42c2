// Elevation models of others, of which only a window is read: NumPy arrays by a reader of our own,
// GeoTIFF, PDS3, PDS4, VICAR, ISIS3 cubes and ESRI ASCII grids through GDAL, an optional part of
// the build. campaign/site makes scenarios of them. No record depends on it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rockyard::image_files {

// A place in the frame of a file, in its units: x to the right and y upwards on a map, or longitude
// and latitude in degrees.
struct MapPoint {
  double x = 0.0;
  double y = 0.0;
};

struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;  // to the east
};

// A place relative to another one, on the plane that touches the body there.
struct LocalPoint {
  double east_m = 0.0;
  double north_m = 0.0;
};

// A part of a raster. Row 0 is the first one of the file, on most maps the northernmost.
struct RasterWindow {
  std::int64_t row = 0;
  std::int64_t column = 0;
  std::int64_t rows = 0;
  std::int64_t columns = 0;
};

struct RasterInfo {
  std::string format;  // "NumPy", or what GDAL calls it: "GTiff"
  std::int64_t rows = 0;
  std::int64_t columns = 0;
  // Where the file says where it lies: x = t[0] + t[1] c + t[2] r, y = t[3] + t[4] c + t[5] r, with
  // c and r from the outer corner of the first cell; its middle is at c = r = 0.5.
  std::optional<std::array<double, 6>> transform = {};
  std::string frame = {};              // name of the frame on the body; empty: not known
  std::string unit = {};               // of the band, as the file calls it; empty: not said
  double scale = 1.0;                  // what Read has multiplied by,
  double offset = 0.0;                 // and then added, as the file says
  std::optional<double> no_data = {};  // in the file's own numbers
};

// The largest window that is read at once: 134 MB.
inline constexpr std::int64_t kMostWindowCells = std::int64_t{1} << 24;

class ElevationRaster {
 public:
  ElevationRaster(std::string name, RasterInfo info)
      : name_(std::move(name)), info_(std::move(info)) {}
  virtual ~ElevationRaster() = default;
  ElevationRaster(const ElevationRaster&) = delete;
  ElevationRaster& operator=(const ElevationRaster&) = delete;

  // The path, for messages.
  const std::string& name() const { return name_; }
  const RasterInfo& info() const { return info_; }
  // Returns whether the file says where on its body it lies.
  bool HasFrame() const { return !info_.frame.empty() && info_.transform.has_value(); }

  // Returns the heights of the window row by row, times scale plus offset; NaN where there is no
  // data. The window must lie in the raster and hold at most kMostWindowCells. Throws
  // core::UserError where the file is damaged.
  virtual std::vector<double> Read(const RasterWindow& window) = 0;

  // Returns where places around another one lie in the file's frame, by an azimuthal equidistant
  // projection of the body's ellipsoid around it (Snyder 1987, section 25). Requires HasFrame().
  // Throws core::UserError where they have no place in the frame.
  virtual std::vector<MapPoint> ToMap(const GeoPoint& around,
                                      std::span<const LocalPoint> points) const;
  // Returns the geographic places of points of the file's frame, under the same conditions.
  virtual std::vector<GeoPoint> ToGeographic(std::span<const MapPoint> points) const;

 private:
  std::string name_;
  RasterInfo info_;
};

// Opens the file, whose first bytes tell its format. Reads no heights. Throws core::UserError: no
// such file, of no known format, damaged, complex or of several bands, or without GDAL where that
// is needed, with what would bring it.
std::unique_ptr<ElevationRaster> OpenElevation(const std::filesystem::path& path);

}  // namespace rockyard::image_files
