// Standard normal numbers for pixels, by place in the image and not by order of use.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/random.h"

namespace rockyard::rendering {

// One image's worth of independent standard normal numbers. Eight pixels share a Philox block: each
// takes 16 bits of it through a table of the inverse cumulative function at the middles of 65536
// equally likely cells. The numbers are therefore discrete, symmetric, at most 4.3 in size, and
// have the variance 0.99995; what averages tens of pixels cannot tell. Cost: about 3 ns each.
class PixelNoise {
 public:
  static constexpr int kBlock = 8;

  // `image` names the image within the stream of the purpose, e.g. scan number and exposure.
  PixelNoise(core::TrialKey key, core::Purpose purpose, std::uint32_t image)
      : counter_{0, image, static_cast<std::uint32_t>(purpose), key.trial},
        key_{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)} {}

  // Returns the numbers of eight neighbouring pixels of a line: of columns 8 k .. 8 k + 7 for k =
  // block_column. Columns and rows may be negative, down to -2^15.
  std::array<float, kBlock> Block(int row, int block_column) const;

  // Returns the number of one pixel.
  float At(int row, int column) const {
    const int block = BlockOf(column);
    return Block(row, block)[static_cast<std::size_t>(column - kBlock * block)];
  }

  static constexpr int BlockOf(int column) {
    constexpr int kOffset = 1 << 15;  // a multiple of kBlock: rounds negative columns down
    return (column + kOffset) / kBlock - kOffset / kBlock;
  }

 private:
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 2> key_;
};

// Calls use(column, number) for the columns first .. first + count - 1 of a line.
template <typename Use>
void ForEachPixelNoise(const PixelNoise& noise, int row, int first, int count, Use use) {
  constexpr int kBlock = PixelNoise::kBlock;
  const int last = first + count - 1;
  for (int block = PixelNoise::BlockOf(first); block <= PixelNoise::BlockOf(last); ++block) {
    const auto numbers = noise.Block(row, block);
    for (int i = 0; i < kBlock; ++i) {
      const int column = block * kBlock + i;
      if (column >= first && column <= last) use(column, numbers[static_cast<std::size_t>(i)]);
    }
  }
}

}  // namespace rockyard::rendering
