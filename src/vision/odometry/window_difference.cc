// WindowDifferences and ChosenDifferences (window.h), for every instruction set.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/window_difference.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/sums_of_differences.h"
#include "vision/odometry/window.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors hold at most a window.
constexpr hn::CappedTag<std::uint8_t, kWindowBytes> kBytes;
constexpr hn::Repartition<std::uint64_t, decltype(kBytes)> kSums;
using Sums = hn::Vec<decltype(kSums)>;

// Returns partial sums of the differences of two windows, whose total is the sum.
HWY_INLINE Sums PartialDifferences(const std::uint8_t* a, const std::uint8_t* b) {
  auto sum = SumsOf8Differences(hn::Load(kBytes, a), hn::Load(kBytes, b));
  for (std::size_t i = hn::Lanes(kBytes); i < kWindowBytes; i += hn::Lanes(kBytes)) {
    sum = hn::Add(sum, SumsOf8Differences(hn::Load(kBytes, a + i), hn::Load(kBytes, b + i)));
  }
  return sum;
}

// Returns the sum of all lanes, by halves.
template <class D>
HWY_INLINE std::uint64_t Total(D lanes, hn::Vec<D> sums) {
  if constexpr (hn::MaxLanes(lanes) == 1) {
    return hn::GetLane(sums);
  } else {
    const hn::Half<D> half;
    return Total(half, hn::Add(hn::LowerHalf(half, sums), hn::UpperHalf(half, sums)));
  }
}

// Writes the differences of `window` to four others, which share one word of 64 bits a lane, as
// each total takes 16 bits.
HWY_INLINE void DifferencesOfFour(const std::uint8_t* window, const std::uint8_t* const* others,
                                  std::uint16_t* differences) {
  static_assert(std::endian::native == std::endian::little);
  const auto lower = hn::Add(PartialDifferences(window, others[0]),
                             hn::ShiftLeft<16>(PartialDifferences(window, others[1])));
  const auto upper = hn::Add(PartialDifferences(window, others[2]),
                             hn::ShiftLeft<16>(PartialDifferences(window, others[3])));
  const std::uint64_t words = Total(kSums, hn::Add(lower, hn::ShiftLeft<32>(upper)));
  std::memcpy(differences, &words, sizeof(words));
}

HWY_INLINE std::uint16_t DifferenceOfOne(const std::uint8_t* window, const std::uint8_t* other) {
  return static_cast<std::uint16_t>(Total(kSums, PartialDifferences(window, other)));
}

void Differences(const std::uint8_t* window, const std::uint8_t* others, std::size_t count,
                 std::uint16_t* differences) {
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    const std::uint8_t* const four = others + i * kWindowBytes;
    const std::uint8_t* const each[4] = {four, four + kWindowBytes, four + 2 * kWindowBytes,
                                         four + 3 * kWindowBytes};
    DifferencesOfFour(window, each, differences + i);
  }
  for (; i < count; ++i) differences[i] = DifferenceOfOne(window, others + i * kWindowBytes);
}

void Chosen(const std::uint8_t* window, const std::uint8_t* others, const std::int32_t* chosen,
            std::size_t count, std::uint16_t* differences) {
  for (std::size_t i = 0; i < count; ++i) {
    differences[i] =
        DifferenceOfOne(window, others + static_cast<std::size_t>(chosen[i]) * kWindowBytes);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(Differences);
HWY_EXPORT(Chosen);

void WindowDifferences(const std::uint8_t* window, const WindowSet& others, std::size_t first,
                       std::span<std::uint16_t> differences) {
  EXPECT(first + differences.size() <= others.size());
  HWY_DYNAMIC_DISPATCH(Differences)
  (window, others.At(first), differences.size(), differences.data());
}

void ChosenDifferences(const std::uint8_t* window, const WindowSet& others,
                       std::span<const std::int32_t> chosen, std::span<std::uint16_t> differences) {
  EXPECT(differences.size() >= chosen.size());
  HWY_DYNAMIC_DISPATCH(Chosen)
  (window, others.At(0), chosen.data(), chosen.size(), differences.data());
}

}  // namespace rockyard::vision
#endif
