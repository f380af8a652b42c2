// Whether the wheels slip more than a rover should stand: what they rolled against what was seen.
#pragma once

#include <optional>

#include "messages/aids.h"
#include "messages/estimates.h"
#include "perception/slip_check_params.h"

namespace rockyard::perception {

// Slip over a stretch of way.
struct MeasuredSlip {
  double slip = 0.0;  // 1 - seen over rolled way, along the way that wheels and gyro lay off
  double sd = 0.0;    // its standard deviation
  bool exceeded = false;
};

// `rolled_F`: the way of wheels and gyro in the plane, told as messages::RelativeMotion tells the
// way that was seen (x along the heading at first). With its length r, its direction u, the way
// seen m and its covariance C,
//
//   slip = 1 - m . u / r      sd = sqrt(u' C u) / r
//
// and the limit is exceeded where slip - sigma sd > limit. Nothing where r is below min_way_m: a
// turn in place has no slip of that kind, and a short way is noise. The wheels' own noise is part
// of what is measured. Negative where a rover slides on.
std::optional<MeasuredSlip> SlipOf(const Eigen::Vector2d& rolled_F,
                                   const messages::RelativeMotion& seen,
                                   const SlipCheckParams& params);

// The way in the plane from one pose of the odometry frame to another, x along the first's heading.
Eigen::Vector2d RolledWay(const messages::PoseEstimate& from, const messages::PoseEstimate& to);

}  // namespace rockyard::perception
