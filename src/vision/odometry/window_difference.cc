// Sums of absolute differences of windows, for every instruction set.
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/window_difference.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/window.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most a window's bytes at once.
constexpr hn::CappedTag<std::uint8_t, kWindowBytes> kBytes;
constexpr hn::Repartition<std::uint64_t, decltype(kBytes)> kSums;

HWY_INLINE std::uint32_t Difference(const std::uint8_t* a, const std::uint8_t* b) {
  auto sum = hn::Zero(kSums);
  for (std::size_t i = 0; i < kWindowBytes; i += hn::Lanes(kBytes)) {
    const auto left = hn::Load(kBytes, a + i);
    const auto right = hn::Load(kBytes, b + i);
    // One of the two differences is 0.
    sum = hn::Add(
        sum, hn::SumsOf8(hn::Or(hn::SaturatedSub(left, right), hn::SaturatedSub(right, left))));
  }
  return static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(kSums, sum)));
}

void Differences(const std::uint8_t* window, const std::uint8_t* others, std::size_t count,
                 std::uint32_t* differences) {
  for (std::size_t i = 0; i < count; ++i) {
    differences[i] = Difference(window, others + i * kWindowBytes);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(Differences);

void WindowDifferences(const std::uint8_t* window, const WindowSet& others,
                       std::span<std::uint32_t> differences) {
  EXPECT(differences.size() == others.size());
  HWY_DYNAMIC_DISPATCH(Differences)(window, others.At(0), others.size(), differences.data());
}

std::uint32_t WindowDifference(const std::uint8_t* a, const std::uint8_t* b) {
  std::uint32_t difference = 0;
  HWY_DYNAMIC_DISPATCH(Differences)(a, b, 1, &difference);
  return difference;
}

}  // namespace rockyard::vision
#endif
