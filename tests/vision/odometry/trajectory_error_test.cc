// Errors of trajectories against closed forms and a search over alignments.

#include "vision/odometry/trajectory_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"

namespace rockyard::vision {
namespace {

using math::MakePose;
using math::Transform;
using math::Vector3;

Trajectory StraightPath(std::size_t poses, double step_m) {
  Trajectory path;
  for (std::size_t i = 0; i < poses; ++i) {
    path.push_back(MakePose({step_m * static_cast<double>(i), 0.0, 0.0}, 0.0, 0.0, 0.0));
  }
  return path;
}

// A winding path with attitudes, and the same with errors.
struct TwoPaths {
  Trajectory truth;
  Trajectory estimate;
};

TwoPaths WindingPaths(std::size_t poses, std::uint32_t seed) {
  core::RandomStream stream({seed, 0}, core::Purpose::kTest);
  TwoPaths paths;
  Transform truth = MakePose({3.0, -2.0, 0.4}, 0.7, 0.1, -0.2);
  Transform estimate = Transform::Identity();
  for (std::size_t i = 0; i < poses; ++i) {
    paths.truth.push_back(truth);
    paths.estimate.push_back(estimate);
    const auto uniform = [&](double half) { return half * (2.0 * stream.Uniform() - 1.0); };
    const Transform step = MakePose({1.0 + uniform(0.2), uniform(0.1), uniform(0.1)}, uniform(0.3),
                                    uniform(0.1), uniform(0.1));
    const Transform error = MakePose({uniform(0.05), uniform(0.05), uniform(0.05)}, uniform(0.02),
                                     uniform(0.02), uniform(0.02));
    truth = truth * step;
    estimate = estimate * step * error;
  }
  return paths;
}

TEST(TrajectoryError, AScaleErrorIsTheSameShareOfEverySegment) {
  const Trajectory truth = StraightPath(1001, 1.0);
  const Trajectory estimate = StraightPath(1001, 1.02);
  const std::vector<SegmentError> segments = SegmentErrors(truth, estimate);
  ASSERT_FALSE(segments.empty());
  for (const SegmentError& segment : segments) {
    // A segment ends one step after its length, as its end is to lie beyond it.
    const double steps = segment.length_m + 1.0;
    EXPECT_EQ(segment.last - segment.first, static_cast<std::int64_t>(steps));
    EXPECT_EQ(segment.first % 10, 0);
    EXPECT_NEAR(segment.translation, 0.02 * steps / segment.length_m, 1e-9);
    EXPECT_NEAR(segment.rotation_rad_per_m, 0.0, 1e-9);
  }
  // From 0, 10, ... as far as 1000 lies more than the length ahead.
  std::int64_t expected = 0;
  for (int length = 100; length <= 800; length += 100) expected += (999 - length) / 10 + 1;
  const auto mean = MeanOf(segments);
  EXPECT_EQ(mean->segments, expected);
  EXPECT_NEAR(mean->translation, 0.02, 0.0001);
  EXPECT_FALSE(MeanOf({}).has_value());
}

TEST(TrajectoryError, AConstantTurnOfTheEstimateIsAnErrorOfRotation) {
  const double turn_rad = 0.001;
  const Trajectory truth = StraightPath(50, 1.0);
  Trajectory estimate{Transform::Identity()};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    estimate.push_back(estimate.back() * MakePose({1.0, 0.0, 0.0}, turn_rad, 0.0, 0.0));
  }
  const double lengths_m[] = {9.5};
  const auto mean = MeanOf(SegmentErrors(truth, estimate, lengths_m, 1));
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->segments, 40);
  // Ten steps, of which each turns once.
  EXPECT_NEAR(mean->rotation_rad_per_m, 10.0 * turn_rad / 9.5, 1e-9);
  // The chord of an arc of ten steps is off by their offsets, turn (0 + 1 + ... + 9).
  EXPECT_NEAR(mean->translation, turn_rad * 45.0 / 9.5, 1e-4);
}

