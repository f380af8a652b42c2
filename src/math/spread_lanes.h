// Covariances from the moments of points, as many at a time as a Number has lanes, for the kernels
// of plane_batch. Must have the operations of Spread (point_moments.h), one for one, and like
// lanes.h must not include Eigen or containers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/lanes.h"
#include "math/plane_kernel.h"
#include "math/symmetric_eigen_lanes.h"

namespace rockyard::math {

// Whole numbers, kept modulo 2^64, in as many lanes as a register of reals has.
template <typename Real, typename UnsignedWhole, typename SignedWhole>
struct WholeRegister {
  using Unsigned = UnsignedWhole;

  // Returns signed numbers x = 2^32 high + low to the nearest real. For registers that cannot
  // convert, low and high are put into the last digits of 2^52 and of 2^84 + 2^63. Taking these
  // away leaves the high half exact, so that the sum alone rounds.
  static Real ToReal(const Unsigned& whole) {
#if defined(__AVX512DQ__)
    return __builtin_convertvector(reinterpret_cast<SignedWhole>(whole), Real);
#else
    const Unsigned low = (whole & 0xffffffffU) | 0x4330000000000000U;
    const Unsigned high = (whole >> 32) ^ 0x4530000080000000U;
    return (reinterpret_cast<Real>(high) - (0x1p84 + 0x1p63 + 0x1p52)) +
           reinterpret_cast<Real>(low);
#endif
  }
  // Returns reals of magnitude less than 2^63 without their fractions.
  static Unsigned FromReal(const Real& real) {
    return reinterpret_cast<Unsigned>(__builtin_convertvector(real, SignedWhole));
  }
};

using UnsignedPair = std::uint64_t __attribute__((vector_size(16)));
using UnsignedQuad = std::uint64_t __attribute__((vector_size(32)));
using UnsignedOctet = std::uint64_t __attribute__((vector_size(64)));
using SignedPair = std::int64_t __attribute__((vector_size(16)));
using SignedQuad = std::int64_t __attribute__((vector_size(32)));
using SignedOctet = std::int64_t __attribute__((vector_size(64)));

// The whole numbers that belong to each Number, a twin included.
template <typename Number>
struct Whole;
template <>
struct Whole<Pair> : WholeRegister<Pair, UnsignedPair, SignedPair> {};
template <>
struct Whole<Quad> : WholeRegister<Quad, UnsignedQuad, SignedQuad> {};
template <>
struct Whole<Octet> : WholeRegister<Octet, UnsignedOctet, SignedOctet> {};
template <typename Register>
struct Whole<Twin<Register>> {
  using Unsigned = Twin<typename Whole<Register>::Unsigned>;

  static Twin<Register> ToReal(const Unsigned& whole) {
    return {Whole<Register>::ToReal(whole.a), Whole<Register>::ToReal(whole.b)};
  }
  static Unsigned FromReal(const Twin<Register>& real) {
    return {Whole<Register>::FromReal(real.a), Whole<Register>::FromReal(real.b)};
  }
};

// The spread along one axis: the unit next to the mean, the sum of coordinates about that unit, and
// the offset of the mean from it.
template <typename Number>
struct AxisSpread {
  using Unsigned = typename Whole<Number>::Unsigned;

  Unsigned near, rest;
  Number offset;

  AxisSpread(const Unsigned& count, const Unsigned& sum, const Number& inverse_count)
      : near(Whole<Number>::FromReal(Whole<Number>::ToReal(sum) * inverse_count)),
        rest(sum - count * near),
        offset(Whole<Number>::ToReal(rest) * inverse_count) {}
};

// Returns covariances in m2. sum_of(row) gives the sums of a MomentRow in moment units; every set
// has a point.
template <typename Number, typename SumOf>
SymmetricMatrix<Number> CovarianceOf(const SumOf& sum_of) {
  const Number inverse_count = 1.0 / Whole<Number>::ToReal(sum_of(kCountRow));
  using Axis = AxisSpread<Number>;
  const Axis x(sum_of(kCountRow), sum_of(kXRow), inverse_count);
  const Axis y(sum_of(kCountRow), sum_of(kYRow), inverse_count);
  const Axis z(sum_of(kCountRow), sum_of(kZRow), inverse_count);
  const auto covariance = [&](MomentRow product, const Axis& i, const Axis& j, MomentRow j_row) {
    const auto about_near = sum_of(product) - i.near * sum_of(j_row) - j.near * i.rest;
    return (Whole<Number>::ToReal(about_near) * inverse_count - i.offset * j.offset) * 1e-12;
  };
  return {covariance(kXXRow, x, x, kXRow), covariance(kYYRow, y, y, kYRow),
          covariance(kZZRow, z, z, kZRow), covariance(kXYRow, x, y, kYRow),
          covariance(kXZRow, x, z, kZRow), covariance(kYZRow, y, z, kZRow)};
}

}  // namespace rockyard::math
