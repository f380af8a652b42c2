// Elevation models through GDAL, for OpenElevation.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "image_files/elevation_raster.h"

namespace rockyard::image_files {

// Returns what would bring GDAL in one sentence; empty where it is there.
std::string MissingGdal();

// Opens the file by the driver of GDAL that is called `driver`, without others. GDAL must be there.
// Throws core::UserError: damaged, of several bands, complex numbers, or parts too large to be read
// in small windows.
std::unique_ptr<ElevationRaster> OpenByGdal(const std::filesystem::path& path, const char* driver);

}  // namespace rockyard::image_files
