// Motions of exact points, by a plain reference, with robust weights, and reasons for none.
#include "vision/odometry/estimate_motion.h"

#include <gtest/gtest.h>

#include "vision/odometry/plain_motion.h"
#include "vision/odometry/stereo_measurement.h"
#include "vision/odometry/synthetic_points.h"

namespace rockyard::vision {
namespace {

using math::Transform;

core::RandomStream Stream(std::uint32_t substream) {
  return {{252, 0}, core::Purpose::kTest, substream};
}

// Off by 10 cm and 3 deg.
Transform RoughStart() {
  return TestMotion() * math::MakePose({0.06, -0.05, 0.06}, 0.03, -0.03, 0.03);
}

EstimationParams Unweighted() { return {.weights = RobustWeights::kNone, .tolerance = 1e-6}; }

TEST(PairProjectionTest, IsTheInverseOfTriangulationAndItsDerivativeThatOfDifferences) {
  const PairProjection project(kOdometryPair);
  for (const auto& [pixel, disparity_px] :
       {std::pair{Pixel(10, 20), 60.0}, {Pixel(400, 300), 8.0}, {Pixel(255, 10), 0.7}}) {
    const auto point = Triangulate(kOdometryPair.left, kOdometryPair.right, pixel, disparity_px);
    Eigen::Matrix3d by_point;
    const auto seen = project(point->p_A, &by_point);
    ASSERT_TRUE(seen);
    EXPECT_LT((*seen - PairPixel(pixel.x(), pixel.y(), disparity_px)).norm(), 1e-9);
    EXPECT_LT((by_point * point->by_measurement - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    const double depth_m = kOdometryPair.focal_px * kOdometryPair.baseline_m / disparity_px;
    EXPECT_NEAR(project.Depth(point->p_A), depth_m, 1e-9 * depth_m);
    for (int axis = 0; axis < 3; ++axis) {
      const double h = 1e-6 * depth_m;
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d slope =
          (*project(point->p_A + step) - *project(point->p_A - step)) / (2.0 * h);
      EXPECT_LT((by_point.col(axis) - slope).norm(), 1e-5 * (1.0 + slope.norm()));
    }
  }
  EXPECT_FALSE(project(kOdometryPair.left.C - kOdometryPair.left.A));
  EXPECT_FALSE(project(kOdometryPair.left.C));
}

TEST(EstimateMotionTest, ExactPointsGiveTheirMotion) {
  core::RandomStream stream = Stream(1);
  const PointsSeenTwice points =
      SeeTwice(kOdometryPair, TestMotion(), {.with_errors = false}, stream);
  for (const RobustWeights weights :
       {RobustWeights::kNone, RobustWeights::kHuber, RobustWeights::kCauchy}) {
    EstimationParams params = Unweighted();
    params.weights = weights;
    const EstimatedMotion found = EstimateMotion(points, kOdometryPair, params, RoughStart());
    ASSERT_TRUE(found.motion) << static_cast<int>(weights);
    EXPECT_TRUE(found.converged);
    EXPECT_FALSE(found.reason);
    EXPECT_LT(ErrorOf(found.motion->X_FS, TestMotion()).norm(), 1e-7);
    EXPECT_LT(found.rms_px, 1e-5);
    EXPECT_LT(found.fit, 1e-8);
  }
}

// Steps of MER's size (Howard 2012 section 1): 75 cm, and 18 deg in place.
TEST(EstimateMotionTest, LargeStepsAreFoundFromNoMotionAtAll) {
  core::RandomStream stream = Stream(2);
  const Eigen::Matrix3d R_AC = math::MakePose(math::Vector3::Zero(), 0.2, -0.5, 0.1).linear();
  Transform ahead = Transform::Identity();
  ahead.translation() = R_AC * math::Vector3(0.0, 0.0, 0.75);
  Transform turned = Transform::Identity();
  turned.linear() = Eigen::AngleAxisd(math::DegToRad(18.0), R_AC.col(1)).toRotationMatrix();
  for (const Transform& X_FS : {ahead, turned}) {
    const PointsSeenTwice points = SeeTwice(kOdometryPair, X_FS, PointField(), stream);
    const EstimatedMotion found =
        EstimateMotion(points, kOdometryPair, EstimationParams(), Transform::Identity());
    ASSERT_TRUE(found.motion);
    EXPECT_LT(ErrorOf(found.motion->X_FS, X_FS).head<3>().norm(), 0.02);
    EXPECT_LT(ErrorOf(found.motion->X_FS, X_FS).tail<3>().norm(), 0.004);
  }
}

// With covariances that are no diagonal, as a subpixel match has them.
TEST(EstimateMotionTest, IsThePlainReferenceInMotionAndCovariance) {
  PointField field{.points = 12, .nearest_m = 2.0, .farthest_m = 30.0};
  field.covariance_px2 << 0.04, 0.01, 0.02, 0.01, 0.03, 0.0, 0.02, 0.0, 0.06;
  for (std::uint32_t run = 0; run < 10; ++run) {
    core::RandomStream stream = Stream(10 + run);
    const PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), field, stream);
    EstimationParams params = Unweighted();
    params.max_position_sd_m = 10.0;
    params.max_rotation_sd_rad = 1.0;
    const EstimatedMotion found = EstimateMotion(points, kOdometryPair, params, RoughStart());
    const Motion plain = PlainBundle(points, kOdometryPair, TestMotion());
    ASSERT_TRUE(found.motion) << run;
    const Eigen::Vector<double, 6> sd = plain.covariance.diagonal().cwiseSqrt();
    EXPECT_LT((ErrorOf(found.motion->X_FS, plain.X_FS).array() / sd.array()).abs().maxCoeff(), 1e-3)
        << run;
    const MotionCovariance expected = std::max(1.0, found.fit) * plain.covariance;
    EXPECT_LT((found.motion->covariance - expected).norm(), 1e-3 * expected.norm()) << run;
    EXPECT_EQ(found.motion->covariance, found.motion->covariance.transpose());
  }
}

// Five points of a hundred are off by 5 to 9 px: by squares they pull the motion well out of its
// covariance, by robust weights hardly.
TEST(EstimateMotionTest, RobustWeightsBearWhatSquaresDoNot) {
  core::RandomStream stream = Stream(30);
  PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), PointField(), stream);
  for (int i = 0; i < 5; ++i)
    points[static_cast<std::size_t>(i)].second.left += Pixel(4.0 + i, 3.0);
  EstimationParams params = Unweighted();
  params.max_fit = 1e3;
  const auto error_m = [&](RobustWeights weights) {
    params.weights = weights;
    const EstimatedMotion found = EstimateMotion(points, kOdometryPair, params, RoughStart());
    EXPECT_TRUE(found.motion);
    return ErrorOf(found.X_FS, TestMotion()).head<3>().norm();
  };
  const double by_squares_m = error_m(RobustWeights::kNone);
  const double huber_m = error_m(RobustWeights::kHuber);
  const double cauchy_m = error_m(RobustWeights::kCauchy);
  EXPECT_LT(huber_m, 0.6 * by_squares_m);
  EXPECT_LT(cauchy_m, 0.6 * huber_m);
}

