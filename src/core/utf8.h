// Code points of UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace rockyard::core {

struct CodePoint {
  static constexpr char32_t kNone = 0xffffffff;
  char32_t code = kNone;
  std::size_t bytes = 1;
};

// The code point with which a text begins, which is not empty. What is no UTF-8 (cut off, longer
// than needed, a surrogate, beyond U+10FFFF) is one byte of none.
CodePoint FirstCodePoint(std::string_view text);

// Where a text is UTF-8 no longer; its size where all of it is.
std::size_t Utf8Bytes(std::string_view text);

}  // namespace rockyard::core
