// Heights in NumPy's files of one array (.npy), for OpenElevation. Only the rows of a window are
// read.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "image_files/elevation_raster.h"

namespace rockyard::image_files {

// Returns whether a file that begins so is one of NumPy.
bool IsNpy(std::string_view head);

// Opens a file of two dimensions, in rows (C order), of real numbers of 4 or 8 bytes or whole
// numbers of 2 or 4 (i2, u2, i4), of either byte order. Format: NumPy Enhancement Proposal 1,
// versions 1 to 3. Throws core::UserError for any other, and where the file is not as long as its
// header says.
std::unique_ptr<ElevationRaster> OpenNpy(const std::filesystem::path& path);

}  // namespace rockyard::image_files
