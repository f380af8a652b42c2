// Jumps in depth along an image row, as disparities show them.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rockyard::sensing {

inline constexpr int kNoJump = std::numeric_limits<int>::max() / 2;

// Fills `distance_px` with the number of columns from each pixel of a row to the nearest jump of
// jump_px or more between two columns: 1 for the two pixels on its sides, kNoJump or more where the
// row has none. A window of half width k around a pixel, 2 k + 1 columns wide, holds both sides of
// the jump where the distance is k or less. Both spans have one length. Cost: two passes.
inline void JumpDistances(std::span<const double> row_px, double jump_px,
                          std::span<int> distance_px) {
  const std::size_t size = row_px.size();
  const auto jumps = [&](std::size_t column) {  // between column - 1 and column
    return std::abs(row_px[column] - row_px[column - 1]) >= jump_px;
  };
  int distance = kNoJump;
  for (std::size_t column = 0; column < size; ++column) {
    distance = column > 0 && jumps(column) ? 1 : distance + 1;
    distance_px[column] = distance;
  }
  distance = kNoJump;
  for (std::size_t column = size; column-- > 0;) {
    distance = column + 1 < size && jumps(column + 1) ? 1 : distance + 1;
    if (distance < distance_px[column]) distance_px[column] = distance;
  }
}

// Returns the first column on the other side of the jump that lies `distance_px` columns from
// `column`, as JumpDistances has it; the right one of two at the same distance.
inline std::size_t AcrossJump(std::span<const double> row_px, double jump_px, std::size_t column,
                              int distance_px) {
  const auto distance = static_cast<std::size_t>(distance_px);
  const std::size_t right = column + distance;
  const bool to_the_right =
      right < row_px.size() && std::abs(row_px[right] - row_px[right - 1]) >= jump_px;
  return to_the_right ? right : column - distance;
}

}  // namespace rockyard::sensing
