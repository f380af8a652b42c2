#include "math/pose.h"

#include <gtest/gtest.h>

#include "math/angles.h"
#include "math/decompositions.h"
#include "math/sun_position.h"

namespace rockyard::math {
namespace {

Transform Pose(double yaw, double pitch, double roll) {
  Transform X_WR = Transform::Identity();
  X_WR.rotate(Eigen::AngleAxisd(yaw, Vector3::UnitZ()) *
              Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
              Eigen::AngleAxisd(roll, Vector3::UnitX()));
  X_WR.pretranslate(Vector3(1.0, -2.0, 0.5));
  return X_WR;
}

TEST(PoseTest, HeadingIsTheYawWhateverPitchAndRollAre) {
  for (const double yaw : {-3.0, -0.5, 0.0, 1.2, 3.1}) {
    EXPECT_NEAR(Heading(Pose(yaw, 0.4, -0.3)), yaw, 1e-12);
  }
}

TEST(PoseTest, TiltIsTheAngleBetweenTheVerticals) {
  EXPECT_EQ(Tilt(Transform::Identity()), 0.0);
  EXPECT_NEAR(Tilt(Pose(0.7, 0.3, 0.0)), 0.3, 1e-12);
  EXPECT_NEAR(Tilt(Pose(-2.0, 0.0, -0.4)), 0.4, 1e-12);
  EXPECT_NEAR(Tilt(Pose(1.0, 0.3, 0.4)), std::acos(std::cos(0.3) * std::cos(0.4)), 1e-12);
  EXPECT_NEAR(Tilt(Pose(0.0, 0.0, std::numbers::pi)), std::numbers::pi, 1e-7);
}

TEST(PoseTest, PlanarPoseTakesPositionAndHeading) {
  const Pose2 pose = ToPose2(Pose(0.7, 0.1, 0.1));
  EXPECT_EQ(pose.x_m, 1.0);
  EXPECT_EQ(pose.y_m, -2.0);
  EXPECT_NEAR(pose.heading_rad, 0.7, 1e-12);
}

void ExpectNear(const Pose2& found, const Pose2& known) {
  EXPECT_NEAR(found.x_m, known.x_m, 1e-12);
  EXPECT_NEAR(found.y_m, known.y_m, 1e-12);
  EXPECT_NEAR(WrapAngle(found.heading_rad - known.heading_rad), 0.0, 1e-12);
}

// A quarter turn to the left takes what lies ahead to the left; headings stay within a half turn.
// Eigen's rotations take the C library's sines, ours do not; they are the same but for rounding.
TEST(PoseTest, RotationsAreThoseOfEigen) {
  const Vector3 axis = Vector3(2.0, -3.0, 6.0) / 7.0;
  for (const double angle : {0.0, 1e-9, 0.3, 1.5, 3.0, 3.141592653589793}) {
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Matrix3d right = Eigen::AngleAxisd(sign * angle, axis).toRotationMatrix();
      EXPECT_LT((RotationAbout(sign * angle, axis) - right).norm(), 1e-15) << angle;
      const auto turn = TurnOf(right);
      EXPECT_NEAR(turn.angle_rad, angle, 1e-15);
      const Vector3 vector = turn.angle_rad > 3.1 && turn.axis.x() * sign < 0.0
                                 ? Vector3(-turn.Vector_rad())
                                 : turn.Vector_rad();
      EXPECT_LT((vector - sign * angle * axis).norm(), 2e-15) << angle;
    }
  }
  EXPECT_EQ(TurnOf(Eigen::Matrix3d::Identity()).axis, Vector3::UnitX());
  const Vector3 place(1.0, -2.0, 0.5);
  for (const double yaw : {-3.0, 0.4}) {
    const Transform right = Pose(yaw, 0.4, -0.3);
    EXPECT_LT((MakePose(place, yaw, 0.4, -0.3).matrix() - right.matrix()).norm(), 1e-15);
  }
}

TEST(Pose2Test, ComposesByHand) {
  const double quarter_rad = 0.5 * std::numbers::pi;
  ExpectNear(Pose2{1.0, 2.0, quarter_rad} * Pose2{3.0, 1.0, 0.5}, {0.0, 5.0, quarter_rad + 0.5});
  const Pose2 back = Pose2{0.0, 0.0, 3.0} * Pose2{0.0, 0.0, 3.0};
  EXPECT_NEAR(back.heading_rad, 6.0 - 2.0 * std::numbers::pi, 1e-12);
}

TEST(Pose2Test, WhatIsSeenFromAPoseComposesToWhatItWas) {
  const Pose2 X_AB{1.5, -0.3, 2.1};
  const Pose2 X_AC{-2.0, 0.7, -1.4};
  ExpectNear(X_AB * SeenFrom(X_AB, X_AC), X_AC);
  // Carried along from A to another frame, C keeps its place beside B.
  const Pose2 X_DB{40.0, 30.0, -2.9};
  ExpectNear(SeenFrom(X_DB, Carried(X_DB, X_AB, X_AC)), SeenFrom(X_AB, X_AC));
  ExpectNear(TurnedAbout(X_AC, 1.0, 1.0, 0.4), Carried({1.0, 1.0, 0.4}, {1.0, 1.0, 0.0}, X_AC));
}

constexpr double kPi = std::numbers::pi;

TEST(AnglesTest, DegreesAndRadians) {
  EXPECT_DOUBLE_EQ(DegToRad(180.0), kPi);
  EXPECT_DOUBLE_EQ(DegToRad(-90.0), -kPi / 2.0);
  EXPECT_DOUBLE_EQ(RadToDeg(kPi / 6.0), 30.0);
}

TEST(AnglesTest, WrapKeepsTheDirectionAndTheRange) {
  for (int tenths = -200; tenths <= 200; ++tenths) {
    const double angle = 0.1 * tenths;
    const double wrapped = WrapAngle(angle);
    EXPECT_LE(std::fabs(wrapped), kPi);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-13);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-13);
  }
}

