#include "core/utf8.h"

#include <array>

#include "core/check.h"

namespace rockyard::core {

CodePoint FirstCodePoint(std::string_view text) {
  EXPECT(!text.empty());
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < bytes) return {};
  char32_t code = byte(0) & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fU);
  }
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[bytes] || surrogate || code > 0x10ffff) return {};
  return {code, bytes};
}

std::size_t Utf8Bytes(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const CodePoint first = FirstCodePoint(text.substr(at));
    if (first.code == CodePoint::kNone) break;
    at += first.bytes;
  }
  return at;
}

}  // namespace rockyard::core
