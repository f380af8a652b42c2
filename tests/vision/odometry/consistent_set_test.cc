// Motions in closed form, and which points moved as one: among wrong matches, groups and shapes
// that tell no motion.
#include "vision/odometry/consistent_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/numbers.h"
#include "vision/odometry/synthetic_points.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

core::RandomStream Stream(std::uint32_t substream) {
  return {{251, 0}, core::Purpose::kTest, substream};
}

// What the second moment saw of other points: wrong matches.
void Mismatch(PointsSeenTwice& points, std::size_t first, core::RandomStream& stream) {
  const PointField field{.points = points.size() - first};
  const PointsSeenTwice others = SeeTwice(kOdometryPair, Transform::Identity(), field, stream);
  for (std::size_t i = first; i < points.size(); ++i) points[i].second = others[i - first].second;
}

SelectionParams By(SelectionMethod method) { return {.method = method}; }

std::size_t MembersBelow(const ConsistentSet& set, std::size_t limit) {
  return static_cast<std::size_t>(std::count_if(set.members.begin(), set.members.end(),
                                                [&](std::size_t i) { return i < limit; }));
}

double Off_m(const Transform& X, const Transform& truth) {
  return (X.translation() - truth.translation()).norm();
}

// Without errors, and known to a hundredth of a pixel.
PointField Exact(std::size_t points) {
  PointField field{.points = points, .with_errors = false};
  field.covariance_px2 *= 1e-3;
  return field;
}

class ConsistentSetTest : public testing::TestWithParam<SelectionMethod> {};

TEST_P(ConsistentSetTest, FindsThePointsThatMovedAmongSixtyPercentWrongMatches) {
  for (std::uint32_t run = 0; run < 20; ++run) {
    core::RandomStream stream = Stream(run);
    PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), {.points = 200}, stream);
    Mismatch(points, 80, stream);
    const auto set = FindConsistentSet(points, kOdometryPair, By(GetParam()), stream);
    ASSERT_TRUE(set);
    EXPECT_TRUE(std::is_sorted(set->members.begin(), set->members.end()));
    EXPECT_GE(MembersBelow(*set, 80), 68u) << run;
    EXPECT_LE(set->members.size() - MembersBelow(*set, 80), 3u) << run;
    EXPECT_LT(Off_m(set->X_FS, TestMotion()), 0.06) << run;
  }
}

// Sixty points stood, forty and then fifty moved on by themselves: never a mixture.
TEST_P(ConsistentSetTest, OfTwoGroupsTheLargerIsTakenWhole) {
  Transform other = TestMotion();
  other.translation() += math::Vector3(-0.4, 0.3, 0.0);
  for (const std::size_t moving : {40u, 50u}) {
    core::RandomStream stream = Stream(100 + static_cast<std::uint32_t>(moving));
    PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), Exact(60), stream);
    const PointsSeenTwice group = SeeTwice(kOdometryPair, other, Exact(moving), stream);
    points.insert(points.end(), group.begin(), group.end());
    const auto set = FindConsistentSet(points, kOdometryPair, By(GetParam()), stream);
    ASSERT_TRUE(set);
    EXPECT_EQ(MembersBelow(*set, 60), 60u);
    EXPECT_LE(set->members.size(), 60u + moving / 10);
    EXPECT_LT(Off_m(set->X_FS, TestMotion()), 0.1);
  }
}

TEST_P(ConsistentSetTest, PointsOnALineAndTooFewHaveNoMotion) {
  const Transform X_FS = TestMotion();
  PointsSeenTwice line;
  const auto from = Triangulate(kOdometryPair.left, kOdometryPair.right, {100, 150}, 40.0)->p_A;
  const auto to = Triangulate(kOdometryPair.left, kOdometryPair.right, {400, 220}, 15.0)->p_A;
  for (int i = 0; i <= 20; ++i) {
    const math::Vector3 p_F = from + i / 20.0 * (to - from);
    const auto first = SeenExactly(kOdometryPair, p_F, Eigen::Matrix3d::Identity());
    const auto second =
        SeenExactly(kOdometryPair, X_FS.inverse() * p_F, Eigen::Matrix3d::Identity());
    if (first && second) line.push_back({*first, *second});
  }
  ASSERT_GE(line.size(), 15u);
  core::RandomStream stream = Stream(200);
  // Rounding leaves a line's triples a motion now and then; rigidity takes all of them at once.
  const auto set = FindConsistentSet(line, kOdometryPair, By(GetParam()), stream);
  if (GetParam() == SelectionMethod::kRigidity) {
    EXPECT_FALSE(set);
  }
  line.resize(2);
  EXPECT_FALSE(FindConsistentSet(line, kOdometryPair, By(GetParam()), stream));
  EXPECT_FALSE(FindConsistentSet({}, kOdometryPair, By(GetParam()), stream));
}

