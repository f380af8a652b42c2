// One scan of the light stripe sensor, as far as it can be shown.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/stripe_images.h"

namespace rockyard::report {

// What one point of the array became.
struct ShownPoint {
  messages::StripePixel pixel;  // as it was found
  int searched_first_px = 0;    // columns in which it was looked for
  int searched_last_px = -1;
  messages::ElevationPoint elevation;                // as it was triangulated
  math::Vector3 p_RoP_R = math::Vector3::Zero();     // of the same; undefined where not detected
  math::Vector3 expected_R = math::Vector3::Zero();  // where the point lies on level ground
};

// A closed line on the ground, (x, y) in R, m.
using GroundOutline = std::vector<std::pair<double, double>>;

struct ScanView {
  std::string title;
  messages::StripeCalibration calibration;  // as the rover believes it
  messages::StripeArray<ShownPoint> points;
  messages::HazardReport hazards;  // of this scan alone
  GroundOutline rover;
  std::vector<GroundOutline> rocks;
};

}  // namespace rockyard::report
