#include "image_files/elevation_raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/check.h"
#include "core/error.h"
#include "image_files/gdal_elevation.h"
#include "image_files/npy_raster.h"
#include "image_files/planetary.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {
namespace {

namespace fs = std::filesystem;

// PDS4 names its schema within the first 8 kB, as planetary.cc has it.
constexpr std::size_t kElevationHead = 8192;

std::string HeadOf(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    throw core::UserError(path.string(), "the file does not exist",
                          "check the name and the folder");
  }
  if (!fs::is_regular_file(status)) {
    throw core::UserError(path.string(), "is not a regular file", "name a file of elevations");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw core::UserError(path.string(), fmt::format("cannot be read: {}", std::strerror(errno)),
                          "check its permissions");
  }
  std::string head(kElevationHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

bool IsTiff(std::string_view head) {
  return head.starts_with(std::string_view("II\x2a\0", 4)) ||
         head.starts_with(std::string_view("MM\0\x2a", 4)) ||
         head.starts_with(std::string_view("II\x2b\0", 4)) ||
         head.starts_with(std::string_view("MM\0\x2b", 4));
}

bool IsAsciiGrid(std::string_view head) {
  constexpr std::string_view kFirst = "ncols";
  const std::size_t at = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  const std::string_view word = head.substr(at, kFirst.size());
  return std::equal(word.begin(), word.end(), kFirst.begin(), kFirst.end(),
                    [](unsigned char a, char b) { return std::tolower(a) == b; });
}

// The driver of GDAL, and what people call the format; nullptr: none.
struct ElevationFormat {
  const char* driver = nullptr;
  const char* name = nullptr;
};

ElevationFormat FormatOfHead(std::string_view head) {
  if (IsTiff(head)) return {"GTiff", "GeoTIFF"};
  if (IsAsciiGrid(head)) return {"AAIGrid", "ESRI ASCII"};
  if (head.find("Object = IsisCube") != std::string_view::npos) return {"ISIS3", "ISIS3"};
  if (const auto kind = PlanetaryKindOf(head)) {
    return {kind == PlanetaryKind::kPds3 ? "PDS" : NameOf(*kind), NameOf(*kind)};
  }
  return {};
}

}  // namespace

std::vector<MapPoint> ElevationRaster::ToMap(const GeoPoint&, std::span<const LocalPoint>) const {
  EXPECT(HasFrame());
  return {};
}

std::vector<GeoPoint> ElevationRaster::ToGeographic(std::span<const MapPoint>) const {
  EXPECT(HasFrame());
  return {};
}

std::unique_ptr<ElevationRaster> OpenElevation(const fs::path& path) {
  const std::string head = HeadOf(path);
  if (head.empty()) FailUnsupported(path.string(), "is empty", "copy it again");
  if (IsNpy(head)) return OpenNpy(path);
  const ElevationFormat format = FormatOfHead(head);
  if (format.driver == nullptr) {
    FailUnsupported(path.string(), "is of no format of elevation models that is known",
                    "name a GeoTIFF, PDS3, PDS4, VICAR, ISIS3, ESRI ASCII or NumPy (.npy) file");
  }
  const std::string remedy = MissingGdal();
  if (!remedy.empty()) {
    FailUnsupported(
        path.string(),
        fmt::format("is a {} file, which this rockyard cannot read without GDAL", format.name),
        remedy + "; NumPy (.npy) files need none");
  }
  return OpenByGdal(path, format.driver);
}

}  // namespace rockyard::image_files