TEST(AnglesTest, WrapLeavesAnglesInRangeAlone) {
  for (const double angle : {-3.1, -1.0, 0.0, 1e-300, 2.5, 3.1}) EXPECT_EQ(WrapAngle(angle), angle);
}

// The short cut for angles in range and its border.
TEST(AnglesTest, WrapIsTheRemainder) {
  for (const double turns : {0.0, 0.2, 0.5, 0.5 + 1e-16, 0.5 + 1e-15, 0.75, 1.0, 1.5, 1e6}) {
    for (const double angle : {2.0 * kPi * turns, -2.0 * kPi * turns}) {
      EXPECT_EQ(WrapAngle(angle), std::remainder(angle, 2.0 * kPi)) << angle;
    }
  }
}

TEST(AnglesTest, WrapTakesTheShortWayRound) {
  EXPECT_NEAR(WrapAngle(DegToRad(350.0) - DegToRad(10.0)), DegToRad(-20.0), 1e-15);
  EXPECT_NEAR(WrapAngle(DegToRad(10.0) - DegToRad(350.0)), DegToRad(20.0), 1e-15);
}

TEST(SunPosition, StandsHighestAtNoon) {
  // Elevation at noon: 90 deg less the distance of latitude and declination.
  const double declination = DegToRad(15.0);
  const SkyDirection south = SunPosition(DegToRad(40.0), declination, 12.0);
  EXPECT_NEAR(RadToDeg(south.elevation_rad), 65.0, 1e-9);
  EXPECT_NEAR(std::abs(RadToDeg(south.azimuth_rad)), 180.0, 1e-9);
  const SkyDirection north = SunPosition(DegToRad(-10.0), declination, 12.0);
  EXPECT_NEAR(RadToDeg(north.elevation_rad), 65.0, 1e-9);
  EXPECT_NEAR(RadToDeg(north.azimuth_rad), 0.0, 1e-9);
}

TEST(SunPosition, RisesInTheEastAtTheEquinox) {
  const SkyDirection morning = SunPosition(DegToRad(30.0), 0.0, 6.0);
  EXPECT_NEAR(morning.elevation_rad, 0.0, 1e-12);
  EXPECT_NEAR(RadToDeg(morning.azimuth_rad), 90.0, 1e-9);
  EXPECT_NEAR(RadToDeg(SunPosition(DegToRad(30.0), 0.0, 18.0).azimuth_rad), -90.0, 1e-9);
}

// The day is 24 h - 2 acos(tan(phi) tan(delta)) / 15 deg long: an independent equation of sunrise.
TEST(SunPosition, RisesWhenTheDayBegins) {
  const double latitude = DegToRad(19.3);
  const double declination = SunDeclination(DegToRad(142.7));
  const double half_day_h = RadToDeg(std::acos(-std::tan(latitude) * std::tan(declination))) / 15.0;
  EXPECT_NEAR(SunPosition(latitude, declination, 12.0 - half_day_h).elevation_rad, 0.0, 1e-9);
  EXPECT_GT(half_day_h, 6.0);
}

