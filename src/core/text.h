// Texts of others: did you mean ...?, UTF-8, XML.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace rockyard::core {

// A key of JSON as paths in messages name it: `""` for the one that is empty, which nobody could
// see.
std::string_view ShownKey(std::string_view key);

// Damerau-Levenshtein distance with adjacent transpositions (optimal string alignment): insertions,
// deletions, replacements and swaps of neighbours that turn one text into the other. Time: a.size()
// * b.size().
std::size_t EditDistance(std::string_view a, std::string_view b);

// The candidate nearest to `word`; empty where none is within a third of its length (at least 2),
// for words over 80 characters, and for a candidate that is no longer than its distance.
std::string_view Nearest(std::string_view word, std::span<const std::string_view> candidates);

// `did you mean "x"?` where there is a near candidate, then `one of: a, b, c` where there are more.
std::string Suggest(std::string_view word, std::span<const std::string_view> candidates);

// Code points of UTF-8.

struct CodePoint {
  static constexpr char32_t kNone = 0xffffffff;
  char32_t code = kNone;
  std::size_t bytes = 1;
};

// The code point with which a text begins, which is not empty. What is no UTF-8 (cut off, longer
// than needed, a surrogate, beyond U+10FFFF) is one byte of none.
CodePoint FirstCodePoint(std::string_view text);

// Returns the place of the first byte that is not valid UTF-8, or the size of the text.
std::size_t Utf8Bytes(std::string_view text);

// Characters that XML takes for its own are written as entities, control characters as blanks: fit
// for elements and for quoted attributes.
std::string EscapeXml(std::string_view text);

}  // namespace rockyard::core
