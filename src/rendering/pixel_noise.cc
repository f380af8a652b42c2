#include "rendering/pixel_noise.h"

#include "core/check.h"
#include "core/distributions.h"

namespace rockyard::rendering {
namespace {

constexpr std::size_t kCells = 1 << 16;

std::vector<float> MakeTable() {
  std::vector<float> table(kCells);
  // The lower half mirrors the upper one, so that the mean is 0 to the last bit.
  for (std::size_t i = kCells / 2; i < kCells; ++i) {
    // z at the middle of cell i: the inverse normal distribution at (i + 1/2) / 65536.
    const double middle = (static_cast<double>(i) + 0.5) / kCells;
    table[i] = static_cast<float>(core::NormalQuantile(middle));
    table[kCells - 1 - i] = -table[i];
  }
  return table;
}

const std::vector<float>& Table() {
  static const std::vector<float> kTable = MakeTable();
  return kTable;
}

}  // namespace

std::array<float, PixelNoise::kBlock> PixelNoise::Block(int row, int block_column) const {
  constexpr int kOffset = 1 << 15;
  EXPECT(row >= -kOffset && row < kOffset);
  EXPECT(block_column >= -kOffset && block_column < kOffset);
  std::array<std::uint32_t, 4> counter = counter_;
  // Row and block share one word of the counter, 16 bits each, both counted from -2^15.
  counter[0] = (static_cast<std::uint32_t>(row + kOffset) << 16) |
               static_cast<std::uint32_t>(block_column + kOffset);
  const auto bits = core::Philox4x32(counter, key_);
  const std::vector<float>& table = Table();
  std::array<float, kBlock> numbers{};
  for (std::size_t i = 0; i < bits.size(); ++i) {
    // Two numbers of 16 bits from each of the block's four words.
    numbers[2 * i] = table[bits[i] & 0xFFFFU];
    numbers[2 * i + 1] = table[bits[i] >> 16];
  }
  return numbers;
}

}  // namespace rockyard::rendering
