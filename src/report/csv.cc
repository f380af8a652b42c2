#include "report/csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <system_error>

namespace rockyard::report {
namespace {

bool IsNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const std::from_chars_result result =
      std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ptr == text.data() + text.size() && result.ec == std::errc();
}

bool NeedsApostrophe(std::string_view text) {
  if (text.starts_with('\'')) return true;
  const bool begins = std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  return begins && text.size() > 1 && !IsNumber(text);
}

}  // namespace

std::string CsvNumber(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

std::string CsvField(std::string_view text) {
  if (text.empty()) return {};
  const std::string_view before = NeedsApostrophe(text) ? "'" : "";
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) {
    return std::string(before) + std::string(text);
  }
  std::string quoted = '"' + std::string(before);
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void CsvRow::AddField(std::string_view field) {
  if (!empty_) text_ += ',';
  empty_ = false;
  text_ += field;
}

}  // namespace rockyard::report