TEST(EstimateMotionTest, TheFitIsChiSquaredOverItsDegreesOfFreedom) {
  core::RandomStream stream = Stream(40);
  PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), {.points = 400}, stream);
  const EstimatedMotion as_stated =
      EstimateMotion(points, kOdometryPair, Unweighted(), TestMotion());
  // 1194 degrees of freedom: 1 +- 0.041; 3.29 of these.
  EXPECT_NEAR(as_stated.fit, 1.0, 0.135);
  for (PointSeenTwice& point : points) {
    point.first.covariance_px2 /= 3.0;
    point.second.covariance_px2 /= 3.0;
  }
  const EstimatedMotion tripled = EstimateMotion(points, kOdometryPair, Unweighted(), TestMotion());
  ASSERT_TRUE(as_stated.motion && tripled.motion);
  EXPECT_NEAR(tripled.fit, 3.0 * as_stated.fit, 1e-3);
  // Where the noise is larger than stated, the covariance tells what is seen.
  EXPECT_NEAR(tripled.motion->covariance(0, 0),
              as_stated.motion->covariance(0, 0) * as_stated.fit / std::max(1.0, as_stated.fit),
              1e-3 * as_stated.motion->covariance(0, 0));
  EstimationParams strict = Unweighted();
  strict.max_fit = 2.0;
  const EstimatedMotion poor = EstimateMotion(points, kOdometryPair, strict, TestMotion());
  EXPECT_FALSE(poor.motion);
  EXPECT_EQ(poor.reason, NoMotion::kPoorFit);
}