TEST(SunDeclination, IsTheObliquityAtTheSolstices) {
  EXPECT_NEAR(RadToDeg(SunDeclination(DegToRad(90.0))), 25.19, 1e-9);
  EXPECT_NEAR(RadToDeg(SunDeclination(DegToRad(270.0))), -25.19, 1e-9);
  EXPECT_NEAR(SunDeclination(0.0), 0.0, 1e-15);
}

TEST(ToUnitVector, TurnsClockwiseFromNorth) {
  EXPECT_LT((ToUnitVector({0.0, 0.0}, DegToRad(90.0)) - Vector3(0.0, 1.0, 0.0)).norm(), 1e-12);
  const Vector3 east = ToUnitVector({DegToRad(90.0), 0.0}, DegToRad(90.0));
  EXPECT_LT((east - Vector3(1.0, 0.0, 0.0)).norm(), 1e-12);
  const Vector3 high = ToUnitVector({0.0, DegToRad(30.0)}, 0.0);
  EXPECT_LT((high - Vector3(std::cos(DegToRad(30.0)), 0.0, 0.5)).norm(), 1e-12);
}

// What is decomposed, put together again.

constexpr double kTolerance = 1e-12;

Eigen::Matrix3d TurnAbout(double x, double y, double z) {
  return Eigen::AngleAxisd(1.0, Eigen::Vector3d(x, y, z).normalized()).toRotationMatrix();
}

// Not symmetric, far from singular.
Matrix6 Mixed() {
  Matrix6 mixed = 3.0 * Matrix6::Identity();
  for (int i = 0; i < 36; ++i) mixed(i / 6, i % 6) += std::sin(1.0 + 5.0 * i);
  return mixed;
}

TEST(Decompositions, SolutionsAndInversesOfSix) {
  const Matrix6 mixed = Mixed();
  const Matrix6 N = mixed.transpose() * mixed;
  const Vector6 x = Vector6::LinSpaced(-2.0, 3.0);
  EXPECT_LT((SolveSymmetric(N, N * x) - x).norm(), kTolerance);
  EXPECT_LT((InverseOf(mixed) * mixed - Matrix6::Identity()).norm(), kTolerance);
  ASSERT_TRUE(InverseOfPositive(N));
  EXPECT_LT((*InverseOfPositive(N) * N - Matrix6::Identity()).norm(), kTolerance);
}

TEST(Decompositions, ANegativeEigenvalueHasNoInverseOfPositive) {
  const Matrix6 mixed = Mixed();
  Vector6 values = Vector6::Ones();
  values[3] = -0.1;
  const Matrix6 N = mixed.transpose() * values.asDiagonal() * mixed;
  EXPECT_FALSE(InverseOfPositive(N));
  EXPECT_LT((SolveSymmetric(N, N * values) - values).norm(), 1e-10) << "but a solution";
}

TEST(Decompositions, TheLargestEigenvalueIsNotTheFarthestFromZero) {
  const Eigen::Matrix3d R = TurnAbout(1.0, 2.0, 3.0);
  const Eigen::Vector3d values(1.0, 3.0, -5.0);
  EXPECT_NEAR(LargestEigenvalue(R * values.asDiagonal() * R.transpose()), 3.0, kTolerance);
}

TEST(Decompositions, SingularValuesAreThoseThatWerePutIn) {
  const Eigen::Vector3d values(0.5, 4.0, 2.0);
  const Eigen::Matrix3d matrix =
      TurnAbout(1.0, 2.0, 3.0) * values.asDiagonal() * TurnAbout(-2.0, 0.0, 1.0).transpose();
  const SingularValues found = SingularValuesOf(matrix);
  EXPECT_LT((found.values - Eigen::Vector3d(4.0, 2.0, 0.5)).norm(), kTolerance);
  EXPECT_LT((found.U * found.values.asDiagonal() * found.V.transpose() - matrix).norm(),
            kTolerance);
  EXPECT_LT((found.U.transpose() * found.U - Eigen::Matrix3d::Identity()).norm(), kTolerance);
  EXPECT_LT((found.V.transpose() * found.V - Eigen::Matrix3d::Identity()).norm(), kTolerance);
}

}  // namespace
}  // namespace rockyard::math
