// Which windows show one surface only.
#pragma once

#include <span>

#include "vision/odometry/odometer_params.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

// Points whose windows fit: each of their residuals (of either pair of eyes, and `in_time`, one for
// each point or none at all) is at most PlacementParams::max_residual_ratio times the lower
// quartile of its kind, or their largest share of that is among the `min_kept` smallest. Windows
// across a rock's edge do not fit any plane, and what they show of the background biases them all
// to one side. A quartile of less than half a grey level counts as that. In the points' order.
PointsSeenTwice KeepClean(const PointsSeenTwice& points, std::span<const double> in_time,
                          const PlacementParams& params);

}  // namespace rockyard::vision
