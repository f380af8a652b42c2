// How the fast correlator lays a row of pixels into vectors.
//
// A vector of n lanes does not hold n neighbours: the row is cut into n segments of equal length,
// and lane i walks along segment i. Vector j holds the pixels x = i * segment + j, i = 0 ... n - 1.
// A shift by a disparity or along the window is then another j, an aligned load in all lanes, and a
// sliding sum goes along j with one addition and one subtraction whatever the window. Vectors of
// j < 0 or j >= segment are those of j + segment and j - segment moved by one lane; what has no
// pixel there (x < 0, x >= width) holds anything and is masked.
#pragma once

#include <cstddef>

#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// Disparities that are compared at a time: the two low bits of a key are the place among them.
constexpr int kGroup = 4;

struct LaneLayout {
  LaneLayout(int lanes, int width, const CorrelatorParams& params);

  // Offset of vector j of the arrays that reach as far as disparities do: j in [first, last].
  std::ptrdiff_t Wide(int j) const { return static_cast<std::ptrdiff_t>(j - first) * lanes; }
  std::size_t wide_size() const {
    return static_cast<std::size_t>(last - first + 1) * lane_count();
  }
  std::size_t row_size() const { return static_cast<std::size_t>(segment) * lane_count(); }
  std::size_t lane_count() const { return static_cast<std::size_t>(lanes); }

  // The window of pixel x reaches from x - before to x + after and lies in the image.
  bool WindowInside(int x) const { return x >= before && x + after < width; }

  int lanes;          // of 16 bits
  int width;          // of the image, px
  int segment;        // pixels a lane
  int before, after;  // side = before + 1 + after
  int min_disparity;  // px
  int disparities;    // in the range
  int groups;         // of kGroup disparities; the last one may be in part beyond the range
  int first, last;    // vectors of right pixels: -(largest disparity) ... segment - 1 - smallest
};

}  // namespace rockyard::vision
