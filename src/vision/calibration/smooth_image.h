// An image as a smooth function of position: what the search for corners works on.
#pragma once

#include "vision/cameras/camera_types.h"
#include "vision/image.h"

namespace rockyard::vision {

// The image convolved with a Gaussian of `sigma_px` > 0, cut at 3 sigma; edges are repeated.
Image<float> Smoothed(const GrayImage& image, double sigma_px);

// The bilinear value at a position; beyond the image that of the nearest pixel.
double ValueAt(const Image<float>& image, const Pixel& at);

}  // namespace rockyard::vision
