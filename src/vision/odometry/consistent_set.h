// Which points moved as one rigid body.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "math/pose.h"
#include "vision/cameras/rectification.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

struct ConsistentSet {
  std::vector<std::size_t> members;                    // indices of points, ascending
  math::Transform X_FS = math::Transform::Identity();  // of these, in closed form
  std::int64_t draws = 0;                              // of RANSAC
};

// The largest set that was found, however small; nothing where there is none of three points that
// define a motion.
//
// RANSAC (Fischler and Bolles 1981): motions of three points each (rigid_motion.h). A point is with
// a motion where both eyes see it, at the second moment, within inlier_px of where the motion puts
// its place of the first. Draws end once the chance that none of them was of three members of a set
// as large as the largest so far is at most miss_probability: log(miss) / log(1 - w^3) with w its
// share of the points; or after max_draws. Then the motion of all members is found twice anew.
//
// Rigidity (Matthies 1989, Hirschmueller 2002): two points are with each other where the distance
// between them is the same at both moments, within rigidity_sigma standard deviations by the
// covariances of all four places. The set grows from the point with most such others, each next one
// with every member before. Cost: 50 ns a pair of points.
std::optional<ConsistentSet> FindConsistentSet(const PointsSeenTwice& points,
                                               const RectifiedPair& cameras,
                                               const SelectionParams& params,
                                               core::RandomStream& stream);

}  // namespace rockyard::vision
