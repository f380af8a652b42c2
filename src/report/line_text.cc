#include "report/line_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/text.h"

namespace rockyard::report {
namespace {

using core::CodePoint;

// Bytes 10xxxxxx go on with the code point that was begun.
bool BeginsCodePoint(char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }

struct Range {
  char32_t first;
  char32_t last;
};

// What a terminal does not show as a character, beside those below U+0020.
constexpr std::array<Range, 8> kHidden = {{{0x7f, 0x9f},          // control characters
                                           {0x61c, 0x61c},        // direction, as below
                                           {0x200b, 0x200f},      // no width; direction
                                           {0x2028, 0x202e},      // ends of lines; direction
                                           {0x2060, 0x206f},      // no width; direction
                                           {0xfeff, 0xfeff},      // no width
                                           {0xfff9, 0xfffb},      // annotations
                                           {0xe0000, 0xe007f}}};  // tags

bool IsShown(char32_t code) {
  return code != CodePoint::kNone && code >= 0x20 &&
         std::none_of(kHidden.begin(), kHidden.end(), [code](const Range& range) {
           return code >= range.first && code <= range.last;
         });
}

// `replace` is given what stands where something is not shown, and says what stands there instead.
template <typename Replace>
std::string Shown(std::string_view text, const Replace& replace) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const CodePoint letter = core::FirstCodePoint(text);
    if (IsShown(letter.code)) {
      safe += text.substr(0, letter.bytes);
    } else {
      safe += replace(letter, text);
    }
    text.remove_prefix(letter.bytes);
  }
  return safe;
}

// The escape character alone: what follows it is shown as it is. These are all that reports and
// commands write themselves; another one would come out as '?'.
bool BeginsColour(std::string_view text) {
  constexpr std::array<std::string_view, 5> kColours = {"\x1b[0m", "\x1b[1m", "\x1b[31m",
                                                        "\x1b[32m", "\x1b[33m"};
  return std::any_of(kColours.begin(), kColours.end(),
                     [text](std::string_view colour) { return text.starts_with(colour); });
}

// Returns the escape of a code point as UTF-16, of which JSON's escapes are made.
std::string JsonEscape(char32_t code) {
  const auto unit = [](char32_t value) {
    return fmt::format("\\u{:04x}", static_cast<std::uint32_t>(value));
  };
  if (code < 0x10000) return unit(code);
  return unit(0xd800 + ((code - 0x10000) >> 10)) + unit(0xdc00 + (code & 0x3ff));
}

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
  return Shown(text, [](const CodePoint& letter, std::string_view) {
    return letter.code == '\n' ? ' ' : '?';
  });
}

std::string PrintableLines(std::string_view text) {
  return Shown(text, [](const CodePoint& letter, std::string_view rest) {
    return letter.code == '\n' || BeginsColour(rest) ? rest.front() : '?';
  });
}

std::string PrintableJson(std::string_view json) {
  return Shown(json, [](const CodePoint& letter, std::string_view) {
    if (letter.code == '\n') return std::string(1, '\n');
    return letter.code == CodePoint::kNone ? std::string(1, '?') : JsonEscape(letter.code);
  });
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
