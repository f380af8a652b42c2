// Pictures of pixels made larger, and lines on them.
#pragma once

#include <optional>
#include <utility>

#include "image_files/raw_image.h"
#include "math/pose.h"
#include "vision/cameras/cahv.h"

namespace rockyard::campaign {

// Every pixel as a square of `factor` >= 1 pixels.
image_files::Picture Enlarged(const image_files::Picture& picture, int factor);

// The factor that makes the longer side at least 512 pixels long, or nearly: 1 for larger ones.
int FactorToSee(int width, int height);

// Pixels of the picture, (0, 0) in the middle of the first one.
using PictureSegment = std::pair<vision::Pixel, vision::Pixel>;

// The image of the line between two points in the camera's outer frame, where it is at least 0.05 m
// in front of the camera's centre; nothing where none of it is.
std::optional<PictureSegment> ImageOfLine(const vision::Cahv& camera, const math::Vector3& from_A,
                                          const math::Vector3& to_A);

// Draws what of the line lies within the picture, `width_px` >= 1 wide, to the right of it and
// below. Its ends are finite.
void DrawLine(const PictureSegment& line, const image_files::Rgb& colour, int width_px,
              image_files::Picture& picture);

}  // namespace rockyard::campaign
