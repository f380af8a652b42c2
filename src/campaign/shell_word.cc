#include "campaign/shell_word.h"

#include <algorithm>
#include <cctype>

namespace rockyard::campaign {

std::string ShellWord(std::string_view word) {
  constexpr std::string_view kSafe = "-_./=:,+@%";
  const bool safe = !word.empty() && std::all_of(word.begin(), word.end(), [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x80 && (std::isalnum(byte) != 0 || kSafe.find(c) != std::string_view::npos);
  });
  if (safe) return std::string(word);
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

}  // namespace rockyard::campaign
