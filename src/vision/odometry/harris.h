// How much of a corner every pixel is (Harris and Stephens 1988), in whole numbers.
//
//   gx = clamp((Sobel_x + 1) >> 1)   gy = clamp((Sobel_y + 1) >> 1)      to [-63, 63]
//   xx = sum5_x(sum5_y(gx gx) >> 2)   yy, xy likewise                     up to +-24800
//   response = xx yy - xy^2 - (((xx + yy) >> 1)^2 >> 8) k'                k' = round(1024 k)
//
// Sobel_x is the difference over two columns of rows weighed 1, 2, 1: 8 times a slope in grey
// levels a pixel, so that slopes up to 15 count in full. sum5 is the sum of five neighbours. >> is
// the shift that rounds down. All fits into 16 bits but the response, which fits into 32; k'
// trace^2 of the closed form det - k trace^2 is 4 k (trace / 2)^2, hence 1024.
#pragma once

#include <cstdint>

#include "vision/image.h"

namespace rockyard::vision {

// Columns and rows from the edge that have no response (it is 0): one for the gradient, two for the
// sums.
inline constexpr int kHarrisMargin_px = 3;

// k' of a weight from 0 to 0.25.
std::int32_t HarrisWeight(double weight);

// Sums of products of gradients over 5 x 5 pixels; 0 within the margin.
struct GradientSums {
  Image<std::int16_t> xx;
  Image<std::int16_t> xy;
  Image<std::int16_t> yy;
};

// Cost: 0.2 ms for 512 x 384 pixels.
GradientSums GradientSumsOf(const GrayImage& image);

// The response of the pixels from (first_column, first_row) on, of as many as `response` has, which
// lie inside.
void HarrisResponse(const GradientSums& sums, std::int32_t weight, int first_column, int first_row,
                    Image<std::int32_t>& response);

}  // namespace rockyard::vision
