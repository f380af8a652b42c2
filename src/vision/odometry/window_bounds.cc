// SignatureSet (best_matches.h), for every instruction set.
#include <algorithm>
#include <bit>
#include <cstring>

#include "vision/odometry/best_matches.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/window_bounds.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/sums_of_differences.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors hold at most the words of a quarter of a group.
constexpr hn::CappedTag<std::uint64_t, 8> kWords;
constexpr hn::Repartition<std::uint8_t, decltype(kWords)> kMeans;
constexpr hn::Repartition<std::uint16_t, decltype(kWords)> kBounds;
using Words = hn::Vec<decltype(kWords)>;

// Returns, lane by lane, the sum of |m_a - m_b| between `window` and the windows whose first words
// begin at `words`.
HWY_INLINE Words SignatureDifferences(const std::uint64_t* window, const std::uint64_t* words,
                                      std::size_t stride) {
  auto sum = hn::Zero(kWords);
  for (std::size_t i = 0; i < kSignatureWords; ++i) {
    const auto own = hn::BitCast(kMeans, hn::Set(kWords, window[i]));
    const auto others = hn::BitCast(kMeans, hn::Load(kWords, words + i * stride));
    sum = hn::Add(sum, SumsOf8Differences(own, others));
  }
  return sum;
}

// Writes the bounds of some groups. Four neighbouring windows share one lane, 16 bits each; PlaceOf
// lays signatures out for that.
void Bounds(const std::uint64_t* window, const std::uint64_t* words, std::size_t stride,
            std::size_t groups, std::uint16_t* bounds) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::size_t kQuarter = SignatureSet::kGroup / 4;
  // 9 sum |m_a - m_b| - 200 (best_matches.h), not below 0; 9 * 25 * 255 fits 16 bits.
  const auto nine = hn::Set(kBounds, 9);
  const auto rounding = hn::Set(kBounds, 200);
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t lane = 0; lane < kQuarter; lane += hn::Lanes(kWords)) {
      const std::uint64_t* const at = words + group * SignatureSet::kGroup + lane;
      const auto lower =
          hn::Add(SignatureDifferences(window, at, stride),
                  hn::ShiftLeft<16>(SignatureDifferences(window, at + kQuarter, stride)));
      const auto upper =
          hn::Add(SignatureDifferences(window, at + 2 * kQuarter, stride),
                  hn::ShiftLeft<16>(SignatureDifferences(window, at + 3 * kQuarter, stride)));
      const auto sums = hn::BitCast(kBounds, hn::Add(lower, hn::ShiftLeft<32>(upper)));
      hn::Store(hn::SaturatedSub(hn::Mul(sums, nine), rounding), kBounds,
                bounds + group * SignatureSet::kGroup + 4 * lane);
    }
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(Bounds);

namespace {

constexpr std::size_t kSide = 3;
constexpr std::size_t kBlocks = 5;  // of a row, and rows of blocks

// Returns the place of a window's words. Windows i, i + 4, ... of a group lie side by side, as
// Bounds reads them.
std::size_t PlaceOf(std::size_t window) {
  const std::size_t in_group = window % SignatureSet::kGroup;
  return window - in_group + in_group % 4 * (SignatureSet::kGroup / 4) + in_group / 4;
}

}  // namespace

// Sums of a block of 3 x 3 pixels are at most 2295, up to which x / 9 is (7282 x) >> 16.
WindowSignature SignatureOf(const std::uint8_t* window) {
  constexpr std::size_t kColumns = kBlocks * kSide;
  std::array<std::uint8_t, sizeof(WindowSignature)> means{};
  std::array<std::uint16_t, kWindowStride + 2> columns{};
  std::array<std::uint16_t, kWindowStride> mean{};
  for (std::size_t block_row = 0; block_row < kBlocks; ++block_row) {
    const std::uint8_t* const rows = window + block_row * kSide * kWindowStride;
    for (std::size_t x = 0; x < kWindowStride; ++x) {
      columns[x] = static_cast<std::uint16_t>(rows[x] + rows[x + kWindowStride] +
                                              rows[x + 2 * kWindowStride]);
    }
    for (std::size_t x = 0; x < kWindowStride; ++x) {
      const auto sum = static_cast<std::uint16_t>(columns[x] + columns[x + 1] + columns[x + 2]);
      mean[x] = static_cast<std::uint16_t>((7282U * sum) >> 16U);
    }
    for (std::size_t x = 0; x < kColumns; x += kSide) {
      means[block_row * kBlocks + x / kSide] = static_cast<std::uint8_t>(mean[x]);
    }
  }
  return std::bit_cast<WindowSignature>(means);
}

SignatureSet::SignatureSet(const WindowSet& windows)
    : stride_((windows.size() + kGroup - 1) / kGroup * kGroup), words_(kSignatureWords * stride_) {
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const WindowSignature signature = SignatureOf(windows.At(i));
    for (std::size_t word = 0; word < kSignatureWords; ++word) {
      words_.data()[word * stride_ + PlaceOf(i)] = signature[word];
    }
  }
}

void SignatureSet::FindBounds(const WindowSignature& window, std::size_t first,
                              std::span<std::uint16_t> bounds) const {
  EXPECT(first % kGroup == 0 && bounds.size() % kGroup == 0);
  EXPECT(first + bounds.size() <= stride_);
  HWY_DYNAMIC_DISPATCH(Bounds)
  (window.data(), words_.data() + first, stride_, bounds.size() / kGroup, bounds.data());
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE
