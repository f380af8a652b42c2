// Reduction of an image by averaging (Goldberg 2002 section 2 stage 1), for the rover's stereo, the
// commands that match pairs, and the pictures of looks.
//
// A pixel of level l is the mean of a square of 2^l x 2^l pixels (box filter), rounded to the
// nearest, halves upwards:
//   P(x, y) = floor((sum of I(2^l x + i, 2^l y + k) + 2^(2l - 1)) / 2^(2l)),  0 <= i, k < 2^l.
// Each level halves the disparities too: an eighth of the work, twice the error of a range. Must
// stay: Reduced (cameras/camera_model.h), the camera of such an image, moves the centres of pixels
// as this mean does. All ranges depend on that.
#pragma once

#include "vision/image.h"

namespace rockyard::vision {

// Returns the image of `level` 0 to 6, of size floor(width / 2^level) x floor(height / 2^level):
// columns and rows that fill no square are left out.
GrayImage ReduceImage(const GrayImage& image, int level);

}  // namespace rockyard::vision