INSTANTIATE_TEST_SUITE_P(Methods, ConsistentSetTest,
                         testing::Values(SelectionMethod::kRansac, SelectionMethod::kRigidity));

// A point counts as far as inlier_px in either eye and no further.
TEST(RansacTest, LooksAtBothEyes) {
  core::RandomStream stream = Stream(300);
  const PointsSeenTwice exact =
      SeeTwice(kOdometryPair, TestMotion(), {.points = 40, .with_errors = false}, stream);
  const auto counts = [&](double column, double row, double disparity) {
    PointsSeenTwice points = exact;
    points[7].second.left += Pixel(column, row);
    points[7].second.disparity_px += disparity;
    const auto set = FindConsistentSet(points, kOdometryPair, {}, stream);
    return set && MembersBelow(*set, 8) == 8;
  };
  EXPECT_TRUE(counts(1.4, 0.0, 0.0));
  EXPECT_FALSE(counts(1.6, 0.0, 1.6));   // left alone
  EXPECT_FALSE(counts(0.0, 0.0, 1.6));   // right alone
  EXPECT_FALSE(counts(0.0, -1.6, 0.0));  // both, by rows
  EXPECT_FALSE(counts(1.2, 1.2, 0.0));
  EXPECT_TRUE(counts(-1.0, 1.0, -1.0));
}

TEST(RansacTest, DrawsAreThoseOfTheStatedChance) {
  // 20 of 40: s = 20 19 18 / (40 39 38) = 0.11538.
  EXPECT_EQ(DrawsNeeded(20, 40, 1e-4, 1000), 76);
  EXPECT_EQ(DrawsNeeded(40, 40, 1e-4, 1000), 1);
  EXPECT_EQ(DrawsNeeded(3, 40, 1e-4, 1000), 1000);
  EXPECT_EQ(DrawsNeeded(2, 40, 1e-4, 1000), 1000);
  EXPECT_EQ(DrawsNeeded(3, 4, 0.5, 1000), 3);  // (3/4)^2 = 0.56 is not enough
  EXPECT_EQ(DrawsNeeded(3, 3, 1e-9, 1000), 1);
}

// How often, of many runs, the larger of two groups was not found.
int Misses(const PointsSeenTwice& points, std::size_t larger, const SelectionParams& params,
           int runs) {
  int misses = 0;
  for (int run = 0; run < runs; ++run) {
    core::RandomStream stream = Stream(1000 + static_cast<std::uint32_t>(run));
    const auto set = FindConsistentSet(points, kOdometryPair, params, stream);
    misses += !set || MembersBelow(*set, larger) < larger ? 1 : 0;
  }
  return misses;
}

// Of 20 points 9 moved one way and 8 another. Once the 8 are found, draws go on until the 9 are
// missed with a chance of 0.1 at most. One-sided alpha 0.001: binomial, 2000 runs.
TEST(RansacTest, TheLargerGroupIsMissedNoOftenerThanStated) {
  core::RandomStream stream = Stream(400);
  Transform other = TestMotion();
  other.translation() += math::Vector3(-0.4, 0.3, 0.2);
  PointsSeenTwice points =
      SeeTwice(kOdometryPair, TestMotion(), {.points = 9, .with_errors = false}, stream);
  const PointsSeenTwice group =
      SeeTwice(kOdometryPair, other, {.points = 11, .with_errors = false}, stream);
  points.insert(points.end(), group.begin(), group.end());
  Mismatch(points, 17, stream);
  SelectionParams params{.inlier_px = 0.05, .miss_probability = 0.1};
  constexpr int kRuns = 2000;
  constexpr double kSd = 13.4;  // sqrt(2000 0.1 0.9)
  EXPECT_LE(Misses(points, 9, params, kRuns), 200 + 3.09 * kSd);
  // Negative control: half the draws.
  params.max_draws = DrawsNeeded(8, 20, params.miss_probability, 1000) / 2;
  EXPECT_GT(Misses(points, 9, params, kRuns), 200 + 3.09 * kSd);
}

