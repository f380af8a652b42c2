// Windows of images, laid out for comparison by MatchFeatures. Records depend on all sums of
// differences and on the rounding of WarpWindow, which are the same on every instruction set;
// layout and order of comparisons are free.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>

#include "vision/image.h"
#include "vision/odometry/feature.h"
#include "vision/stereo/aligned_buffer.h"

namespace rockyard::vision {

// A window takes 16 rows of 16 bytes; bytes beyond its side are 0 and add nothing to a difference.
// Windows of up to 15 x 15 pixels differ by 57375 at most, which 16 bits hold.
inline constexpr std::size_t kWindowStride = 16;
inline constexpr std::size_t kWindowBytes = kWindowStride * kWindowStride;

// Memory for many windows, one behind the other; any bytes at first.
class WindowSet {
 public:
  explicit WindowSet(std::size_t count)
      : bytes_(count * kWindowBytes, Filled::kAnything), count_(count) {}

  std::size_t size() const { return count_; }
  std::uint8_t* At(std::size_t i) { return bytes_.data() + i * kWindowBytes; }
  const std::uint8_t* At(std::size_t i) const { return bytes_.data() + i * kWindowBytes; }

 private:
  AlignedBuffer<std::uint8_t> bytes_;
  std::size_t count_;
};

// Writes the window of `side` <= 15 pixels, odd, about a feature; it lies inside the image.
void CopyWindow(const GrayImage& image, const Feature& feature, int side, std::uint8_t* window);

// Writes the window about a feature as a change of view makes it: the pixel at the offset o from
// the middle is interpolated between four pixels at the feature + by_offset o, in whole numbers.
// With B = by_offset in 1/4096, rounded, and clamped to 64 px a pixel:
//
//   q = (B o + 8) >> 4,  place = q >> 8,  (u, v) = q & 255
//   grey = ((256 - v) ((256 - u) g00 + u g10) + v ((256 - u) g01 + u g11) + 2^15) >> 16
//
// Outside of the image its edge repeats. Numbers of by_offset are finite. Cost: 0.2 us with 64
// bytes a vector, more at the edge of the image.
void WarpWindow(const GrayImage& image, const Feature& feature, const Eigen::Matrix2d& by_offset,
                int side, std::uint8_t* window);

// Writes the sums of absolute differences between `window` and the windows of `others` from `first`
// on, as many as `differences` has.
void WindowDifferences(const std::uint8_t* window, const WindowSet& others, std::size_t first,
                       std::span<std::uint16_t> differences);

// Writes the sums of absolute differences between `window` and the `chosen` windows of `others`.
void ChosenDifferences(const std::uint8_t* window, const WindowSet& others,
                       std::span<const std::int32_t> chosen, std::span<std::uint16_t> differences);

// The B of WarpWindow: by how many 1/4096 px the place in the image moves with a column and a row
// of the window.
struct Warp {
  static constexpr double kOne = 4096.0;
  static constexpr double kMost = 64.0;  // pixels a pixel
  // From 1/4096 to 1/256 px, rounded.
  static constexpr int kShift = 4;
  static constexpr std::int32_t kHalf = 1 << (kShift - 1);

  std::int32_t x_by_column = 0;
  std::int32_t x_by_row = 0;
  std::int32_t y_by_column = 0;
  std::int32_t y_by_row = 0;
};

}  // namespace rockyard::vision
