// The stages of stereo as a compiler without vectors makes them: sliding sums, one number at a
// time, the algorithm of the fast stages. What the plain reference (plain_stereo) has by definition
// has here the work of the C code that Goldberg 2002 section 3 starts from.
//
// The file is compiled twice, without optimization and with, as that section has both. Rows are
// bare pointers and nothing here is a template, so that no function is shared with the fast code.
#pragma once

#include <cstdint>

#include "vision/stereo/correlator.h"

namespace rockyard::vision {

struct ScalarFilter {
  int narrow_side;
  int wide_side;
  std::int32_t narrow_weight;  // dog.h
  std::int32_t wide_weight;
  int limit;
};

// A row of the image with its buffers; tables have an entry a pixel and disparity.
struct ScalarRows {
  int width;
  int before;  // the window reaches from x - before to x + after
  int after;
  int min_disparity;
  int disparities;
  std::uint16_t* columns;     // differences summed over the rows of the window
  std::uint16_t* scores;      // over the whole window
  std::uint16_t* left_best;   // score of the best match of each left pixel, 0xFFFF: none
  std::int16_t* left_index;   // its disparity, counted from the smallest
  std::uint16_t* right_best;  // the same of each right pixel
  std::int16_t* right_index;
};

struct ScalarStages {
  // Means of 2^level x 2^level pixels, rounded (pyramid.h); 1 <= level <= 6.
  void (*reduce)(const std::uint8_t* image, int width, int height, int level, std::uint8_t* out);
  // Difference of Gaussians; `sums` has 2 * width entries.
  void (*filter)(const std::uint8_t* image, int width, int height, const ScalarFilter& filter,
                 std::int32_t* sums, std::uint8_t* out);
  // "Prepare Next Row": takes a row of both images into the sums, another one out.
  void (*prepare)(const ScalarRows& rows, const std::uint8_t* left_in, const std::uint8_t* right_in,
                  const std::uint8_t* left_out, const std::uint8_t* right_out);
  // "Inner Loop": the best match of each left and right pixel.
  void (*compare)(const ScalarRows& rows);
  // "Compute Sub-Pixel", with the checks that stand beside it.
  void (*decide)(const ScalarRows& rows, const PeakLimits& limits, std::int16_t* disparities);
};

// Compiled with -O0, and with the optimization of the build but without vectors.
const ScalarStages& UnoptimizedStages();
const ScalarStages& OptimizedStages();

}  // namespace rockyard::vision
