// RowDifferences (place_features.h), for every instruction set.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/row_difference.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/place_features.h"
#include "vision/stereo/aligned_buffer.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint16_t> kRowSums;
constexpr hn::Rebind<std::uint8_t, decltype(kRowSums)> kRowPixels;
using RowSums = hn::Vec<decltype(kRowSums)>;

// Adds the absolute differences between the pixel `wanted` and those from `seen` on.
HWY_INLINE RowSums AddPixel(RowSums sum, std::uint8_t wanted, const std::uint8_t* seen) {
  const auto a = hn::Set(kRowSums, wanted);
  const auto b = hn::PromoteTo(kRowSums, hn::LoadU(kRowPixels, seen));
  // One of the two differences is 0.
  return hn::Add(sum, hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a)));
}

// x86 has an instruction, which this version of Highway does not know, that takes four pixels at
// once: it sums four absolute differences for eight offsets in each block of 16 bytes. Blocks must
// begin 8 bytes apart.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
// kWords makes the instruction take the 4-byte words (0, 1) and (1, 2) of a block.
HWY_INLINE RowSums SumsOfFour(std::int32_t wanted, const std::uint8_t* seen) {
  const __m512i blocks = _mm512_set_epi64(4, 3, 3, 2, 2, 1, 1, 0);
  const __m512i bytes = _mm512_permutexvar_epi64(blocks, _mm512_loadu_si512(seen));
  constexpr int kWords = 0b10010100;
  return RowSums{_mm512_dbsad_epu8(_mm512_set1_epi32(wanted), bytes, kWords)};
}
#elif HWY_TARGET == HWY_AVX2
HWY_INLINE RowSums SumsOfFour(std::int32_t wanted, const std::uint8_t* seen) {
  const auto block = [seen](std::size_t offset) HWY_ATTR {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(seen + offset));
  };
  const __m256i bytes = _mm256_inserti128_si256(_mm256_castsi128_si256(block(0)), block(8), 1);
  return RowSums{_mm256_mpsadbw_epu8(bytes, _mm256_set1_epi32(wanted), 0)};
}
#elif HWY_TARGET == HWY_SSE4
HWY_INLINE RowSums SumsOfFour(std::int32_t wanted, const std::uint8_t* seen) {
  const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(seen));
  return RowSums{_mm_mpsadbw_epu8(bytes, _mm_set1_epi32(wanted), 0)};
}
#endif

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL || HWY_TARGET == HWY_AVX2 || \
    HWY_TARGET == HWY_SSE4
constexpr std::size_t kAtOnce = 4;

HWY_INLINE RowSums AddPixels(RowSums sum, const std::uint8_t* wanted, const std::uint8_t* seen) {
  std::int32_t four;
  std::memcpy(&four, wanted, sizeof(four));
  return hn::Add(sum, SumsOfFour(four, seen));
}
#else
constexpr std::size_t kAtOnce = 1;

HWY_INLINE RowSums AddPixels(RowSums sum, const std::uint8_t* wanted, const std::uint8_t* seen) {
  return AddPixel(sum, *wanted, seen);
}
#endif

// Writes the sums from the last disparity to the first; `count` makes whole vectors. `left` is the
// upper left pixel of the window; `rows` are the rows of the right eye, `rows_stride` apart, from
// the upper left pixel of the window of the last disparity on.
void AlongRow(const std::uint8_t* left, std::size_t left_stride, const std::uint8_t* rows,
              std::size_t rows_stride, std::size_t count, std::uint16_t* sums) {
  constexpr std::size_t kTogether = kRowSide / kAtOnce * kAtOnce;
  for (std::size_t first = 0; first < count; first += hn::Lanes(kRowSums)) {
    auto sum = hn::Zero(kRowSums);
    for (std::size_t y = 0; y < kRowSide; ++y) {
      const std::uint8_t* const wanted = left + y * left_stride;
      const std::uint8_t* const seen = rows + y * rows_stride + first;
      std::size_t x = 0;
      for (; x < kTogether; x += kAtOnce) sum = AddPixels(sum, wanted + x, seen + x);
      for (; x < kRowSide; ++x) sum = AddPixel(sum, wanted[x], seen + x);
    }
    hn::StoreU(sum, kRowSums, sums + first);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(AlongRow);

void RowDifferences(const GrayImage& left, const GrayImage& right, int column, int row,
                    int first_disparity, std::span<std::uint16_t> differences) {
  const auto count = differences.size();
  const int first = column - first_disparity;
  const int last = first - static_cast<int>(count) + 1;
  EXPECT(row >= kRowReach && row + kRowReach < left.height() && left.height() == right.height());
  EXPECT(column >= kRowReach && column + kRowReach < left.width());
  EXPECT(last >= kRowReach && first + kRowReach < right.width());
  // Whole vectors reach behind the last window, so that the rows are copied to where there is room.
  const std::size_t whole = WholeVectors<std::uint16_t>(count);
  const std::size_t used = count + kRowSide - 1;
  const std::size_t stride = whole + kMostLanes<std::uint16_t>;
  std::vector<std::uint8_t> rows(kRowSide * stride);
  for (std::size_t y = 0; y < kRowSide; ++y) {
    const std::uint8_t* const from =
        &right.At(last - kRowReach, row - kRowReach + static_cast<int>(y));
    std::copy_n(from, used, rows.data() + y * stride);
  }
  std::vector<std::uint16_t> sums(whole);
  HWY_DYNAMIC_DISPATCH(AlongRow)
  (&left.At(column - kRowReach, row - kRowReach), static_cast<std::size_t>(left.width()),
   rows.data(), stride, whole, sums.data());
  std::reverse_copy(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(count),
                    differences.begin());
}

}  // namespace rockyard::vision
#endif
