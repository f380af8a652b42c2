// Difference of Gaussians (Goldberg 2002 section 2 stage 3), so that neither the brightness of an
// image nor its slow change matters to what is compared.
//
// Each Gaussian is the mean over a square around the pixel, by sliding sums as in section 3; pixels
// outside of the image are those of its edge. With sums s over the narrow square of side n and w
// over the wide one of side m
//   value = clamp(round(gain (s / n^2 - w / m^2)), -limit, limit) + limit,
// an image of 8 bits with the offset `limit`. In whole numbers, halves rounded upwards:
//   round(...) = (s a - w b + 2^19) >> 20,  a = q m^2, b = q n^2, q = round(2^20 gain / (n m)^2),
// which is 0 exactly where the image is flat, whatever q was rounded to.
#pragma once

#include <cstdint>

#include "vision/image.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

constexpr int kDogShift = 20;

// The factors of the two sums.
struct DogWeights {
  std::int32_t narrow;  // a
  std::int32_t wide;    // b
};

DogWeights MakeDogWeights(const DogParams& params);

// Writes rows first_row ... end_row - 1 of the filtered image; bands of rows may be written at the
// same time. `out` is of the image's size, and another image.
void DifferenceOfGaussiansRows(const GrayImage& image, const DogParams& params, int first_row,
                               int end_row, GrayImage& out);

GrayImage DifferenceOfGaussians(const GrayImage& image, const DogParams& params);

}  // namespace rockyard::vision
