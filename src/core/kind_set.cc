#include "core/kind_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace rockyard::core {
namespace {

bool IsKey(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

// Every object of a scenario may have this key (kExtends of core/json_file.cc).
constexpr std::string_view kInEveryGroup = "extends";

}  // namespace

void RequireNewKind(const KindSetWords& words, std::span<const std::string_view> names,
                    std::string_view name) {
  const std::string path = fmt::format("{}.{}", words.group, name);
  if (!IsKey(name)) {
    throw UserError(path, fmt::format("cannot be the name of {}", words.one),
                    "use lower-case letters, digits and underscores");
  }
  const bool taken = name == words.key || name == kInEveryGroup ||
                     std::ranges::count(words.others, name) > 0 ||
                     std::ranges::count(names, name) > 0;
  if (taken) {
    throw UserError(path, "is taken", "give it another name");
  }
}

int FindKind(const KindSetWords& words, std::span<const std::string_view> names,
             std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw UserError(fmt::format("{}.{}", words.group, words.key),
                    fmt::format("is {}, which is not there", name), Suggest(name, names));
  }
  return static_cast<int>(found - names.begin());
}

}  // namespace rockyard::core
