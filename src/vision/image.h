// A rectangle of values, row by row from the upper left corner, for everything that makes, stores
// or reads images: rendering, image files, stereo, visual odometry and the finders of the cylinder.
// Must stay: rows follow each other without padding. Fast stages step by width() from row to row,
// and indices count over all pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/check.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::vision {

template <typename Value>
class Image {
 public:
  Image() = default;

  // width, height >= 0.
  Image(int width, int height, Value fill = Value{}) : width_(width), height_(height) {
    EXPECT(width >= 0 && height >= 0);
    values_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return values_.empty(); }

  // (x, y) lies inside; nothing checks it.
  Value& At(int x, int y) { return values_[Index(x, y)]; }
  const Value& At(int x, int y) const { return values_[Index(x, y)]; }

  // A whole row from the left; y lies inside.
  std::span<Value> Row(int y) { return {values_.data() + Index(0, y), RowSize()}; }
  std::span<const Value> Row(int y) const { return {values_.data() + Index(0, y), RowSize()}; }

  // All rows, one after the other.
  std::span<Value> values() { return values_; }
  std::span<const Value> values() const { return values_; }

  bool operator==(const Image&) const = default;

 private:
  std::size_t RowSize() const { return static_cast<std::size_t>(width_); }
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * RowSize() + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<Value> values_;
};

// 8 bits of grey a pixel.
using GrayImage = Image<std::uint8_t>;

// 8 bits of each primary colour, in the coding of the camera or of the file.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

using ColourImage = Image<Rgb>;

// Returns whether an image has the rows and columns of a camera, and so can be of it.
inline bool HasSizeOf(const ColourImage& image, const CameraModel& camera) {
  return !image.empty() && image.width() == camera.size.columns &&
         image.height() == camera.size.rows;
}

}  // namespace rockyard::vision
