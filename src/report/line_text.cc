#include "report/line_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rockyard::report {
namespace {

constexpr std::size_t kTextWidth = 100;

// Bytes 10xxxxxx go on with the code point that was begun.
bool BeginsCodePoint(char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }

std::string WrappedLine(std::string line) {
  std::size_t words = line.find_first_not_of(' ');  // where they begin
  if (words == std::string::npos) return line;
  const std::string indent(words + 4, ' ');
  std::string text;
  while (line.size() > kTextWidth) {
    std::size_t space = line.rfind(' ', kTextWidth);
    if (space < words) space = line.find(' ', kTextWidth);  // a word of that many columns
    if (space == std::string::npos) break;
    text += line.substr(0, space) + "\n";
    line.replace(0, space + 1, indent);
    words = indent.size();
  }
  return text + line;
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string safe(text);
  for (char& c : safe) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = c == '\n' ? ' ' : '?';
  }
  return safe;
}

std::size_t Columns(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), BeginsCodePoint));
}

std::string Cut(std::string_view text, std::size_t columns) {
  if (Columns(text) <= columns) return std::string(text);
  std::size_t kept = 0;
  std::size_t end = 0;
  for (; end < text.size(); ++end) {
    if (BeginsCodePoint(text[end]) && ++kept > columns - 3) break;
  }
  return std::string(text.substr(0, end)) + "...";
}

std::string FourDigits(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
}

std::string Wrapped(std::string_view text) {
  std::string wrapped;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    wrapped += WrappedLine(std::string(text.substr(begin, end - begin)));
    if (end < text.size()) wrapped += '\n';
    begin = end + 1;
  }
  return wrapped;
}

}  // namespace rockyard::report
