// Disparities held against known ones: the measures of Scharstein and Szeliski 2002 ("A taxonomy
// and evaluation of dense two-frame stereo correspondence algorithms", section 5.1).
#pragma once

#include <array>
#include <cstdint>

#include "vision/image.h"
#include "vision/stereo/disparity.h"

namespace rockyard::vision {

// A match is bad where it is off by more than these.
constexpr std::array<double, 4> kBadThresholds_px{0.5, 1.0, 2.0, 4.0};

struct StereoScore {
  std::int64_t known = 0;                                    // pixels whose disparity is known
  std::int64_t matched = 0;                                  // of these, with a disparity
  std::array<std::int64_t, kBadThresholds_px.size()> bad{};  // of these, by kBadThresholds_px
  // Of the matched ones; 0 where there are none.
  double mean_error_px = 0.0;  // found less known
  double rms_error_px = 0.0;

  // Share of the known pixels that have a disparity; 0 where none is known.
  double Density() const;
  // Share of the matched pixels that are bad by threshold `i`; 0 where none is matched.
  double BadShare(std::size_t i) const;
};

// `known` is of the same size, in pixels, not finite where unknown.
StereoScore ScoreAgainst(const Image<float>& known, const DisparityImage& disparities);

}  // namespace rockyard::vision
