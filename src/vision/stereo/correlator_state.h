// What the fast correlator keeps from row to row of an image: rows as vectors, sums, scores,
// minima.
//
// All arrays but `result` hold 16-bit words in the order of LaneLayout. Pixel values are stored
// four times as large, so that sums leave their two low bits to a disparity's place in its group:
// such a sum is a key, and the smaller key is the better match, or the one at the smaller disparity
// of two in a group that match as well. The cost in memory is about 4 bytes a pixel of a row and
// disparity.
#pragma once

#include <cstddef>
#include <cstdint>

#include "vision/stereo/aligned_buffer.h"
#include "vision/stereo/lane_layout.h"

namespace rockyard::vision {

// A key that no candidate has: the masked ones.
constexpr std::uint16_t kNoKey = 0xFFFF;
constexpr int kKeyShift = 2;

struct CorrelatorState {
  using Words = AlignedBuffer<std::uint16_t>;

  CorrelatorState(int lanes, int width, const CorrelatorParams& params);

  // Rows of the window and the one that leaves it; the slot behind these stays zero.
  int slots() const { return layout.before + layout.after + 2; }
  int zero_slot() const { return slots(); }
  std::uint16_t* Left(int slot) { return left_rows.data() + layout.row_size() * Size(slot); }
  std::uint16_t* Right(int slot) { return right_rows.data() + layout.wide_size() * Size(slot); }

  // Vector j = 0 of the column sums, of the scores of a disparity.
  std::uint16_t* Columns(int disparity_index) {
    return columns.data() + column_stride * Size(disparity_index) +
           Size(layout.before + 1) * layout.lane_count();
  }
  std::uint16_t* Scores(int disparity_index) {
    return scores.data() + layout.row_size() * Size(disparity_index + 1);
  }

  static std::size_t Size(int n) { return static_cast<std::size_t>(n); }

  LaneLayout layout;
  std::size_t column_stride;           // words from one disparity to the next
  Words left_rows, right_rows;         // pixels
  Words columns;                       // sums over the window's rows, of one column
  Words scores;                        // keys of the current row; one row more at either end
  Words left_key, left_group;          // the best of each left pixel so far
  Words right_key, right_group;        // the best of each right pixel so far
  Words right_index;                   // disparity of the latter, from the smallest one
  Words left_mask, right_mask;         // kNoKey where the window reaches over the edge, else 0
  AlignedBuffer<std::int16_t> result;  // disparities of the current row
};

}  // namespace rockyard::vision
