#include "report/line_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace rockyard::report {
namespace {

constexpr std::size_t kTextWidth = 100;

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
  return code >= 0x20 && std::none_of(kHidden.begin(), kHidden.end(), [code](const Range& range) {
           return code >= range.first && code <= range.last;
         });
}

// The code point with which a text begins, and its bytes. What is no UTF-8 (cut off, longer than
// needed, a surrogate, beyond U+10FFFF) is one byte of no code point.
struct Letter {
  static constexpr char32_t kNone = 0;
  char32_t code = kNone;
  std::size_t bytes = 1;
};

Letter FirstLetter(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < bytes) return {};
  char32_t code = byte(0) & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if (BeginsCodePoint(text[i])) return {};
    code = code << 6 | (byte(i) & 0x3fU);
  }
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[bytes] || surrogate || code > 0x10ffff) return {};
  return {code, bytes};
}

// `replace` is given what stands where something is not shown, and says what stands there instead.
template <typename Replace>
std::string Shown(std::string_view text, const Replace& replace) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const Letter letter = FirstLetter(text);
    if (IsShown(letter.code)) {
      safe += text.substr(0, letter.bytes);
    } else {
      safe += replace(letter, text);
    }
    text.remove_prefix(letter.bytes);
  }
  return safe;
}

// The escape character alone: what follows it is shown as it is.
bool BeginsColour(std::string_view text) {
  constexpr std::array<std::string_view, 5> kColours = {"\x1b[0m", "\x1b[1m", "\x1b[31m",
                                                        "\x1b[32m", "\x1b[33m"};
  return std::any_of(kColours.begin(), kColours.end(),
                     [text](std::string_view colour) { return text.starts_with(colour); });
}

// As UTF-16, of which JSON's escapes are made.
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
  return Shown(
      text, [](const Letter& letter, std::string_view) { return letter.code == '\n' ? ' ' : '?'; });
}

std::string PrintableLines(std::string_view text) {
  return Shown(text, [](const Letter& letter, std::string_view rest) {
    return letter.code == '\n' || BeginsColour(rest) ? rest.front() : '?';
  });
}

std::string PrintableJson(std::string_view json) {
  return Shown(json, [](const Letter& letter, std::string_view rest) {
    if (letter.code == '\n') return std::string(1, '\n');
    return letter.code == Letter::kNone && rest.front() != '\0' ? std::string(1, '?')
                                                                : JsonEscape(letter.code);
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
