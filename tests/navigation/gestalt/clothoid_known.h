// Known answers for clothoids, tests/data/clothoids.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/json_file.h"
#include "core/json_value.h"

namespace rockyard::navigation {

inline double Number(const core::JsonValue& known, std::string_view key) {
  const core::JsonValue* found = known.Find(key);
  if (found == nullptr) throw std::out_of_range(std::string(key));
  return found->number();
}

// One of the lists "fresnel", "clothoid" and "two_segment".
inline const core::JsonValue::List& KnownAnswers(std::string_view list) {
  static const core::JsonValue document =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/clothoids/known_answers.json");
  return document.Find(list)->list();
}

}  // namespace rockyard::navigation