TEST(TrajectoryError, FramesDoNotMatter) {
  const TwoPaths paths = WindingPaths(60, 1);
  const double lengths_m[] = {5.0, 20.0};
  Trajectory moved = paths.estimate;
  for (Transform& pose : moved) pose = MakePose({5.0, 6.0, 7.0}, 1.0, 0.5, -0.4) * pose;
  const auto mean = MeanOf(SegmentErrors(paths.truth, paths.estimate, lengths_m, 1));
  const auto again = MeanOf(SegmentErrors(paths.truth, moved, lengths_m, 1));
  EXPECT_GT(mean->translation, 1e-3);
  EXPECT_NEAR(again->translation, mean->translation, 1e-12);
  EXPECT_NEAR(again->rotation_rad_per_m, mean->rotation_rad_per_m, 1e-12);
  for (const Alignment alignment : {Alignment::kFirstPose, Alignment::kRigid}) {
    const auto errors_m = AbsoluteErrors_m(paths.truth, paths.estimate, alignment);
    const auto again_m = AbsoluteErrors_m(paths.truth, moved, alignment);
    for (std::size_t i = 0; i < errors_m.size(); ++i) EXPECT_NEAR(again_m[i], errors_m[i], 1e-9);
  }
  const RelativeErrors relative = RelativeErrorsOf(paths.truth, paths.estimate, 3);
  const RelativeErrors relative_again = RelativeErrorsOf(paths.truth, moved, 3);
  ASSERT_EQ(relative.rotation_rad.size(), 57u);
  for (std::size_t i = 0; i < relative.rotation_rad.size(); ++i) {
    EXPECT_NEAR(relative_again.translation_m[i], relative.translation_m[i], 1e-9);
    EXPECT_NEAR(relative_again.rotation_rad[i], relative.rotation_rad[i], 1e-9);
  }
}

double SumOfSquares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

// Any other alignment is worse: turned or moved a little, about and along each axis.
TEST(TrajectoryError, TheRigidAlignmentIsTheBest) {
  for (const std::uint32_t seed : {2U, 3U, 4U}) {
    const TwoPaths paths = WindingPaths(30, seed);
    const Transform best = AlignmentOf(paths.truth, paths.estimate, Alignment::kRigid);
    EXPECT_NEAR(best.linear().determinant(), 1.0, 1e-12);
    const auto sum_of = [&](const Transform& X_TE) {
      double sum = 0.0;
      for (std::size_t i = 0; i < paths.truth.size(); ++i) {
        sum +=
            (paths.truth[i].translation() - X_TE * paths.estimate[i].translation()).squaredNorm();
      }
      return sum;
    };
    const double least = sum_of(best);
    EXPECT_NEAR(least,
                SumOfSquares(AbsoluteErrors_m(paths.truth, paths.estimate, Alignment::kRigid)),
                1e-9);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double way : {-1e-3, 1e-3}) {
        Transform moved = best;
        moved.translation()[axis] += way;
        EXPECT_GT(sum_of(moved), least);
        Transform turned = best;
        turned.linear() = Eigen::AngleAxisd(way, Vector3::Unit(axis)) * best.linear();
        EXPECT_GT(sum_of(turned), least);
      }
    }
    EXPECT_GT(sum_of(AlignmentOf(paths.truth, paths.estimate, Alignment::kFirstPose)), least);
  }
}

// Mirrored positions: without the sign of the determinant the alignment would be a reflection.
TEST(TrajectoryError, AMirroredPathIsNotAlignedByAReflection) {
  const TwoPaths paths = WindingPaths(30, 5);
  Trajectory mirrored = paths.truth;
  for (Transform& pose : mirrored) pose.translation().z() *= -1.0;
  for (Transform& pose : mirrored) pose.translation().y() += pose.translation().z() * 5.0;
  const Transform X = AlignmentOf(paths.truth, mirrored, Alignment::kRigid);
  EXPECT_NEAR(X.linear().determinant(), 1.0, 1e-12);
}

