// PLY files of points.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>

#include "image_files/raw_image.h"

namespace rockyard::image_files {

// A point of a cloud with its colour; of a grey image, three equal values.
struct ColouredPoint {
  Eigen::Vector3d position;  // [m] in the frame that the caller's comment names
  Rgb colour;
};

// The bytes of a PLY file, binary and little-endian, with float x, y, z and uchar red, green, blue
// a vertex. A point with a coordinate that is not finite as a float is left out and not counted.
// `comment` is a line of the header: the frame and the unit. Cost: 15 bytes a point.
std::string EncodePly(std::span<const ColouredPoint> points, std::string_view comment);

}  // namespace rockyard::image_files
