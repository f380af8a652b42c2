// How often a part stands in a text, for tests of drawings and pages.
#pragma once

#include <string_view>

namespace rockyard::core {

inline int CountOf(std::string_view text, std::string_view part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace rockyard::core