TEST(TrajectoryError, FirstPosesAreMadeEqual) {
  const TwoPaths paths = WindingPaths(10, 6);
  const Transform X = AlignmentOf(paths.truth, paths.estimate, Alignment::kFirstPose);
  EXPECT_TRUE((X * paths.estimate.front()).isApprox(paths.truth.front(), 1e-12));
  EXPECT_NEAR(AbsoluteErrors_m(paths.truth, paths.estimate, Alignment::kFirstPose)[0], 0.0, 1e-12);
}

TEST(TrajectoryError, RelativeErrorsOfAKnownStep) {
  const Trajectory truth = StraightPath(6, 1.0);
  Trajectory estimate = truth;
  for (std::size_t i = 3; i < estimate.size(); ++i) {
    estimate[i].translation() += Vector3(0.03, 0.04, 0.0);
    estimate[i].linear() = Eigen::AngleAxisd(0.1, Vector3::UnitZ()).toRotationMatrix();
  }
  const RelativeErrors one = RelativeErrorsOf(truth, estimate, 1);
  ASSERT_EQ(one.translation_m.size(), 5u);
  EXPECT_NEAR(one.translation_m[0], 0.0, 1e-12);
  EXPECT_NEAR(one.translation_m[2], 0.05, 1e-12);
  EXPECT_NEAR(one.rotation_rad[2], 0.1, 1e-12);
  EXPECT_NEAR(one.rotation_rad[3], 0.0, 1e-7);
  EXPECT_TRUE(RelativeErrorsOf(truth, estimate, 6).translation_m.empty());
  EXPECT_EQ(RelativeErrorsOf(truth, estimate, 5).translation_m.size(), 1u);
}

TEST(TrajectoryError, SummariesOfAFewNumbers) {
  const auto odd = SummaryOf({3.0, 1.0, 2.0});
  EXPECT_EQ(odd->count, 3);
  EXPECT_DOUBLE_EQ(odd->median, 2.0);
  EXPECT_DOUBLE_EQ(odd->mean, 2.0);
  EXPECT_DOUBLE_EQ(odd->rms, std::sqrt(14.0 / 3.0));
  EXPECT_DOUBLE_EQ(odd->largest, 3.0);
  EXPECT_DOUBLE_EQ(SummaryOf({4.0, 1.0, 2.0, 3.0})->median, 2.5);
  EXPECT_FALSE(SummaryOf({}).has_value());
}

TEST(TrajectoryError, AnglesKeepTheirDigitsAtBothEnds) {
  for (const double angle : {1e-9, 1e-4, 1.0, std::numbers::pi - 1e-6}) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(angle, Vector3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
    EXPECT_NEAR(AngleOf(R), angle, 1e-9 * std::max(angle, 1e-3)) << angle;
  }
}

// Errors drawn from the covariance that the motion claims have a chi-squared sum: mean 6, variance
// 12. Seed 7, 4000 draws, alpha 1e-6 two-sided (4.9 deviations); a covariance half as large is the
// negative control.
TEST(TrajectoryError, NormalizedErrorsFollowChiSquared) {
  core::RandomStream stream({7, 0}, core::Purpose::kTest);
  Eigen::Matrix<double, 6, 6> root;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) root(i, j) = (i == j ? 0.01 : 0.0) + 0.002 * stream.Uniform();
  }
  Motion motion{.X_FS = MakePose({0.7, 0.1, -0.2}, 0.4, 0.2, -0.3),
                .covariance = root * root.transpose()};
  constexpr int kDraws = 4000;
  double sum = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    Eigen::Matrix<double, 6, 1> normal;
    for (int j = 0; j < 6; ++j) normal[j] = core::SampleNormal(stream, 0.0, 1.0);
    const Eigen::Matrix<double, 6, 1> error = root * normal;
    Transform truth = motion.X_FS;
    truth.translation() += error.head<3>();
    const Vector3 turn = error.tail<3>();
    truth.linear() =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * motion.X_FS.linear();
    sum += NormalizedErrorSquared(motion, truth);
  }
  const double sd = std::sqrt(12.0 / kDraws);
  EXPECT_NEAR(sum / kDraws, 6.0, 4.9 * sd);
  EXPECT_GT(std::abs(2.0 * sum / kDraws - 6.0), 4.9 * sd);
}

}  // namespace
}  // namespace rockyard::vision
