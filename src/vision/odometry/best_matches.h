// The most alike of many windows, in both directions, for MatchFeatures, and bounds of their
// differences. Records depend on ties: of equal differences the smaller index is the best.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vision/odometry/window.h"
#include "vision/stereo/aligned_buffer.h"

namespace rockyard::vision {

// The means of a window's blocks of 3 x 3 pixels, a byte each; the rest of the 32 bytes is 0. From
// them follows what two windows differ by at least, at an eighth of the cost of their difference
// (successive elimination: Li and Salari 1995).
//
// Over a block sum |a - b| >= |sum a - sum b|. With means m = (sum of a block) / 9,
// rounded down, sums differ by 9 |m_a - m_b| - 8 at least. A window of 15 x 15 pixels has 25
// blocks:
//
//   difference >= 9 sum |m_a - m_b| - 200
inline constexpr std::size_t kSignatureWords = 4;
using WindowSignature = std::array<std::uint64_t, kSignatureWords>;

WindowSignature SignatureOf(const std::uint8_t* window);

// Signatures of many windows, laid out for comparison.
class SignatureSet {
 public:
  // How many windows' bounds are written at once.
  static constexpr std::size_t kGroup = 32;

  explicit SignatureSet(const WindowSet& windows);

  // Writes the bounds of the differences between a window of the given signature and those of the
  // set from `first` on. `first` and the size of `bounds` are multiples of kGroup. Bounds behind
  // the last window mean nothing. `bounds` is aligned.
  void FindBounds(const WindowSignature& window, std::size_t first,
                  std::span<std::uint16_t> bounds) const;

 private:
  std::size_t stride_;
  AlignedBuffer<std::uint64_t> words_;  // the first words of all, the second words, ...
};

// Larger than any difference: stands for none.
inline constexpr std::uint16_t kNoDifference = std::numeric_limits<std::uint16_t>::max();

// The best of the windows that one window was compared with, and the second best difference.
struct BestWindow {
  std::int32_t index = 0;
  std::uint16_t difference = kNoDifference;
  std::uint16_t second = kNoDifference;

  // Takes in the best among further windows, which must have larger indices: of equal differences
  // the present one stays.
  void Merge(const BestWindow& later) {
    if (later.difference < difference) {
      *this = {later.index, later.difference, std::min(difference, later.second)};
    } else {
      second = std::min(second, later.difference);
    }
  }

  bool operator==(const BestWindow&) const = default;
};

// For each window of two sets the best among those of the other set.
struct BestWindows {
  std::vector<BestWindow> of_first;
  std::vector<BestWindow> of_second;
};

// Compares every window of one set with every one of the other. Cost: 2 ns a pair with 64 bytes a
// vector.
BestWindows FindBestWindows(const WindowSet& first, const WindowSet& second);

// Returns the same without second differences, which stay kNoDifference: pairs whose bound is above
// the best difference of both windows are not compared. Cost: six tenths of FindBestWindows where
// images are smooth over three pixels.
BestWindows FindLeastDifferent(const WindowSet& first, const WindowSet& second);

}  // namespace rockyard::vision
