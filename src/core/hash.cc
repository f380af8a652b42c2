#include "core/hash.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

namespace rockyard::core {
namespace {

constexpr std::uint64_t kFnvPrime = 0x100000001b3ULL;

}  // namespace

void Hasher::Byte(std::uint8_t byte) {
  state_ ^= byte;
  state_ *= kFnvPrime;
}

Hasher& Hasher::Bytes(std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) Byte(static_cast<std::uint8_t>(byte));
  return *this;
}

Hasher& Hasher::RawText(std::string_view text) { return Bytes(std::as_bytes(std::span(text))); }

Hasher& Hasher::Text(std::string_view text) { return Integer(text.size()).RawText(text); }

Hasher& Hasher::Integer(std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) Byte(static_cast<std::uint8_t>(value >> shift));
  return *this;
}

Hasher& Hasher::Real(double value) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return Integer(std::bit_cast<std::uint64_t>(std::isnan(value) ? kNan : value));
}

std::string Hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace rockyard::core
