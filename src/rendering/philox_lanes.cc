#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/philox_lanes.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rendering/philox_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::rendering::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint64_t> kBlocks;
constexpr hn::Repartition<std::uint32_t, decltype(kBlocks)> kWords;
using Words = hn::Vec<decltype(kWords)>;

// Multipliers and steps of the key of Philox 4x32 (Salmon et al. 2011, table 2; Random123).
constexpr std::uint32_t kMultiplier0 = 0xD2511F53;
constexpr std::uint32_t kMultiplier1 = 0xCD9E8D57;
constexpr std::uint32_t kKeyStep0 = 0x9E3779B9;
constexpr std::uint32_t kKeyStep1 = 0xBB67AE85;
constexpr int kRounds = 10;

// A counter's words in the even lanes of a vector each; odd lanes hold anything.
struct Counters {
  Words w0, w1, w2, w3;
};

HWY_INLINE void Round(Words key0, Words key1, Counters& c) {
  const auto product0 = hn::MulEven(c.w0, hn::Set(kWords, kMultiplier0));
  const auto product1 = hn::MulEven(c.w2, hn::Set(kWords, kMultiplier1));
  const auto high = [](auto product) { return hn::BitCast(kWords, hn::ShiftRight<32>(product)); };
  c.w0 = hn::Xor(hn::Xor(high(product1), c.w1), key0);
  c.w2 = hn::Xor(hn::Xor(high(product0), c.w3), key1);
  c.w1 = hn::BitCast(kWords, product1);
  c.w3 = hn::BitCast(kWords, product0);
}

// Writes the words of each block one after the other.
HWY_INLINE void Save(const Counters& c, std::uint64_t* pairs) {
  const auto low = hn::Set(kBlocks, 0xFFFFFFFFU);
  const auto pair = [&](Words first, Words second) {
    return hn::Or(hn::And(hn::BitCast(kBlocks, first), low),
                  hn::ShiftLeft<32>(hn::BitCast(kBlocks, second)));
  };
  hn::StoreInterleaved2(pair(c.w0, c.w1), pair(c.w2, c.w3), kBlocks, pairs);
}

// Writes two pairs of words a block of 2 N blocks from `first` on, N the lanes of a vector.
HWY_INLINE void DrawTwice(std::uint32_t first, const std::uint32_t* counter,
                          const std::uint32_t* key, std::uint64_t* pairs) {
  const std::size_t lanes = hn::Lanes(kBlocks);
  const auto at = [&](std::uint32_t block) {
    return Counters{hn::BitCast(kWords, hn::Iota(kBlocks, block)), hn::Set(kWords, counter[1]),
                    hn::Set(kWords, counter[2]), hn::Set(kWords, counter[3])};
  };
  // Two side by side, as each round waits for the one before.
  Counters a = at(first);
  Counters b = at(first + static_cast<std::uint32_t>(lanes));
  std::uint32_t key0 = key[0];
  std::uint32_t key1 = key[1];
  for (int round = 0; round < kRounds; ++round) {
    Round(hn::Set(kWords, key0), hn::Set(kWords, key1), a);
    Round(hn::Set(kWords, key0), hn::Set(kWords, key1), b);
    key0 += kKeyStep0;
    key1 += kKeyStep1;
  }
  Save(a, pairs);
  Save(b, pairs + 2 * lanes);
}

void Draw(const std::uint32_t* counter, const std::uint32_t* key, std::size_t blocks,
          std::uint16_t* halves) {
  constexpr std::size_t kHalves = 8;  // of a block
  const std::size_t step = 2 * hn::Lanes(kBlocks);
  HWY_ALIGN std::uint64_t pairs[4 * hn::MaxLanes(kBlocks)];
  for (std::size_t block = 0; block < blocks; block += step) {
    DrawTwice(counter[0] + static_cast<std::uint32_t>(block), counter, key, pairs);
    const std::size_t count = blocks - block < step ? blocks - block : step;
    std::memcpy(halves + block * kHalves, pairs, count * kHalves * sizeof(*halves));
  }
}

}  // namespace rockyard::rendering::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rockyard::rendering {

HWY_EXPORT(Draw);

// Words are whole numbers of 32 bits, the lower half of which comes first in memory.
static_assert(std::endian::native == std::endian::little);

void PhiloxHalves(const std::array<std::uint32_t, 4>& counter,
                  const std::array<std::uint32_t, 2>& key, std::span<std::uint16_t> halves) {
  HWY_DYNAMIC_DISPATCH(Draw)(counter.data(), key.data(), halves.size() / 8, halves.data());
}

}  // namespace rockyard::rendering

#endif  // HWY_ONCE
