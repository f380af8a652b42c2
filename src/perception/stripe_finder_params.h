// Parameters of the program that finds light stripes in images (stripe_finder.h; Matthies 1995,
// section 6). Only the image fidelity of the sensor reads them; the errors of the geometric
// fidelity may be fitted to what this program finds (fit_stripe_errors.py). Defaults decide
// records.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::perception {

// Which of several peaks in the searched part of a scanline is taken for the stripe.
enum class PeakChoice {
  kStrongest,       // the brightest
  kNearestToDatum,  // the one nearest to where flat ground would show it
};

// How finely a peak is located.
enum class PeakColumn {
  kWholePixel,  // centre of brightness of the columns above the threshold, rounded
  kCentroid,    // the same without rounding
};

struct StripeFinderParams {
  std::int64_t averaging_px = 5;
  double threshold_counts = 1.0;
  double noise_multiple = 5.0;
  PeakChoice peak = PeakChoice::kStrongest;
  PeakColumn column = PeakColumn::kWholePixel;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception

template <>
struct rockyard::core::EnumNames<rockyard::perception::PeakChoice> {
  static constexpr std::array<std::string_view, 2> kNames{"strongest", "nearest_to_datum"};
};

template <>
struct rockyard::core::EnumNames<rockyard::perception::PeakColumn> {
  static constexpr std::array<std::string_view, 2> kNames{"whole_pixel", "centroid"};
};
