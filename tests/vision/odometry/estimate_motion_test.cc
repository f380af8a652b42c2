#include "vision/odometry/estimate_motion.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "vision/cameras/rectification.h"
#include "vision/odometry/consistent_set.h"
#include "vision/odometry/plain_motion.h"
#include "vision/odometry/stereo_measurement.h"
#include "vision/odometry/synthetic_points.h"

namespace rockyard::vision {
namespace {

using math::Transform;

// Motions of exact points, by a plain reference, with robust weights, and reasons for none.

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

// The estimator alone on the tracks of a real drive, beside what another program made of them.

const std::string kFolder = ROCKYARD_SOURCE_DIR "/tests/data/odometry/";

// The camera of tests/data/odometry/SOURCE.txt; the outer frame is the left camera's.
RectifiedPair DrivePair() {
  constexpr double kFocal_px = 721.5377;
  const Cahv left{{0, 0, 0}, {0, 0, 1}, {kFocal_px, 0, 609.5593}, {0, kFocal_px, 172.854}};
  Cahv right = left;
  right.C = {0.537150588, 0, 0};
  return {left, right, {1241, 376}, kFocal_px, 0.537150588};
}

using Tracks = std::map<int, StereoMeasurement>;  // by the number of the point

std::vector<Tracks> ReadTracks(const RectifiedPair& pair) {
  std::vector<Tracks> tracks;
  std::ifstream file(kFolder + "gtsam_tracks.txt");
  int number = 0, point = 0;
  double left = 0.0, right = 0.0, row = 0.0;
  while (file >> number >> point >> left >> right >> row) {
    tracks.resize(std::max(tracks.size(), static_cast<std::size_t>(number)));
    StereoMeasurement seen{.left = {left, row},
                           .disparity_px = left - right,
                           .covariance_px2 = Eigen::Vector3d(0.25, 0.25, 0.25).asDiagonal()};
    const auto place = Triangulate(pair.left, pair.right, seen.left, seen.disparity_px);
    if (!place) continue;
    seen.p_A = place->p_A;
    seen.covariance_m2 = place->Covariance(seen.covariance_px2);
    tracks[static_cast<std::size_t>(number) - 1][point] = seen;
  }
  return tracks;
}

std::vector<math::Transform> ReadPoses() {
  std::vector<math::Transform> poses;
  std::ifstream file(kFolder + "gtsam_poses.txt");
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream numbers(line);
    int number = 0;
    if (!(numbers >> number)) continue;
    math::Transform X_WC = math::Transform::Identity();
    for (int i = 0; i < 16; ++i) numbers >> X_WC.matrix()(i / 4, i % 4);
    poses.push_back(X_WC);
  }
  return poses;
}

PointsSeenTwice Common(const Tracks& first, const Tracks& second) {
  PointsSeenTwice points;
  for (const auto& [point, seen] : first) {
    const auto again = second.find(point);
    if (again != second.end()) points.push_back({seen, again->second});
  }
  return points;
}

class GtsamTracksTest : public testing::TestWithParam<SelectionMethod> {};

// Every step within 1.2 cm of 92 cm and 0.025 deg.
TEST_P(GtsamTracksTest, EveryStepIsThatOfTheOtherProgram) {
  const RectifiedPair pair = DrivePair();
  const std::vector<Tracks> tracks = ReadTracks(pair);
  const std::vector<math::Transform> poses = ReadPoses();
  ASSERT_EQ(tracks.size(), 26u);
  ASSERT_EQ(poses.size(), 26u);
  const SelectionParams selection{.method = GetParam()};
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const PointsSeenTwice points = Common(tracks[i], tracks[i + 1]);
    core::RandomStream stream({25, 0}, core::Purpose::kRansac, static_cast<std::uint32_t>(i));
    const auto set = FindConsistentSet(points, pair, selection, stream);
    ASSERT_TRUE(set) << i;
    const EstimatedMotion found = MotionOfSet(points, pair, *set, selection, {}).estimated;
    ASSERT_TRUE(found.motion) << i;
    const math::Transform off = (poses[i].inverse() * poses[i + 1]).inverse() * found.motion->X_FS;
    EXPECT_LT(off.translation().norm(), 0.012) << i;
    EXPECT_LT(math::RadToDeg(Eigen::AngleAxisd(off.linear()).angle()), 0.025) << i;
    RecordProperty(
        "step_" + std::to_string(i) + "_mm_millideg",
        std::to_string(off.translation().norm() * 1e3) + " " +
            std::to_string(1e3 * math::RadToDeg(Eigen::AngleAxisd(off.linear()).angle())));
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, GtsamTracksTest,
                         testing::Values(SelectionMethod::kRansac, SelectionMethod::kRigidity));

}  // namespace
}  // namespace rockyard::vision
