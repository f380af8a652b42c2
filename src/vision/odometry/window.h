// Windows of images, laid out for comparison.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"
#include "vision/odometry/feature.h"
#include "vision/stereo/aligned_buffer.h"

namespace rockyard::vision {

// 16 rows of 16 bytes; what a window of fewer pixels leaves free is 0.
inline constexpr std::size_t kWindowStride = 16;
inline constexpr std::size_t kWindowBytes = kWindowStride * kWindowStride;

// Of many windows, one behind the other.
class WindowSet {
 public:
  explicit WindowSet(std::size_t count) : bytes_(count * kWindowBytes), count_(count) {}

  std::size_t size() const { return count_; }
  std::uint8_t* At(std::size_t i) { return bytes_.data() + i * kWindowBytes; }
  const std::uint8_t* At(std::size_t i) const { return bytes_.data() + i * kWindowBytes; }

 private:
  AlignedBuffer<std::uint8_t> bytes_;
  std::size_t count_;
};

// The window of `side` <= 15 pixels, odd, about a feature; it lies inside the image.
void CopyWindow(const GrayImage& image, const Feature& feature, int side, std::uint8_t* window);

// The window that a change of view makes of it: its pixel at the offset o from the middle is
// interpolated at `middle` + by_offset o, to 1/256 px and rounded to whole grey levels; what lies
// outside of the image repeats its edge.
void WarpWindow(const GrayImage& image, const Pixel& middle, const Eigen::Matrix2d& by_offset,
                int side, std::uint8_t* window);

// Sums of absolute differences of `window` to each of `others`. Cost: 1.2 ns each with 64 bytes a
// vector.
void WindowDifferences(const std::uint8_t* window, const WindowSet& others,
                       std::span<std::uint32_t> differences);
std::uint32_t WindowDifference(const std::uint8_t* a, const std::uint8_t* b);

}  // namespace rockyard::vision
