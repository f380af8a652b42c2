// Text that must stay in one line of a terminal, or in a column of a table. Commands and reports
// send names, messages and whole pages through it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rockyard::report {

// Columns of a terminal that lines of text keep to.
inline constexpr std::size_t kTextWidth = 100;

// Returns a name or other text, which somebody may have made to deceive whoever reads a terminal,
// made harmless. Line breaks become spaces; what a terminal or an editor obeys or hides instead of
// showing it becomes '?' (control characters, with which escape sequences begin, those that change
// the direction of a line, those without width), and so does every byte that is no UTF-8.
std::string Printable(std::string_view text);

// Returns text of several lines that this program has laid out, made harmless as by Printable, but
// with its line breaks and the colours of summary_text.h.
std::string PrintableLines(std::string_view text);

// Returns JSON that says the same, with the characters that Printable replaces, which can stand in
// its texts alone, as JSON's escapes with four hexadecimal digits.
std::string PrintableJson(std::string_view json);

// Returns the columns of a terminal that a text takes, one for each code point of UTF-8. Limit:
// marks that combine and letters of double width are counted as one, too.
std::size_t Columns(std::string_view text);

// Returns a text of at most that many columns, at least 3; what is longer ends with "...", never
// inside a code point.
std::string Cut(std::string_view text, std::size_t columns);

// A number with four significant digits; "-" where it is not finite.
std::string FourDigits(double value);

// Returns text of one or more lines, each broken between words where it has more than 100 bytes
// (kTextWidth); what is broken off is indented by four more than its line.
std::string Wrapped(std::string_view text);

}  // namespace rockyard::report
