// How much of a corner every pixel is, its response (Harris and Stephens 1988), in whole numbers,
// and which pixels stick out by it, for FeatureDetector (detect_features.h).
//
//   gx = clamp((Sobel_x + 1) >> 1)   gy = clamp((Sobel_y + 1) >> 1)      to [-63, 63]
//   xx = sum5_x(sum5_y(gx gx) >> 2)   yy, xy likewise                     up to +-24800
//   response = xx yy - xy^2 - (((xx + yy) >> 1)^2 >> 8) k'                k' = round(1024 k)
//
// Sobel_x is the difference over two columns of rows weighed 1, 2, 1: 8 times a slope in grey
// levels a pixel, so that slopes up to 15 count in full. sum5 is the sum of five neighbours. >> is
// the shift that rounds down. All numbers fit into 16 bits but the response, which fits into 32.
// The closed form is det - k trace^2 = det - 4 k (trace / 2)^2, hence k' = 4 * 256 k. Must stay
// whole numbers, so that every instruction set finds the same corners; they equal a plain form in
// the tests.
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

// Returns the area with `reach` columns and rows about it, as far as an image of the given size has
// them.
ImageArea Widened(const ImageArea& area, int reach, int width, int height);

// Returns k' of a weight k from 0 to 0.25.
std::int32_t HarrisWeight(double weight);

// Sums of products of gradients over 5 x 5 pixels of an area of an image; 0 within the margin of
// the image.
class GradientSums {
 public:
  // The area lies inside the image. Cost: below 1 ns a pixel with 64 bytes a vector.
  GradientSums(const GrayImage& image, const ImageArea& area);

  const ImageArea& area() const { return area_; }

  // Writes the responses of row `row` of the image, which lies in the area, from the area's first
  // column on. `response` is aligned and has room for whole vectors; values behind the area's
  // columns mean nothing.
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

  // Does what GradientSums::WriteResponse does. Rows must be asked for from the first to the last.
  void WriteResponse(int row, std::int32_t* response);

 private:
  ImageArea area_;
  std::int32_t weight_;
  std::size_t stride_;
  AlignedBuffer<std::int16_t> sums_;  // of the last row written
  std::unique_ptr<AreaRows> rows_;
};

// Writes the responses of one row of an area, rows in order (HarrisRows, GradientSums).
using ResponseWriter = std::function<void(int row, std::int32_t* response)>;

// Returns the pixels of `area` whose response is at least `threshold`, larger than that of the
// pixels within `reach` columns and rows that come before in the order of rows, and not smaller
// than that of the pixels within reach that come after; in the order of rows. Must stay: on a
// plateau the first pixel alone is a corner. Only pixels of `all` count, of which `write` writes
// the rows. `all` holds `area`; to get the corners of the whole image, it must also hold what the
// image has within `reach` of the area. Cost: below 1 ns a pixel with 32 bytes a vector and a reach
// of 3.
Features LocalMaxima(const ResponseWriter& write, const ImageArea& all, const ImageArea& area,
                     int reach, std::int32_t threshold);

}  // namespace rockyard::vision
