// The covariance of one motion after another against that of drawn errors.
#include <gtest/gtest.h>

#include "core/random.h"
#include "vision/odometry/estimate_motion.h"

namespace rockyard::vision {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using math::MakePose;
using math::Transform;

Eigen::Matrix3d Turned(const math::Vector3& turn) {
  return Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
}

Transform Disturbed(const Transform& X, const Vector6& error) {
  Transform disturbed = X;
  disturbed.translation() += error.head<3>();
  disturbed.linear() = Turned(error.tail<3>()) * X.linear();
  return disturbed;
}

Vector6 ErrorOf(const Transform& disturbed, const Transform& X) {
  const Eigen::AngleAxisd turn(disturbed.linear() * X.linear().transpose());
  Vector6 error;
  error << disturbed.translation() - X.translation(), turn.angle() * turn.axis();
  return error;
}

TEST(ComposeMotion, TheCovarianceIsThatOfDrawnErrors) {
  // 20,000 draws know a variance to 1 % (one deviation): bounds of 5 %. Seed 8.
  core::RandomStream stream({8, 0}, core::Purpose::kTest);
  Motion first;
  first.X_FS = MakePose({2.0, -1.0, 0.5}, 1.0, 0.3, -0.2);
  Motion second;
  second.X_FS = MakePose({1.5, 0.8, -0.4}, -0.6, 0.2, 0.4);
  Eigen::Matrix<double, 6, 6> roots[2];
  for (auto& root : roots) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) root(i, j) = 1e-3 * (stream.Uniform() - (i == j ? -1.0 : 0.3));
    }
  }
  first.covariance = roots[0] * roots[0].transpose();
  second.covariance = roots[1] * roots[1].transpose();
  const Motion whole = Compose(first, second);
  EXPECT_TRUE(whole.X_FS.isApprox(first.X_FS * second.X_FS, 1e-12));

  constexpr int kDraws = 20000;
  MotionCovariance drawn = MotionCovariance::Zero();
  const auto draw = [&](const auto& root) {
    Vector6 normal;
    for (int i = 0; i < 6; ++i) normal[i] = core::SampleNormal(stream, 0.0, 1.0);
    return Vector6(root * normal);
  };
  for (int i = 0; i < kDraws; ++i) {
    const Transform X =
        Disturbed(first.X_FS, draw(roots[0])) * Disturbed(second.X_FS, draw(roots[1]));
    const Vector6 error = ErrorOf(X, whole.X_FS);
    drawn += error * error.transpose() / kDraws;
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double scale = std::sqrt(whole.covariance(i, i) * whole.covariance(j, j));
      EXPECT_NEAR(drawn(i, j), whole.covariance(i, j), 0.05 * scale) << i << " " << j;
    }
  }
}

TEST(ComposeMotion, NothingIsKnownBetterAfterwards) {
  const Motion first{.covariance = MotionCovariance::Identity()};
  Motion exact;
  exact.X_FS = MakePose({3.0, 0.0, 0.0}, 0.5, 0.0, 0.0);
  // A lever of 3 m adds 9 times the variance of heading and pitch to the position.
  const Motion whole = Compose(first, exact);
  EXPECT_NEAR(whole.covariance(0, 0), 1.0, 1e-12);
  EXPECT_NEAR(whole.covariance(1, 1), 10.0, 1e-12);
  EXPECT_NEAR(whole.covariance(2, 2), 10.0, 1e-12);
  EXPECT_NEAR(whole.covariance(1, 5), 3.0, 1e-12);
  EXPECT_NEAR(whole.covariance(2, 4), -3.0, 1e-12);
  EXPECT_TRUE(Compose(exact, first).covariance.isApprox(MotionCovariance::Identity(), 1e-12));
}

}  // namespace
}  // namespace rockyard::vision
