#include "math/large_angle.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rockyard::math {
namespace {

__extension__ using Wide = unsigned __int128;

// 2/pi = 0.a2f9836e... in base 16: 1280 bits, more than the largest double needs.
constexpr std::array<std::uint64_t, 20> kTwoOverPiBits = {
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
    0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d};

// pi/2 in units of 2^-127.
constexpr std::uint64_t kHalfPiHigh = 0xc90fdaa22168c234;
constexpr std::uint64_t kHalfPiLow = 0xc4c6628b80dc1cd1;

// Returns 64 bits of 2/pi from the bit of weight 2^-(first + 1) on; bits before the point are 0.
std::uint64_t BitsFrom(int first) {
  const auto word = [](int i) {
    return i < 0 || i >= static_cast<int>(kTwoOverPiBits.size())
               ? std::uint64_t{0}
               : kTwoOverPiBits[static_cast<std::size_t>(i)];
  };
  const int at = first >> 6;  // rounds down
  const int shift = first & 63;
  return shift == 0 ? word(at) : (word(at) << shift) | (word(at + 1) >> (64 - shift));
}

// Returns the product of two numbers in units of 2^-128 and 2^-127 over 2^127, rounded down.
Wide TimesHalfPi(Wide x) {
  const std::uint64_t high = static_cast<std::uint64_t>(x >> 64);
  const std::uint64_t low = static_cast<std::uint64_t>(x);
  const Wide middle1 = Wide{high} * kHalfPiLow;
  const Wide middle2 = Wide{low} * kHalfPiHigh;
  const Wide carry = ((Wide{low} * kHalfPiLow) >> 64) + static_cast<std::uint64_t>(middle1) +
                     static_cast<std::uint64_t>(middle2);
  return Wide{high} * kHalfPiHigh + (middle1 >> 64) + (middle2 >> 64) + (carry >> 64);
}

}  // namespace

// Payne & Hanek 1983, in whole numbers: of the product with 2/pi only the bits from weight 2 on,
// 192 of them, are computed.
ReducedAngle ReduceLargeAngle(double radians) {
  if (!std::isfinite(radians)) return {.rest = {radians - radians, 0.0}};
  const auto bits = std::bit_cast<std::uint64_t>(std::abs(radians));
  const std::uint64_t mantissa = (bits & 0xfffffffffffff) | 0x10000000000000;
  const int exponent = static_cast<int>(bits >> 52) - 1075;  // of the mantissa's last bit
  // Bits of 2/pi of a weight above 2 / 2^exponent add whole turns.
  const int first = exponent - 2;
  std::array<std::uint64_t, 3> part{};  // of x 2/pi modulo 4, in units of 2^-190, highest first
  Wide carry = 0;
  for (int i = 2; i >= 0; --i) {
    const Wide product = Wide{mantissa} * BitsFrom(first + 64 * i) + carry;
    part[static_cast<std::size_t>(i)] = static_cast<std::uint64_t>(product);
    carry = product >> 64;
  }
  // What is above half a quadrant belongs to the next one, from which it is missing.
  int quadrant = static_cast<int>(part[0] >> 62);
  const bool from_above = (part[0] >> 61) & 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint64_t next = i < 2 ? part[i + 1] >> 62 : 0;
    part[i] = (part[i] << 2) | next;
    if (from_above) part[i] = ~part[i];
  }
  if (from_above) ++quadrant;
  int shift = 0;
  while (part[0] == 0 && shift < 128) {
    part = {part[1], part[2], 0};
    shift += 64;
  }
  Wide fraction = (Wide{part[0]} << 64) | part[1];
  const int lead = part[0] == 0 ? 0 : std::countl_zero(part[0]);
  if (lead > 0) fraction = (fraction << lead) | (part[2] >> (64 - lead));
  shift += lead;
  // In units of 2^-127 of pi/2, over 2^shift.
  const Wide angle = TimesHalfPi(fraction);
  const double unit = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - 127 - shift) << 52);
  const Wide top = angle >> 75;
  const double high = static_cast<double>(static_cast<std::uint64_t>(top)) * 0x1p75 * unit;
  const Wide remaining = angle - (top << 75);
  const double low =
      (static_cast<double>(static_cast<std::uint64_t>(remaining >> 22)) * 0x1p22) * unit;
  const DoubleDouble rest = FastSum(high, low);
  const bool negative = std::signbit(radians) != from_above;
  if (std::signbit(radians)) quadrant = -quadrant;
  return {.rest = negative ? DoubleDouble{-rest.high, -rest.low} : rest, .quadrant = quadrant & 3};
}

}  // namespace rockyard::math
