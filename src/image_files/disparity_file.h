// Known disparities, to hold others against.
#pragma once

#include <filesystem>

#include "image_files/raw_image.h"
#include "vision/image.h"

namespace rockyard::image_files {

// Disparities in pixels, NaN where unknown. Of a PFM file the values as they stand, unknown where
// not finite; of a PNG, PGM or PPM file sample / samples_a_pixel, unknown where the sample is 0
// (the Middlebury data sets have 1, 2, 4 or 16 samples a pixel). Colours have to be equal.
// samples_a_pixel is positive and finite. Throws core::UserError: as ReadImage, different colours,
// JPEG, which is not exact, or a PFM file with samples_a_pixel other than 1.
vision::Image<float> ReadDisparity(const std::filesystem::path& path, double samples_a_pixel = 1.0,
                                   const ImageLimits& limits = {});

}  // namespace rockyard::image_files
