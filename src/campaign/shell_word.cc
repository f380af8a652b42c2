#include "campaign/shell_word.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "report/line_text.h"

namespace rockyard::campaign {
namespace {

std::string InNumbers(std::string_view word) {
  std::string quoted = "$'";
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x20 && byte < 0x7f && c != '\'' && c != '\\';
    quoted += plain ? std::string(1, c) : fmt::format("\\{:03o}", byte);
  }
  return quoted + '\'';
}

}  // namespace

std::string ShellWord(std::string_view word) {
  constexpr std::string_view kSafe = "-_./=:,+@%";
  const bool safe = !word.empty() && std::all_of(word.begin(), word.end(), [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x80 && (std::isalnum(byte) != 0 || kSafe.find(c) != std::string_view::npos);
  });
  if (safe) return std::string(word);
  if (report::Printable(word) != word) return InNumbers(word);
  std::string quoted(1, '\'');
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + '\'';
}

std::string ShellPath(std::string_view path) {
  return ShellWord((path.starts_with('-') ? "./" : "") + std::string(path));
}

}  // namespace rockyard::campaign
