// Which neighbours in an image of disparities are linked (blob.h), for FilterBlobs, 64 pixels a
// word. Every instruction set must find the same links, as records depend on the regions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rockyard::vision {

// Bit x % 64 of word x / 64 is about pixel x of a row; bits behind the row are 0.
struct RowLinks {
  explicit RowLinks(std::size_t width)
      : valid(width / 64 + 1), to_left(width / 64 + 1), to_above(width / 64 + 1) {}

  std::vector<std::uint64_t> valid;     // has a disparity
  std::vector<std::uint64_t> to_left;   // of one region with pixel x - 1
  std::vector<std::uint64_t> to_above;  // of one region with pixel x of the row above
};

// A row as FindLinks loads it: with an invalid pixel before it and at least one behind it, up to a
// multiple of 64.
struct PaddedRow {
  explicit PaddedRow(std::size_t width);
  void Assign(std::span<const std::int16_t> row);
  const std::int16_t* data() const { return values.data() + 1; }

  std::vector<std::int16_t> values;
};

// Fills the links of a row of `width` pixels. Pixels are linked where both have a disparity and the
// disparities differ by max_step (in 1/32 px) or less.
void FindLinks(const PaddedRow& row, const PaddedRow& above, std::size_t width,
               std::int16_t max_step, RowLinks& links);

}  // namespace rockyard::vision
