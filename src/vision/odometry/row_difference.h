// Sums of absolute differences of one window along a row of the other eye.
#pragma once

#include <cstdint>
#include <span>

#include "vision/image.h"

namespace rockyard::vision {

inline constexpr int kRowSide = 15;
inline constexpr int kRowReach = kRowSide / 2;

// Of the window of 15 x 15 pixels about (column, row) of the left image to those about (column - d,
// row) of the right one, d = first_disparity, first_disparity + 1, ..., one for each of
// `differences`. The windows lie inside. Cost: 0.4 us
// for 96 with 64 bytes a vector.
void RowDifferences(const GrayImage& left, const GrayImage& right, int column, int row,
                    int first_disparity, std::span<std::uint16_t> differences);

}  // namespace rockyard::vision
