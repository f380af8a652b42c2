// How much of a corner every pixel is (Harris and Stephens 1988), in whole numbers, and which
// pixels stick out by it.
//
//   gx = clamp((Sobel_x + 1) >> 1)   gy = clamp((Sobel_y + 1) >> 1)      to [-63, 63]
//   xx = sum5_x(sum5_y(gx gx) >> 2)   yy, xy likewise                     up to +-24800
//   response = xx yy - xy^2 - (((xx + yy) >> 1)^2 >> 8) k'                k' = round(1024 k)
//
// Sobel_x is the difference over two columns of rows weighed 1, 2, 1: 8 times a slope in grey
// levels a pixel, so that slopes up to 15 count in full. sum5 is the sum of five neighbours. >> is
// the shift that rounds down. All fits into 16 bits but the response, which fits into 32; k'
// trace^2 of the closed form det - k trace^2 is 4 k (trace / 2)^2, hence 1024. Whole numbers give
// the same corners on every instruction set; a plain form with divisions in the tests holds each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "vision/image.h"
#include "vision/odometry/feature.h"
#include "vision/stereo/aligned_buffer.h"

namespace rockyard::vision {

// Columns and rows from the edge that have no response (it is 0): one for the gradient, two for the
// sums.
inline constexpr int kHarrisMargin_px = 3;

// Columns from `left` to before `right`, rows from `top` to before `bottom`.
struct ImageArea {
  int left = 0;
  int right = 0;
  int top = 0;
  int bottom = 0;

  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

// The area and `reach` columns and rows about it, as far as an image of this size has them.
ImageArea Widened(const ImageArea& area, int reach, int width, int height);

// k' of a weight from 0 to 0.25.
std::int32_t HarrisWeight(double weight);

// Sums of products of gradients over 5 x 5 pixels of an area of an image; 0 within the margin of
// the image.
class GradientSums {
 public:
  // The area lies inside the image. Cost: below 1 ns a pixel with 64 bytes a vector.
  GradientSums(const GrayImage& image, const ImageArea& area);

  const ImageArea& area() const { return area_; }

  // Writes the response of row `row` of the image, which the area has, from its first column on.
  // `response` is aligned and has room for whole vectors; what is written behind the area's columns
  // means nothing.
  void WriteResponse(int row, std::int32_t weight, std::int32_t* response) const;

 private:
  // Sums of one row: `stride_` of each product.
  std::int16_t* Row(int row) {
    return sums_.data() + 3 * stride_ * static_cast<std::size_t>(row - area_.top);
  }
  const std::int16_t* Row(int row) const {
    return sums_.data() + 3 * stride_ * static_cast<std::size_t>(row - area_.top);
  }

  ImageArea area_;
  std::size_t stride_;
  AlignedBuffer<std::int16_t> sums_;
};

class AreaRows;

// The responses of an area of an image to one weight, from its first row on, without keeping sums.
class HarrisRows {
 public:
  // The image outlives it; the area lies inside.
  HarrisRows(const GrayImage& image, const ImageArea& area, std::int32_t weight);
  ~HarrisRows();
  HarrisRows(const HarrisRows&) = delete;
  HarrisRows& operator=(const HarrisRows&) = delete;

  const ImageArea& area() const { return area_; }

  // As GradientSums::WriteResponse, of a row that no later one was written before.
  void WriteResponse(int row, std::int32_t* response);

 private:
  ImageArea area_;
  std::int32_t weight_;
  std::size_t stride_;
  AlignedBuffer<std::int16_t> sums_;  // of the row that was written last
  std::unique_ptr<AreaRows> rows_;
};

// Writes the responses of one row of an area, rows in order (HarrisRows, GradientSums).
using ResponseWriter = std::function<void(int row, std::int32_t* response)>;

// Pixels of `area` whose response is at least `threshold`, larger than that of the pixels within
// `reach` columns and rows that come before them in the order of rows, and not smaller than that of
// those that come after; in the order of rows. Pixels that `all` lacks do not count: it has those
// of the area, and, where the answer is to be that of the whole image, those around it, which the
// image has. `write` writes the rows of `all`. Cost: below 1 ns a pixel with 32 bytes a vector and
// a reach of 3.
Features LocalMaxima(const ResponseWriter& write, const ImageArea& all, const ImageArea& area,
                     int reach, std::int32_t threshold);

}  // namespace rockyard::vision