TEST(EstimateMotionTest, PointsThatLeaveTheMotionOpenAreUncertain) {
  core::RandomStream stream = Stream(50);
  const PointsSeenTwice far = SeeTwice(
      kOdometryPair, Transform::Identity(),
      {.points = 60, .nearest_m = 300.0, .farthest_m = 900.0, .with_errors = false}, stream);
  const EstimatedMotion of_far = EstimateMotion(far, kOdometryPair, {}, Transform::Identity());
  EXPECT_FALSE(of_far.motion);
  EXPECT_EQ(of_far.reason, NoMotion::kUncertain);

  // Points on a line: the turn about it is open.
  PointsSeenTwice line;
  for (int i = 0; i <= 20; ++i) {
    const auto p_F = Triangulate(kOdometryPair.left, kOdometryPair.right,
                                 Pixel(100 + 10 * i, 150 + 5 * i), 30.0);
    auto seen = SeenExactly(kOdometryPair, p_F->p_A, Eigen::Matrix3d::Identity() * 1e-4);
    line.push_back({*seen, *seen});
  }
  const EstimatedMotion of_line = EstimateMotion(line, kOdometryPair, {}, Transform::Identity());
  EXPECT_FALSE(of_line.motion);
  EXPECT_EQ(of_line.reason, NoMotion::kUncertain);
}

// The limits are those of the worst direction: the same points, asked for a little more and a
// little less than their covariance.
TEST(EstimateMotionTest, LimitsHoldForTheWorstDirection) {
  core::RandomStream stream = Stream(60);
  const PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), PointField(), stream);
  const EstimatedMotion found = EstimateMotion(points, kOdometryPair, {}, TestMotion());
  ASSERT_TRUE(found.motion);
  const auto worst = [&](Eigen::Index from) {
    const Eigen::Matrix3d block = found.motion->covariance.block<3, 3>(from, from);
    double largest = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const Eigen::Vector3d v =
          Eigen::Vector3d(core::SampleNormal(stream, 0, 1), core::SampleNormal(stream, 0, 1),
                          core::SampleNormal(stream, 0, 1))
              .normalized();
      largest = std::max(largest, std::sqrt(v.dot(block * v)));
    }
    return largest;
  };
  const double worst_m = worst(0);
  const double worst_rad = worst(3);
  const auto is_found = [&](double limit_m, double limit_rad) {
    const EstimationParams params{.max_position_sd_m = limit_m, .max_rotation_sd_rad = limit_rad};
    return EstimateMotion(points, kOdometryPair, params, TestMotion()).motion.has_value();
  };
  EXPECT_TRUE(is_found(1.01 * worst_m, 1.01 * worst_rad));
  EXPECT_FALSE(is_found(0.99 * worst_m, 1.01 * worst_rad));
  EXPECT_FALSE(is_found(1.01 * worst_m, 0.99 * worst_rad));
}

TEST(EstimateMotionTest, WhatDoesNotEndIsNoMotion) {
  core::RandomStream stream = Stream(70);
  const PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), PointField(), stream);
  const EstimationParams params{.max_iterations = 1};
  const EstimatedMotion cut = EstimateMotion(points, kOdometryPair, params, RoughStart());
  EXPECT_FALSE(cut.motion);
  EXPECT_FALSE(cut.converged);
  EXPECT_EQ(cut.reason, NoMotion::kNotConverged);
  EXPECT_EQ(cut.iterations, 1);
  // From a start that has the points behind the cameras.
  Transform beyond = Transform::Identity();
  beyond.translation() = 50.0 * kOdometryPair.left.A;
  EXPECT_EQ(EstimateMotion(points, kOdometryPair, {}, beyond).reason, NoMotion::kNotConverged);
}

}  // namespace
}  // namespace rockyard::vision
