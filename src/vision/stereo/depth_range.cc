#include "vision/stereo/depth_range.h"

#include <cmath>

#include "core/check.h"
#include "core/error.h"

namespace rockyard::vision {
namespace {

constexpr double kMostDisparities = 512.0;
constexpr double kLargest_px = 480.0;

}  // namespace

CorrelatorParams SearchDepths(const StereoGeometry& pair, double nearest_m, double farthest_m,
                              CorrelatorParams correlator) {
  EXPECT(pair.focal_px > 0.0 && pair.baseline_m > 0.0);
  EXPECT(0.0 < nearest_m && nearest_m <= farthest_m);
  const double strength = pair.focal_px * pair.baseline_m;
  const double smallest = std::floor(strength / farthest_m + pair.offset_px) - 1.0;
  const double largest = std::ceil(strength / nearest_m + pair.offset_px) + 1.0;
  const double count = largest - smallest + 1.0;
  if (!(count <= kMostDisparities && std::abs(smallest) <= kLargest_px)) {
    throw core::UserError("depths",
                          "ask for disparities from " + std::to_string(smallest) + " to " +
                              std::to_string(largest) + " px, more than is searched",
                          "begin farther away, or use a higher level of the pyramid");
  }
  correlator.min_disparity_px = static_cast<std::int64_t>(smallest);
  correlator.disparities = static_cast<std::int64_t>(count);
  return correlator;
}

}  // namespace rockyard::vision
