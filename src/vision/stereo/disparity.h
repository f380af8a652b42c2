// What stereo returns: a disparity for every pixel of the left image, or why there is none. Points
// of terrain sensing, places of visual odometry and the results of `rockyard stereo` come from it.
// Records of drives depend on which pixels have a disparity and on its value; which filter dropped
// a pixel, and the measures against known disparities, matter to the results of that command alone.
//
// Words of this folder: x counts columns to the right, y rows downwards, both whole and from 0 at
// the upper left pixel. The left pixel (x, y) and the right pixel (x - d, y) show the same point; d
// is the disparity. The best match of a pixel is the one of smallest score (correlator.h). A
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

// Why a pixel has no disparity: the first filter that it fails, in the order in which filters are
// applied.
enum class Drop : std::uint8_t {
  kNone,         // it has a disparity
  kOutside,      // its window, or that of every match in the range, reaches over the image's edge;
                 // or DropOutside dropped it
  kLineOfSight,  // the right pixel that it matches best matches another left pixel better
  kRangeEnd,     // the best match is the first or last candidate: the peak filter lacks a neighbour
  kPeak,         // the score is not better than at the adjacent disparities, or by too little
  kContrast,     // the peak is low beside what remains different at the best match
  kBlob,         // alone, or in a small region of its disparity
};

// In the order of Drop. Must stay: these are keys of the results of `rockyard stereo`.
constexpr int kDropCount = 7;
constexpr std::array<std::string_view, kDropCount> kDropNames{
    "none", "outside", "line_of_sight", "range_end", "peak", "contrast", "blob"};

// Disparities and drops of the pixels of the left image.
using DisparityImage = Image<std::int16_t>;

// Below every disparity (SearchDepths: -480 px are -15360) and above every value of Dropped.
constexpr std::int16_t kLowestValid = -32000;

constexpr bool IsValid(std::int16_t disparity) { return disparity >= kLowestValid; }

// Returns the value that stands for a dropped pixel: -32767 and up. `drop` is not kNone.
constexpr std::int16_t Dropped(Drop drop) {
  return static_cast<std::int16_t>(INT16_MIN + static_cast<int>(drop));
}

constexpr Drop DropOf(std::int16_t disparity) {
  return IsValid(disparity) ? Drop::kNone : static_cast<Drop>(disparity - INT16_MIN);
}

// Returns a disparity in pixels. Requires IsValid(disparity).
constexpr double DisparityPx(std::int16_t disparity) {
  return static_cast<double>(disparity) / kDisparityOne;
}

// How many pixels each filter dropped, by the value of Drop; pixels with a disparity come first.
using DropCounts = std::array<std::int64_t, kDropCount>;

DropCounts CountDrops(const DisparityImage& disparities);

// Drops (kOutside) every pixel whose window, or the window of its match, reaches over a pixel that
// is 0 in `left_inside` or `right_inside` (RectificationTable::Inside). The window has side
// `window_side_px`, its pixel at side / 2. All images are of one size. Pixels that another filter
// has dropped stay as they are. A rectified image has pixels that the camera did not see, and
// windows that reach over them compare nothing. On board the masks leave out the rover's own parts
// as well.
void DropOutside(const Image<std::uint8_t>& left_inside, const Image<std::uint8_t>& right_inside,
                 int window_side_px, DisparityImage& disparities);

// A match is bad where its error is above a threshold. Must stay: keys of the results of `rockyard
// stereo` are made of these.
constexpr std::array<double, 4> kBadThresholds_px{0.5, 1.0, 2.0, 4.0};

// Disparities compared with known ones, by the measures of Scharstein and Szeliski 2002 ("A
// taxonomy and evaluation of dense two-frame stereo correspondence algorithms", section 5.1).
struct StereoScore {
  std::int64_t known = 0;                                    // pixels whose disparity is known
  std::int64_t matched = 0;                                  // known pixels with a disparity
  std::array<std::int64_t, kBadThresholds_px.size()> bad{};  // matched, by kBadThresholds_px
  // Errors of the matched pixels; 0 where there are none.
  double mean_error_px = 0.0;  // found less known
  double rms_error_px = 0.0;

  // Returns the share of the known pixels that have a disparity; 0 where none is known.
  double Density() const;
  // Returns the share of the matched pixels that are bad by threshold `i`; 0 where none is matched.
  double BadShare(std::size_t i) const;
};

// Compares `disparities` with `known`, which has the same size, in pixels, not finite where
// unknown.
StereoScore ScoreAgainst(const Image<float>& known, const DisparityImage& disparities);

}  // namespace rockyard::vision
