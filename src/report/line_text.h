// Text that must stay in one line of a terminal, or in a column of a table.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rockyard::report {

// Columns of a terminal that lines of text keep to.
inline constexpr std::size_t kTextWidth = 100;

// Names and other text that somebody may have made to deceive whoever reads a terminal: line breaks
// as spaces; as '?' what a terminal or an editor obeys or hides instead of showing it (control
// characters, with which escape sequences begin, those that change the direction of a line, those
// without width) and every byte that is no UTF-8.
std::string Printable(std::string_view text);

// The same for text of several lines that this program has laid out: keeps its line breaks, and the
// colours of summary_text.h.
std::string PrintableLines(std::string_view text);

// The same for JSON, which says the same afterwards: such characters, which can stand in its texts
// alone, as JSON's escapes with four hexadecimal digits.
std::string PrintableJson(std::string_view json);

// Columns of a terminal, one for each code point of UTF-8. Limit: marks that combine and letters of
// double width are counted as one, too.
std::size_t Columns(std::string_view text);

// At most that many columns, at least 3; what is longer ends with "...", never inside a code point.
std::string Cut(std::string_view text, std::size_t columns);

// A number with four significant digits; "-" where it is not finite.
std::string FourDigits(double value);

// Text of one or more lines, each broken between words where it has more than 100 bytes; what is
// broken off is indented by four more than its line.
std::string Wrapped(std::string_view text);

}  // namespace rockyard::report
