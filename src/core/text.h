// Texts that people wrote: did you mean ...?, UTF-8, numbers, XML. Messages of readers and
// commands, result files, drawings and pages use them. No record depends on them; Utf8Bytes also
// decides which files of text are refused, and FiniteNumber what cameras, poses and rovers in text
// say.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rockyard::core {

// Returns a key of JSON as paths in messages name it: `""` for the empty one, which nobody could
// see.
std::string_view ShownKey(std::string_view key);

// Returns the Damerau-Levenshtein distance with adjacent transpositions (optimal string alignment):
// insertions, deletions, replacements and swaps of neighbours that turn one text into the other.
// Time: a.size() * b.size().
std::size_t EditDistance(std::string_view a, std::string_view b);

// Returns the candidate nearest to `word`; empty for words over 80 characters, and where none is
// within a third of its length (at least 2). A candidate whose distance is its own length or more
// does not count.
std::string_view Nearest(std::string_view word, std::span<const std::string_view> candidates);

// Returns `did you mean "x"?` where there is a near candidate, then `one of: a, b, c` where there
// are more.
std::string Suggest(std::string_view word, std::span<const std::string_view> candidates);

// A code point of UTF-8 and its length; kNone with one byte for what is no UTF-8.
struct CodePoint {
  static constexpr char32_t kNone = 0xffffffff;
  char32_t code = kNone;
  std::size_t bytes = 1;
};

// Returns the code point with which `text` begins, which must not be empty. No UTF-8 is what is cut
// off, longer than needed, a surrogate, or beyond U+10FFFF.
CodePoint FirstCodePoint(std::string_view text);

// Returns the place of the first byte that is not valid UTF-8, or the size of the text.
std::size_t Utf8Bytes(std::string_view text);

// Returns a whole word as a finite number, by its decimal digits in any locale; a plus before it is
// allowed. Nothing for what is none: blanks, units, hexadecimal digits, infinity, NaN, or a number
// beyond those of double.
std::optional<double> FiniteNumber(std::string_view word);

// Returns `text` with entities for the characters that XML takes for its own and blanks for control
// characters: fit for elements and for quoted attributes.
std::string EscapeXml(std::string_view text);

}  // namespace rockyard::core
