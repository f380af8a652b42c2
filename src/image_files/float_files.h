// Files of real numbers: PFM, one a pixel; PLY, points; and known disparities, from PFM or from
// images of whole numbers. Commands on pairs of images write and read them, replays write clouds.
// No record depends on them: the formats must stay what other programs read.
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

// Returns the bytes of a PFM file: "Pf", little-endian, the lowest row first. What is not finite is
// written as +infinity, which means unknown, as in the Middlebury stereo data sets. The image must
// not be empty.
std::string EncodePfm(const vision::Image<float>& image);

// Returns the values of a PFM file of one channel, of either byte order; what is not finite comes
// as NaN. Of the scale in its header only the sign counts, as in the Middlebury data sets. `name`
// is what messages call the file. Throws core::UserError: three channels, fewer or more pixels than
// the header says, or beyond the limits.
vision::Image<float> DecodePfm(std::string_view bytes, const std::string& name,
                               const ImageLimits& limits);

// A point of a cloud with its colour; of a grey image, three equal values.
struct ColouredPoint {
  Eigen::Vector3d position;  // [m] in the frame that the caller's comment names
  Rgb colour;
};

// Returns the bytes of a PLY file, binary and little-endian, with float x, y, z and uchar red,
// green, blue a vertex. A point with a coordinate that is not finite as a float is left out and not
// counted. `comment` is a line of the header: the frame and the unit. Cost: 15 bytes a point.
std::string EncodePly(std::span<const ColouredPoint> points, std::string_view comment);

// Returns known disparities in pixels, to hold others against, NaN where unknown. A PFM file gives
// the values as they stand, unknown where not finite; a PNG, PGM or PPM file gives sample /
// samples_a_pixel, unknown where the sample is 0 (the Middlebury data sets have 1, 2, 4 or 16
// samples a pixel). The three colours of a pixel have to be equal. samples_a_pixel is positive and
// finite. Throws core::UserError: as ReadImage, different colours, JPEG, which is not exact, or a
// PFM file with samples_a_pixel other than 1.
vision::Image<float> ReadDisparity(const std::filesystem::path& path, double samples_a_pixel = 1.0,
                                   const ImageLimits& limits = {});

}  // namespace rockyard::image_files
