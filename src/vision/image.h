// An image: a rectangle of values, row by row from the upper left corner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/check.h"

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

  Value& At(int x, int y) { return values_[Index(x, y)]; }
  const Value& At(int x, int y) const { return values_[Index(x, y)]; }

  // A whole row, from the left.
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

}  // namespace rockyard::vision
