// Samples of planetary images (GDAL, an optional part of the build), for ReadPlanetary.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "image_files/raw_image.h"

namespace rockyard::image_files {

struct Raster {
  std::vector<SamplePlane> planes;  // one or three
  int bits = 0;                     // of a sample without its sign: 8, 15 or 16
  std::int64_t negative = 0;        // samples below zero, which are 0 here
};

// Reads the file at an absolute path by the driver of GDAL that is called `driver`. Throws
// core::UserError about the file.
using RasterReader = Raster (*)(const std::filesystem::path& path, const char* driver,
                                const ImageLimits& limits);

struct RasterSupport {
  RasterReader reader = nullptr;  // nullptr: none
  std::string remedy;             // what would bring one, in one sentence
};

// Returns the reader, or none in a program that was built without GDAL or on a machine on which the
// library is missing. Cost: the first call loads the library.
RasterSupport FindGdal();

}  // namespace rockyard::image_files
