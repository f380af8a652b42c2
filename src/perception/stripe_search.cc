#include "perception/stripe_search.h"

#include <cmath>

#include "perception/triangulation.h"

namespace rockyard::perception {
namespace {

// Elevation grows or falls with the column all along a scanline's meeting with a light plane, so
// that the searched columns lie around the one nearest to the datum plane.
StripeSearch SearchAlong(const messages::StripeCalibration& calibration,
                         const Triangulator& triangulator, int camera, std::size_t row,
                         std::size_t stripe) {
  const int half = calibration.cameras[static_cast<std::size_t>(camera)].columns / 2;
  const auto elevation = [&](int column) {
    return triangulator.Elevation(row, stripe, static_cast<double>(column));
  };
  const auto searched = [&](int column) {
    const messages::ElevationPoint point = elevation(column);
    return point.detected && point.elevation_m >= calibration.search_low_m &&
           point.elevation_m <= calibration.search_high_m;
  };

  // Every column is tried: a lens may see the light plane behind the camera in some of them.
  int nearest = 0;
  double nearest_m = HUGE_VAL;
  for (int column = -half; column <= half; ++column) {
    const messages::ElevationPoint point = elevation(column);
    if (!point.detected || std::abs(point.elevation_m) >= nearest_m) continue;
    nearest_m = std::abs(point.elevation_m);
    nearest = column;
  }
  StripeSearch search;
  search.datum_column = nearest;
  // No column sees the light plane, or none within the searched elevations.
  if (nearest_m == HUGE_VAL || !searched(nearest)) return search;
  search.columns = {nearest, nearest};
  while (search.columns.first > -half && searched(search.columns.first - 1)) {
    --search.columns.first;
  }
  while (search.columns.last < half && searched(search.columns.last + 1)) ++search.columns.last;
  return search;
}

}  // namespace

StripeSearches::StripeSearches(const messages::StripeCalibration& calibration)
    : size_(calibration.size()) {
  for (int camera = 0; camera < static_cast<int>(calibration.cameras.size()); ++camera) {
    messages::StripeCalibration seen_by = calibration;
    // As if this camera measured all lasers.
    for (messages::StripeLaser& laser : seen_by.lasers) laser.camera = camera;
    const Triangulator triangulator(seen_by);
    for (std::size_t row = 0; row < size_.rows; ++row) {
      for (std::size_t stripe = 0; stripe < size_.stripes; ++stripe) {
        searches_.push_back(SearchAlong(seen_by, triangulator, camera, row, stripe));
      }
    }
  }
}

}  // namespace rockyard::perception
