// Rigid motions in closed form.
#include "vision/odometry/rigid_motion.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/numbers.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

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
