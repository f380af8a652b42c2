// Two other ways from points seen twice to a motion, written as their equations stand.
#pragma once

#include <Eigen/Core>

#include "vision/cameras/rectification.h"
#include "vision/odometry/estimate_motion.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

// What EstimateMotion minimizes, without robust weights: over the motion and all places at once,
// with derivatives by differences and no elimination. The covariance is the motion's block of the
// inverse of the whole matrix. For some ten points.
Motion PlainBundle(const PointsSeenTwice& points, const RectifiedPair& cameras,
                   const math::Transform& start);

// Matthies 1989: errors in space, r = R p_S + t - p_F with the covariance P_F + R P_S R', as normal
// numbers, by ten steps of Gauss and Newton's method.
Motion MotionInSpace(const PointsSeenTwice& points, const math::Transform& start);

// (e_t, e_r) of MotionCovariance, with which `estimated` becomes `truth`.
Eigen::Matrix<double, 6, 1> ErrorOf(const math::Transform& estimated, const math::Transform& truth);

}  // namespace rockyard::vision
