// Several numbers that go through the same operations side by side, in SIMD registers: the vector
// types of GCC and Clang. Each operation rounds as its scalar form does, so that doing it side by
// side changes no result.
//
// The planes of GESTALT's maps go through here, and the records of all drives with such a map
// depend on them. A process takes the widest registers that its processor has, so results must not
// depend on the width: no fused or approximated operation, and no sum across lanes. Must not be
// included: Eigen and containers, as the linker could take their code from a file that is compiled
// for wider registers.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

namespace rockyard::math {

// A pair fits one register of every 64-bit x86 and ARM processor. Quads and octets are for files
// that are compiled for processors whose registers hold as many numbers.
using Pair = double __attribute__((vector_size(16)));
using Quad = double __attribute__((vector_size(32)));
using Octet = double __attribute__((vector_size(64)));

// Two registers that go through the same operations side by side. Where each operation waits for
// the one before, as in math/symmetric_eigen_lanes.h, a processor does two for the time of one.
template <typename Register>
struct Twin {
  Register a, b;

  Twin() = default;
  Twin(Register a_lanes, Register b_lanes) : a(a_lanes), b(b_lanes) {}
  // Puts `value` in all lanes, so that numbers may stand among twins as they may among registers.
  Twin(double value) : a(value - Register{}), b(value - Register{}) {}  // NOLINT

  friend Twin operator+(const Twin& x, const Twin& y) { return {x.a + y.a, x.b + y.b}; }
  friend Twin operator-(const Twin& x, const Twin& y) { return {x.a - y.a, x.b - y.b}; }
  friend Twin operator*(const Twin& x, const Twin& y) { return {x.a * y.a, x.b * y.b}; }
  friend Twin operator/(const Twin& x, const Twin& y) { return {x.a / y.a, x.b / y.b}; }
  friend Twin operator-(const Twin& x) { return {-x.a, -x.b}; }
  friend auto operator>(const Twin& x, const Twin& y) { return Twins(x.a > y.a, x.b > y.b); }
  friend auto operator<(const Twin& x, const Twin& y) { return Twins(x.a < y.a, x.b < y.b); }
  friend auto operator>=(const Twin& x, const Twin& y) { return Twins(x.a >= y.a, x.b >= y.b); }
  friend Twin operator&(const Twin& x, const Twin& y) { return {x.a & y.a, x.b & y.b}; }
  friend Twin operator~(const Twin& x) { return {~x.a, ~x.b}; }

 private:
  template <typename Mask>
  static Twin<Mask> Twins(Mask a, Mask b) {
    return {a, b};
  }
};

// Returns `value` in all lanes. Subtracting 0 keeps its bits, the sign of a zero, too.
template <typename Number>
Number All(double value) {
  return value - Number{};
}

// Returns x where a comparison holds, else y.
template <typename Number, typename Mask>
Number Select(const Mask& mask, const Number& x, const Number& y) {
  if constexpr (requires { mask.b; }) {
    return {mask.a ? x.a : y.a, mask.b ? x.b : y.b};
  } else {
    return mask ? x : y;
  }
}

template <typename Register>
Register Sqrt(const Register& x) {
  Register root;
  for (std::size_t i = 0; i < sizeof(x) / sizeof(double); ++i) root[i] = std::sqrt(x[i]);
  return root;
}
template <typename Register>
Twin<Register> Sqrt(const Twin<Register>& x) {
  return {Sqrt(x.a), Sqrt(x.b)};
}

// Must stay: unlike std::max and std::min, Max and Min return b where both are equal, as zeros of
// either sign are, or where one is not a number. Bits of results depend on it.
template <typename Number>
Number Max(const Number& a, const Number& b) {
  return Select(a > b, a, b);
}

template <typename Number>
Number Min(const Number& a, const Number& b) {
  return Select(a < b, a, b);
}

template <typename Number>
Number Abs(const Number& x) {
  return Max<Number>(x, -x);
}

// Returns the lanes that lie at `first`. A twin is loaded register by register: copied whole, it
// would pass through memory in pieces.
template <typename Number, typename Element>
Number Load(const Element* first) {
  if constexpr (requires(Number number) { number.b; }) {
    using Register = decltype(Number::a);
    constexpr std::size_t kRegister = sizeof(Register) / sizeof(Element);
    return {Load<Register>(first), Load<Register>(first + kRegister)};
  } else {
    Number number;
    std::memcpy(&number, first, sizeof(number));
    return number;
  }
}

// Returns whether a comparison holds in any lane.
template <typename Mask>
bool Any(const Mask& mask) {
  auto any = mask[0];
  for (std::size_t i = 1; i < sizeof(mask) / sizeof(any); ++i) any |= mask[i];
  return any != 0;
}
template <typename Mask>
bool Any(const Twin<Mask>& mask) {
  return Any(mask.a | mask.b);
}

}  // namespace rockyard::math
