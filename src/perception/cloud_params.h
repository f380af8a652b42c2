// Parameters of what a controller for light stripes makes of range points.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::perception {

// The frame in which heights count.
enum class ElevationFrame {
  kRover,  // R, as the light stripe sensor has it: a rover that tilts sees the ground tilted
  kLevel,  // R turned level by the attitude estimate
};

struct CloudElevationParams {
  std::int64_t rows = 4;
  std::int64_t stripes = 5;
  double near_m = 0.425;
  double far_m = 1.425;
  double half_width_m = 0.6;
  double quantile = 1.0;
  std::int64_t min_points = 3;
  ElevationFrame frame = ElevationFrame::kLevel;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception

template <>
struct rockyard::core::EnumNames<rockyard::perception::ElevationFrame> {
  static constexpr std::array<std::string_view, 2> kNames{"rover", "level"};
};
