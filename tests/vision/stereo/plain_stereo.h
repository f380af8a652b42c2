// The stages of the stereo pipeline as their definitions say, pixel by pixel, without sliding sums,
// vectors or tables: the reference that the fast ones equal bit for bit.
#pragma once

#include <vector>

#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// dog.h: clamp(round(gain (mean of the narrow square - mean of the wide square))) + limit.
GrayImage PlainDifferenceOfGaussians(const GrayImage& image, const DogParams& params);

// correlator.h. Score of left pixel (x, y) at disparity d; kNoScore where a window is not inside.
constexpr int kNoScore = 1 << 30;
int PlainScore(const GrayImage& left, const GrayImage& right, int side, int x, int y, int d);

DisparityImage PlainCorrelate(const GrayImage& left, const GrayImage& right,
                              const StereoPipelineParams& params);

// blob.h, by flooding.
void PlainFilterBlobs(const StereoFilterParams& filters, DisparityImage& disparities);

}  // namespace rockyard::vision
