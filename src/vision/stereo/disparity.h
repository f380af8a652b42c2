// What stereo gives back: a disparity for every pixel of the left image, or why there is none.
//
// The left pixel (x, y) and the right pixel (x - d, y) show the same point; d is the disparity. A
// disparity is stored as a whole number of 1/32 px, rounded to the nearest; the lowest values of
// the 16 bits say which filter dropped the pixel.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "vision/image.h"

namespace rockyard::vision {

constexpr int kDisparityFractionBits = 5;
constexpr int kDisparityOne = 1 << kDisparityFractionBits;

// The first filter that a pixel fails drops it. In the order in which they are applied:
enum class Drop : std::uint8_t {
  kNone,         // it has a disparity
  kOutside,      // its window, or that of every match in the range, reaches over the image's edge
  kLineOfSight,  // the right pixel that it matches best matches another left pixel better
  kRangeEnd,     // the best match is the first or last candidate: the peak filter lacks a neighbour
  kPeak,         // the score is not better than at the adjacent disparities, or by too little
  kContrast,     // the peak is low beside what remains different at the best match
  kBlob,         // alone, or in a small region of its disparity
};

constexpr int kDropCount = 7;
constexpr std::array<std::string_view, kDropCount> kDropNames{
    "none", "outside", "line_of_sight", "range_end", "peak", "contrast", "blob"};

// Image of disparities and drops, row by row as the left image.
using DisparityImage = Image<std::int16_t>;

constexpr std::int16_t kLowestValid = -32000;

constexpr bool IsValid(std::int16_t disparity) { return disparity >= kLowestValid; }

// The value that stands for a dropped pixel: -32767 and up. `drop` is not kNone.
constexpr std::int16_t Dropped(Drop drop) {
  return static_cast<std::int16_t>(INT16_MIN + static_cast<int>(drop));
}

constexpr Drop DropOf(std::int16_t disparity) {
  return IsValid(disparity) ? Drop::kNone : static_cast<Drop>(disparity - INT16_MIN);
}

// Disparity in pixels. The pixel is valid.
constexpr double DisparityPx(std::int16_t disparity) {
  return static_cast<double>(disparity) / kDisparityOne;
}

// How many pixels each filter dropped, by the value of Drop; those with a disparity come first.
using DropCounts = std::array<std::int64_t, kDropCount>;

DropCounts CountDrops(const DisparityImage& disparities);

}  // namespace rockyard::vision
