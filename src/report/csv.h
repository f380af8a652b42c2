// Comma-separated values (RFC 4180, with line feeds alone).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rockyard::report {

// The shortest decimal that reads back to the same bits; empty where it is not finite.
std::string CsvNumber(double value);

// A text, quoted where it has commas, quotes or line breaks. One that a spreadsheet would take for
// a formula, as it begins with = + - @ or a blank of its line (tab, carriage return) and is neither
// a number nor that sign alone, gets an apostrophe in front, and so does one that begins with an
// apostrophe: to read the text back, take one leading apostrophe away. Numbers stay as they are.
std::string CsvField(std::string_view text);

// Fields as they are, joined, with a line feed.
std::string CsvLine(std::span<const std::string> fields);

}  // namespace rockyard::report
