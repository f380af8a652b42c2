// Known answers for clothoids, tests/data/clothoids, and how near to them is near.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/json_file.h"
#include "core/json_value.h"
#include "navigation/gestalt/curvature_law.h"

namespace rockyard::navigation {

inline double Number(const core::JsonValue& known, std::string_view key) {
  const core::JsonValue* found = known.Find(key);
  if (found == nullptr) throw std::out_of_range(std::string(key));
  return found->number();
}

inline void ExpectNear(const math::Pose2& found, const math::Pose2& known, double error) {
  EXPECT_NEAR(found.x_m, known.x_m, error);
  EXPECT_NEAR(found.y_m, known.y_m, error);
  EXPECT_NEAR(found.heading_rad, known.heading_rad, error);
}

// One of the lists "fresnel", "clothoid" and "two_segment".
inline const core::JsonValue::List& KnownAnswers(std::string_view list) {
  static const core::JsonValue document =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/clothoids/known_answers.json");
  return document.Find(list)->list();
}

}  // namespace rockyard::navigation
