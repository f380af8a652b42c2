// Which points moved as one rigid body, and how: VisualOdometer selects and estimates by it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/random.h"
#include "math/pose.h"
#include "vision/cameras/rectification.h"
#include "vision/odometry/estimate_motion.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

// Returns X_FS with the least sum of w |p_F - X_FS p_S|^2 (Horn 1987; by singular values: Arun,
// Huang and Blostein 1987, with Umeyama's 1991 sign, so that it is never a reflection). There are
// as many points_S and weights w > 0 as points_F, or no weights, which are then 1. Returns nothing
// for fewer than three points, for points on one line or in one place (a spread across the longest
// direction of less than 1e-6 of that along it), and where a number is not finite.
std::optional<math::Transform> RigidMotion(std::span<const math::Vector3> points_F,
                                           std::span<const math::Vector3> points_S,
                                           std::span<const double> weights = {});

struct ConsistentSet {
  std::vector<std::size_t> members;                    // indices of points, ascending
  math::Transform X_FS = math::Transform::Identity();  // in closed form (RigidMotion)
  std::int64_t draws = 0;                              // of RANSAC
};

// Returns the largest set that was found, however small; nothing where no set of three points or
// more defines a motion. Records depend on ties: the earlier draw or the smaller index stays.
//
// RANSAC (Fischler and Bolles 1981) draws motions of three points each (RigidMotion). A point is
// with a motion where both eyes see it, at the second moment, within inlier_px of where the motion
// puts its place of the first. A set larger than all before is replaced by the set that is with the
// motion of all its members, as long as that is larger (local optimization: Chum, Matas and Kittler
// 2003), as three points with errors lose others that moved alike; each point weighs 1 / trace of
// both covariances. Draws end once the chance that none of them was of three members of a set as
// large as the largest so far is at most miss_probability (DrawsNeeded), or after max_draws.
//
// Rigidity (Matthies 1989, Hirschmueller 2002): two points are with each other where the distance
// between them is the same at both moments, within rigidity_sigma standard deviations by the
// covariances of all four places. Points join the set in the order of how many others they are
// with, the most first, if they are with every member. Cost: 50 ns a pair of points.
std::optional<ConsistentSet> FindConsistentSet(const PointsSeenTwice& points,
                                               const RectifiedPair& cameras,
                                               const SelectionParams& params,
                                               core::RandomStream& stream);

// Returns the indices of the points that are with a motion as in RANSAC, ascending.
std::vector<std::size_t> PointsWith(const PointsSeenTwice& points, const RectifiedPair& cameras,
                                    const math::Transform& X_FS, double inlier_px);

// Returns how many draws of three of n `points` it takes until the chance that none was of three of
// the k `members` is at most `miss`: log(miss) / log(1 - s), with the share
// s = k (k - 1) (k - 2) / (n (n - 1) (n - 2)) of all triples, which is well below (k / n)^3 for few
// points. At least 1 and at most `most`; `most` for fewer than three members. 0 < miss < 1,
// members <= points.
std::int64_t DrawsNeeded(std::size_t members, std::size_t points, double miss, std::int64_t most);

struct SetMotion {
  EstimatedMotion estimated;         // of the members; iterations of all rounds
  std::vector<std::size_t> members;  // indices of points, ascending
};

// Estimates the motion of the set (EstimateMotion), takes the points that are with this motion
// (PointsWith) as the new set, and repeats until the set stays, five times at most. Sets from
// motions of three points or from poorly known distances leave out many points that moved alike: on
// real tracks the motion of a first set is wrong by up to four times as much. `set` has three
// points or more.
SetMotion MotionOfSet(const PointsSeenTwice& points, const RectifiedPair& cameras,
                      const ConsistentSet& set, const SelectionParams& selection,
                      const EstimationParams& estimation);

}  // namespace rockyard::vision
