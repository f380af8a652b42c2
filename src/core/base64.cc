#include "core/base64.h"

#include <cstddef>

namespace rockyard::core {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Up to three bytes as the upper bits of a group of 24; bytes beyond the end are zero.
std::uint32_t Group(std::span<const std::uint8_t> bytes, std::size_t first) {
  std::uint32_t group = 0;
  for (std::size_t i = first; i < first + 3; ++i) {
    group = (group << 8U) | (i < bytes.size() ? bytes[i] : 0U);
  }
  return group;
}

}  // namespace

std::string Base64(std::span<const std::uint8_t> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t first = 0; first < bytes.size(); first += 3) {
    const std::uint32_t group = Group(bytes, first);
    // n bytes fill n + 1 digits.
    const std::size_t digits = bytes.size() - first >= 3 ? 4 : bytes.size() - first + 1;
    for (std::size_t digit = 0; digit < 4; ++digit) {
      const std::uint32_t six_bits = (group >> (18U - 6U * digit)) & 63U;
      text += digit < digits ? kAlphabet[six_bits] : '=';
    }
  }
  return text;
}

std::string Base64(std::string_view bytes) {
  return Base64(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

}  // namespace rockyard::core
