// The most alike of many windows, in both directions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vision/odometry/window.h"

namespace rockyard::vision {

// Larger than any difference: there is none.
inline constexpr std::uint16_t kNoDifference = std::numeric_limits<std::uint16_t>::max();

// The best of the windows that one was compared with, and the second best difference.
struct BestWindow {
  std::int32_t index = 0;
  std::uint16_t difference = kNoDifference;
  std::uint16_t second = kNoDifference;

  // Takes what was best among windows of larger indices: of equal differences the earlier one
  // stays.
  void Merge(const BestWindow& later) {
    if (later.difference < difference) {
      *this = {later.index, later.difference, std::min(difference, later.second)};
    } else {
      second = std::min(second, later.difference);
    }
  }

  bool operator==(const BestWindow&) const = default;
};

// Of each window of two sets, among those of the other one.
struct BestWindows {
  std::vector<BestWindow> of_first;
  std::vector<BestWindow> of_second;
};

// Every window with every one. Cost: 2 ns a pair with 64 bytes a vector.
BestWindows FindBestWindows(const WindowSet& first, const WindowSet& second);

// The same without second differences, which stay kNoDifference: windows that differ by more than
// the best of both, which their bounds tell, are not compared. Cost: six tenths where images are
// smooth over three pixels.
BestWindows FindLeastDifferent(const WindowSet& first, const WindowSet& second);

}  // namespace rockyard::vision