// From ten points of a hundred, of which the last ten were seen elsewhere.
TEST(MotionOfSetTest, TakesAllPointsThatMovedWithTheSet) {
  core::RandomStream stream({259, 0}, core::Purpose::kTest, 0);
  PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), PointField(), stream);
  for (std::size_t i = 90; i < 100; ++i) points[i].second.left += Pixel(8.0, -6.0);
  ConsistentSet set;
  for (std::size_t i = 0; i < 10; ++i) set.members.push_back(i);
  set.X_FS = TestMotion();
  const SelectionParams selection;
  EstimationParams estimation;
  estimation.max_fit = 1.0e-9;  // no motion, and yet a set
  const EstimatedMotion once = EstimateMotion(PointsSeenTwice(points.begin(), points.begin() + 10),
                                              kOdometryPair, estimation, set.X_FS);
  const SetMotion found = MotionOfSet(points, kOdometryPair, set, selection, estimation);
  EXPECT_GE(found.members.size(), 85u);
  EXPECT_LT(found.members.back(), 90u);
  EXPECT_EQ(found.members,
            PointsWith(points, kOdometryPair, found.estimated.X_FS, selection.inlier_px));
  EXPECT_GT(found.estimated.iterations, once.iterations);
  EXPECT_FALSE(found.estimated.motion);
  EXPECT_EQ(found.estimated.reason, NoMotion::kPoorFit);
}

const Transform kX_FS = math::MakePose({0.4, -1.2, 0.7}, 2.1, -0.6, 0.9);

std::vector<Vector3> Moved(const std::vector<Vector3>& points_S) {
  std::vector<Vector3> points_F;
  for (const Vector3& p_S : points_S) points_F.push_back(kX_FS * p_S);
  return points_F;
}

void ExpectNear(const Transform& X, const Transform& expected, double tolerance) {
  EXPECT_LT((X.matrix() - expected.matrix()).cwiseAbs().maxCoeff(), tolerance);
}

TEST(RigidMotionTest, ThreePointsGiveTheMotionThatMovedThem) {
  const std::vector<Vector3> points_S{{1, 0, 3}, {-2, 1, 5}, {0.5, -1, 4}};
  const auto X_FS = RigidMotion(Moved(points_S), points_S);
  ASSERT_TRUE(X_FS);
  ExpectNear(*X_FS, kX_FS, 1e-12);
}

// The best orthogonal matrix for points mirrored at a plane is a reflection; a motion it is not.
TEST(RigidMotionTest, MirroredPointsAreTurnedAndNeverMirrored) {
  const std::vector<Vector3> points_S{{1, 0, 3}, {-2, 1, 5}, {0.5, -1, 4}, {0, 2, 2}};
  std::vector<Vector3> points_F = Moved(points_S);
  for (Vector3& p_F : points_F) p_F.z() = -p_F.z();
  const auto X_FS = RigidMotion(points_F, points_S);
  ASSERT_TRUE(X_FS);
  EXPECT_NEAR(X_FS->linear().determinant(), 1.0, 1e-12);
}

// A cross whose ends are moved by dz, one way at one end and the other way at the other, is turned
// by nearly dz; moved all the same way, it is shifted by the mean.
TEST(RigidMotionTest, ErrorsAreSharedAsLeastSquaresDo) {
  const std::vector<Vector3> points_S{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  std::vector<Vector3> points_F = points_S;
  points_F[0].z() = points_F[1].z() = 0.4;
  auto X_FS = RigidMotion(points_F, points_S);
  ASSERT_TRUE(X_FS);
  EXPECT_NEAR(X_FS->translation().z(), 0.2, 1e-12);
  points_F[1].z() = -0.4;
  X_FS = RigidMotion(points_F, points_S);
  ASSERT_TRUE(X_FS);
  EXPECT_NEAR(X_FS->translation().norm(), 0.0, 1e-12);
  // x' = cos a x, z' = -sin a x: the least sum has tan a = -0.4.
  EXPECT_NEAR(std::atan2(-X_FS->linear()(2, 0), X_FS->linear()(0, 0)), -std::atan(0.4), 1e-12);
}

TEST(RigidMotionTest, PointsOnALineTooFewOrWithoutNumbersHaveNone) {
  const std::vector<Vector3> line{{1, 0, 3}, {2, 0, 6}, {3, 0, 9}, {-1, 0, -3}};
  EXPECT_FALSE(RigidMotion(Moved(line), line));
  const std::vector<Vector3> two{{1, 0, 3}, {2, 0, 5}};
  EXPECT_FALSE(RigidMotion(Moved(two), two));
  const std::vector<Vector3> place(4, Vector3(1, 2, 3));
  EXPECT_FALSE(RigidMotion(Moved(place), place));
  const std::vector<Vector3> endless{{1, 0, 3}, {-2, 1, 5}, {core::kInfinity, 0, 1}};
  EXPECT_FALSE(RigidMotion(endless, endless));
}

}  // namespace
}  // namespace rockyard::vision
