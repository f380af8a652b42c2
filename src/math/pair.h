// Two numbers that go through the same operations side by side, in one SIMD register of every
// 64-bit x86 and ARM processor: the vector types of GCC and Clang. Each operation rounds as its
// scalar form does, so pairing changes no result.
#pragma once

#include <cmath>

namespace rockyard::math {

using Pair = double __attribute__((vector_size(16)));

inline Pair Both(double value) { return Pair{value, value}; }
inline Pair Sqrt(Pair x) { return Pair{std::sqrt(x[0]), std::sqrt(x[1])}; }
inline Pair Max(Pair a, Pair b) { return a > b ? a : b; }
inline Pair Min(Pair a, Pair b) { return a < b ? a : b; }
inline Pair Abs(Pair x) { return Max(x, -x); }

}  // namespace rockyard::math
