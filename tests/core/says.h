// What texts have to say, for tests of messages, tables and drawings.
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <vector>

namespace rockyard::core {

MATCHER_P(HoldsAllOf, parts, "holds " + testing::PrintToString(parts)) {
  for (const std::string& part : parts) {
    if (std::string_view(arg).find(part) != std::string_view::npos) continue;
    *result_listener << "which lacks " << testing::PrintToString(part);
    return false;
  }
  return true;
}

// Matches a text that holds all of these, and tells the first that it lacks.
template <typename... Parts>
auto Says(const Parts&... parts) {
  return HoldsAllOf(std::vector<std::string>{parts...});
}

}  // namespace rockyard::core
