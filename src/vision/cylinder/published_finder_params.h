// Parameters of the published way to find the coloured cylinder (Matthies 1995, appendix A).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "vision/cylinder/colour_class_params.h"

namespace rockyard::vision {

// What is seen of a quadrant, the k of equation 14.
enum class QuadrantMeasure {
  kPixels,  // their number
  kWidth,   // the columns of the bounding box
};

struct PublishedFinderParams {
  ColourClassParams classes;
  std::int64_t longest_gap_px = 4;
  double sky_share = 0.0;
  QuadrantMeasure measure = QuadrantMeasure::kPixels;
  std::int64_t least_whole_px = 20;
  std::int64_t least_quadrant_px = 4;
  double box_difference_px = 2.0;
  double box_difference_share = 0.2;
  double largest_turn_between_eyes_rad = math::DegToRad(45.0);
  double pixel_error_px = 1.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::QuadrantMeasure> {
  static constexpr std::array<std::string_view, 2> kNames{"pixels", "width"};
};
