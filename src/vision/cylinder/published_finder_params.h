// Parameters of the published way to find the coloured cylinder (Matthies 1995, appendix A). Files
// for `rockyard cylinder` and scenarios of the experiment on sightings hold them; meaning, unit and
// origin of each stand in Visit. Records of the experiment depend on the defaults.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::vision {

// The primary that the two others are divided by.
enum class PrimaryColour { kRed, kGreen, kBlue };

// A class of colours: both ratios lie within their ranges. The ratios are green/red and blue/red
// over red, red/green and blue/green over green, red/blue and green/blue over blue, the first one
// named first.
struct ColourRatioParams {
  PrimaryColour over = PrimaryColour::kRed;
  double first_low = 0.0;
  double first_high = 0.0;
  double second_low = 0.0;
  double second_high = 0.0;

  void Visit(core::FieldVisitor& v);
};

// The classes. A.3 has ratios over blue for blue and over red for red and magenta, in ranges
// "experimentally determined" that it does not tell. The defaults are assumed about linear surface
// colours of fluorescent cardboard in white light: blue (0.12, 0.30, 0.85), pink (0.95, 0.25,
// 0.60), orange (1.00, 0.35, 0.10), away from ground of (0.45, 0.27, 0.16), the defaults of
// SurfaceColourParams (robust_finder_params.h). Do not tune them by images of an evaluation: they
// were fixed before any, so that these tell the truth.
struct ColourClassParams {
  ColourRatioParams blue{PrimaryColour::kBlue, 0.0, 0.45, 0.0, 0.70};
  ColourRatioParams magenta{PrimaryColour::kRed, 0.0, 0.47, 0.38, 1.10};
  ColourRatioParams red{PrimaryColour::kRed, 0.0, 0.47, 0.0, 0.30};
  double darkest = 20.0;

  void Visit(core::FieldVisitor& v);
};

// Returns, for ColourClassParams::red, a class about green (0.15, 0.80, 0.25), the colour that
// section 5 proposes in place of orange. It belongs to kGreenSurface (robust_finder_params.h): the
// experiment on sightings sets both.
ColourRatioParams GreenRatios();

// How much is seen of a quadrant: the k of equation 14.
enum class QuadrantMeasure {
  kPixels,  // the number of pixels
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
struct rockyard::core::EnumNames<rockyard::vision::PrimaryColour> {
  static constexpr std::array<std::string_view, 3> kNames{"red", "green", "blue"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::QuadrantMeasure> {
  static constexpr std::array<std::string_view, 2> kNames{"pixels", "width"};
};
