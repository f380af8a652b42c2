// Known answers computed with SciPy, in tests/data/statistics_oracles.json.
#pragma once

#include "core/json_file.h"
#include "core/json_value.h"

namespace rockyard::statistics {

inline const core::JsonValue& Oracles() {
  static const core::JsonValue oracles =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/statistics_oracles.json");
  return oracles;
}

inline const core::JsonValue& At(const core::JsonValue& value, std::string_view key) {
  const core::JsonValue* found = value.Find(key);
  if (found == nullptr) throw std::out_of_range(std::string(key));
  return *found;
}

inline std::vector<double> Numbers(const core::JsonValue& list) {
  std::vector<double> numbers;
  for (const core::JsonValue& x : list.list()) numbers.push_back(x.number());
  return numbers;
}

inline std::vector<double> OracleSample(std::string_view name) {
  return Numbers(At(At(At(Oracles(), "ks"), "samples"), name));
}

}  // namespace rockyard::statistics
