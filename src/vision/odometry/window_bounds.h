// What two windows differ by at least, at an eighth of the cost of their difference (successive
// elimination: Li and Salari 1995).
//
// Over a block of 3 x 3 pixels sum |a - b| >= |sum a - sum b|. With means m = (sum of a block) / 9,
// rounded down, sums differ by 9 |m_a - m_b| - 8 at least. A window of 15 x 15 pixels has 25
// blocks:
//
//   difference >= 9 sum |m_a - m_b| - 200
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "vision/odometry/window.h"
#include "vision/stereo/aligned_buffer.h"

namespace rockyard::vision {

// The means of a window's blocks, a byte each; what is left of the 32 bytes is 0.
inline constexpr std::size_t kSignatureWords = 4;
using WindowSignature = std::array<std::uint64_t, kSignatureWords>;

WindowSignature SignatureOf(const std::uint8_t* window);

// Signatures of many windows, laid out for comparison.
class SignatureSet {
 public:
  // As many at a time: the bounds of so many are written at once.
  static constexpr std::size_t kGroup = 32;

  explicit SignatureSet(const WindowSet& windows);

  // Bounds of the differences of a window of this signature to those of the set from `first` on, a
  // multiple of kGroup, to as many as `bounds` has: a multiple of it, too. Behind the last window
  // they mean nothing. `bounds` is aligned.
  void FindBounds(const WindowSignature& window, std::size_t first,
                  std::span<std::uint16_t> bounds) const;

 private:
  std::size_t stride_;
  AlignedBuffer<std::uint64_t> words_;  // the first words of all, the second words, ...
};

}  // namespace rockyard::vision
