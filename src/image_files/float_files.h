// Files of real numbers: PFM, one a pixel; PLY, points; disparities of either PFM or PNG.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "image_files/raw_image.h"
#include "vision/image.h"

namespace rockyard::image_files {

// Whether a file begins as PFM files do, of one channel or three.
inline bool IsPfm(std::string_view bytes) {
  return bytes.starts_with("Pf") || bytes.starts_with("PF");
}

// The bytes of a PFM file: "Pf", little-endian, the lowest row first. What is not finite is written
// as +infinity, as in the Middlebury stereo data sets, where it means unknown. Not empty.
std::string EncodePfm(const vision::Image<float>& image);

// The values of a PFM file of one channel, of either byte order; what is not finite comes as NaN.
// The size of the scale in its header is not heeded, as in those data sets: only its sign counts.
// `name` is what messages call the file. Throws core::UserError: three channels, fewer or more
// pixels than the header says, or beyond the limits.
vision::Image<float> DecodePfm(std::string_view bytes, const std::string& name,
                               const ImageLimits& limits);

// A point of a cloud with its colour; of a grey image, three equal values.
struct ColouredPoint {
  Eigen::Vector3d position;  // [m] in the frame that the caller's comment names
  Rgb colour;
};

// The bytes of a PLY file, binary and little-endian, with float x, y, z and uchar red, green, blue
// a vertex. A point with a coordinate that is not finite as a float is left out and not counted.
// `comment` is a line of the header: the frame and the unit. Cost: 15 bytes a point.
std::string EncodePly(std::span<const ColouredPoint> points, std::string_view comment);

// Known disparities in pixels, to hold others against, NaN where unknown. Of a PFM file the values
// as they stand, unknown where not finite; of a PNG, PGM or PPM file sample / samples_a_pixel,
// unknown where the sample is 0 (the Middlebury data sets have 1, 2, 4 or 16 samples a pixel).
// Colours have to be equal. samples_a_pixel is positive and finite. Throws core::UserError: as
// ReadImage, different colours, JPEG, which is not exact, or a PFM file with samples_a_pixel other
// than 1.
vision::Image<float> ReadDisparity(const std::filesystem::path& path, double samples_a_pixel = 1.0,
                                   const ImageLimits& limits = {});

}  // namespace rockyard::image_files
