// Parameters read from a JSON text, and what is wrong with it, for tests of parameter structs.
#pragma once

#include <map>

#include "core/archive.h"
#include "core/json_text.h"
#include "core/refusals.h"

namespace rockyard::core {

// Throws UserError.
template <typename Params>
Params ReadText(const std::string& json) {
  Params params;
  ReadParams(ParseJson(json, "test"), params);
  return params;
}

// The problems of a text in one; empty where it is accepted.
template <typename Params>
std::string ProblemsOf(const std::string& json) {
  return RefusalOf([&] { ReadText<Params>(json); });
}

// These defaults, by path as JSON, are published.
template <typename Params>
void ExpectPublished(const std::map<std::string, std::string>& defaults) {
  const FieldTable table = ListParams<Params>();
  std::size_t found = 0;
  for (const ParameterInfo& parameter : table.parameters()) {
    const auto published = defaults.find(parameter.path);
    if (published == defaults.end()) continue;
    ++found;
    EXPECT_EQ(DumpJson(parameter.value), published->second + "\n") << parameter.path;
    EXPECT_EQ(parameter.origin, Origin::kPublished) << parameter.path;
  }
  EXPECT_EQ(found, defaults.size()) << "a path is none";
}

}  // namespace rockyard::core
