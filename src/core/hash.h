// FNV-1a, 64 bit (Fowler, Noll and Vo): fingerprints of records and scenarios.
//
// Detects accidental differences (two different inputs agree with probability 2^-64); no protection
// against anyone who looks for collisions. Must stay: the algorithm, and the way in which texts and
// numbers enter. Stored runs, baselines and the kept hashes of first trials hold the values, and
// seeds of sweep cells are made of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rockyard::core {

// Takes values one after the other. Numbers enter as little-endian bytes on every machine.
class Hasher {
 public:
  Hasher& Bytes(std::span<const std::byte> bytes);
  // Takes the bytes alone, as the published test values want it.
  Hasher& RawText(std::string_view text);
  // Takes the length, then the bytes, so that ("ab", "c") differs from ("a", "bc").
  Hasher& Text(std::string_view text);
  Hasher& Integer(std::uint64_t value);
  // Takes the bits, so that 0.0 and -0.0 differ; all NaNs are one.
  Hasher& Real(double value);

  std::uint64_t value() const { return state_; }

 private:
  void Byte(std::uint8_t byte);

  std::uint64_t state_ = 0xcbf29ce484222325ULL;  // FNV offset basis
};

// Returns 16 lower-case hexadecimal digits.
std::string Hex(std::uint64_t value);

}  // namespace rockyard::core
