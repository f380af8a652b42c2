// Comma-separated values (RFC 4180, with line feeds alone).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rockyard::report {

// The shortest decimal that reads back to the same bits; empty where it is not finite.
std::string CsvNumber(double value);

// Quoted where it has commas, quotes or line breaks.
std::string CsvField(std::string_view text);

// Fields as they are, joined, with a line feed.
std::string CsvLine(std::span<const std::string> fields);

}  // namespace rockyard::report
