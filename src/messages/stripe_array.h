/// @file
/// Values per light stripe and per point of the light stripe sensor's array. Scans, elevations and
/// hazard reports are made of them; stereo's elevations have the same shape.
///
/// Words: a *stripe* is what one laser draws on the ground, from the rover's left (0) to its right.
/// A *row* of the array runs across all stripes, from the nearest (0) to the farthest. A *point* is
/// where a row and a stripe meet. A *scanline* is the image row (of pixels) in which the points of
/// one row are measured; the *column* of a point is its place on that scanline, in pixels.
///
/// Matthies 1995, section 6 and figure 13, has 4 rows by 5 stripes; denser arrays are among the
/// improvements that the section lists. Sizes are known when a sensor is built, and small, so that
/// values lie in place and no scan allocates memory.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>

#include "core/check.h"

namespace rockyard::messages {

/// Rows and stripes of the published array.
inline constexpr std::size_t kStripeRows = 4;
inline constexpr std::size_t kStripes = 5;
/// Rows and stripes of the largest array, to which the parameters of sensor and hazard array are
/// bound.
inline constexpr std::size_t kMaxStripeRows = 7;
inline constexpr std::size_t kMaxStripes = 9;

/// Rows and stripes of an array.
struct StripeArraySize {
  std::size_t rows = kStripeRows;
  std::size_t stripes = kStripes;

  bool operator==(const StripeArraySize&) const = default;
};

/// One value per stripe, left to right.
template <typename T>
class PerStripe {
 public:
  constexpr PerStripe() = default;
  /// Makes `stripes` stripes, at most kMaxStripes, each with `value`.
  constexpr explicit PerStripe(std::size_t stripes, const T& value = T{}) : size_(stripes) {
    EXPECT(stripes <= kMaxStripes);
    for (T& each : *this) each = value;
  }
  /// Makes one stripe for each value, at most kMaxStripes.
  constexpr PerStripe(std::initializer_list<T> values) : size_(values.size()) {
    EXPECT(values.size() <= kMaxStripes);
    std::size_t stripe = 0;
    for (const T& value : values) values_[stripe++] = value;
  }

  /// Returns how many stripes there are; access is not checked.
  constexpr std::size_t size() const { return size_; }
  constexpr T& operator[](std::size_t stripe) { return values_[stripe]; }
  constexpr const T& operator[](std::size_t stripe) const { return values_[stripe]; }
  constexpr T* begin() { return values_.data(); }
  constexpr T* end() { return values_.data() + size_; }
  constexpr const T* begin() const { return values_.data(); }
  constexpr const T* end() const { return values_.data() + size_; }
  constexpr const T& front() const { return values_[0]; }
  constexpr const T& back() const { return values_[size_ - 1]; }
  /// Gives each stripe `value`.
  constexpr void fill(const T& value) {
    for (T& each : *this) each = value;
  }
  constexpr bool operator==(const PerStripe& other) const {
    if (size_ != other.size_) return false;
    for (std::size_t stripe = 0; stripe < size_; ++stripe) {
      if (values_[stripe] != other.values_[stripe]) return false;
    }
    return true;
  }

 private:
  std::size_t size_ = kStripes;
  std::array<T, kMaxStripes> values_{};
};

/// One value per point, [row][stripe].
template <typename T>
class StripeArray {
 public:
  StripeArray() = default;
  /// Makes an array of default values, at most kMaxStripeRows by kMaxStripes.
  explicit StripeArray(StripeArraySize size) : size_(size) {
    EXPECT(size.rows <= kMaxStripeRows && size.stripes <= kMaxStripes);
  }

  /// Return the size of the array.
  const StripeArraySize& size() const { return size_; }
  std::size_t rows() const { return size_.rows; }
  std::size_t stripes() const { return size_.stripes; }

  /// Returns one row, left to right; row < rows() is not checked.
  std::span<T> operator[](std::size_t row) {
    return {values_.data() + row * size_.stripes, size_.stripes};
  }
  std::span<const T> operator[](std::size_t row) const {
    return {values_.data() + row * size_.stripes, size_.stripes};
  }
  /// Return every point, row by row.
  std::span<T> points() { return {values_.data(), size_.rows * size_.stripes}; }
  std::span<const T> points() const { return {values_.data(), size_.rows * size_.stripes}; }

 private:
  StripeArraySize size_;
  std::array<T, kMaxStripeRows * kMaxStripes> values_{};
};

}  // namespace rockyard::messages
