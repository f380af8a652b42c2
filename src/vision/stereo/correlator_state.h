// What the fast correlator keeps from row to row of an image: rows as vectors, sums, scores,
// minima.
//
// 16-bit words are in the order of LaneLayout. Pixel values are stored
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

  // Vector j = 0 of the sums of a disparity, of the changes of one of a group.
  std::uint16_t* Scores(int disparity_index) {
    return scores.data() + layout.row_size() * Size(disparity_index + 1);
  }
  std::uint16_t* Changes(int place) {
    return changes.data() + change_stride * Size(place) +
           Size(layout.before + 1) * layout.lane_count();
  }

  static std::size_t Size(int n) { return static_cast<std::size_t>(n); }

  LaneLayout layout;
  std::size_t change_stride;           // words from one disparity of a group to the next
  Words left_rows, right_rows;         // pixels
  Words changes;                       // by the row that comes and the one that goes, of a column
  Words scores;                        // keys without masks, at the current row
  Words left_key, left_group;          // the best of each left pixel so far
  Words right_key, right_group;        // the best of each right pixel so far
  Words right_index;                   // disparity of the latter, from the smallest one
  Words left_mask, right_mask;         // kNoKey where the window reaches over the edge, else 0
  AlignedBuffer<std::int16_t> result;  // disparities of the current row
  AlignedBuffer<std::uint8_t> pixels;  // a row as it is in the image, zero behind
  AlignedBuffer<std::int16_t> row;     // the result in the order of the image
};

}  // namespace rockyard::vision
