// Steering geometry: every wheel rolls about the common centre of rotation.
#include <gtest/gtest.h>

#include "drive_geometry.h"
#include "navigation/wheel_driver.h"

namespace rockyard::navigation {
namespace {

using messages::kWheelCount;

constexpr double kRounding = 1e-12;

// Curvatures of both signs, down to a centre of rotation between the wheels.
constexpr double kCurvatures_per_m[] = {-8.0, -1.5, -0.6, -0.01, 0.01, 0.6, 1.5, 8.0};

TEST(SteadyWheelCommand, StopTurnsNoWheel) {
  const messages::WheelCommand command = SteadyWheelCommand({}, SixWheels());
  for (const double rate_rad_s : command.rate_rad_s) EXPECT_EQ(rate_rad_s, 0.0);
}

TEST(SteadyWheelCommand, StraightRollsAllWheelsAlikeAtFullSpeed) {
  for (const int direction : {1, -1}) {
    const messages::WheelCommand command = SteadyWheelCommand(Arc(0.0, direction), SixWheels());
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      EXPECT_NEAR(command.rate_rad_s[i], direction * 0.15 / 0.065, kRounding);
      EXPECT_EQ(command.steer_rad[i], 0.0);
    }
  }
}

TEST(SteadyWheelCommand, AxesOfSteeredWheelsPassThroughTheCentreOfRotation) {
  const messages::DriveCalibration c = SixWheels();
  for (const double curvature_per_m : kCurvatures_per_m) {
    const messages::WheelCommand command = SteadyWheelCommand(Arc(curvature_per_m), c);
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      SCOPED_TRACE(testing::Message() << "curvature " << curvature_per_m << ", wheel " << i);
      if (!c.steered[i]) {
        EXPECT_EQ(command.steer_rad[i], 0.0);
        continue;
      }
      // The wheel's rolling direction is normal to the line from the wheel to (0, 1/curvature).
      const double along =
          -c.wheel_x_m[i] * std::cos(command.steer_rad[i]) +
          (1.0 / curvature_per_m - c.wheel_y_m[i]) * std::sin(command.steer_rad[i]);
      EXPECT_NEAR(along * curvature_per_m, 0.0, kRounding);
      EXPECT_LE(std::abs(command.steer_rad[i]), c.max_steer_rad);
    }
  }
}

TEST(SteadyWheelCommand, FrontWheelsSteerIntoTheArcAndRearWheelsOutOfIt) {
  const messages::WheelCommand left = SteadyWheelCommand(Arc(0.8), SixWheels());
  const messages::WheelCommand right = SteadyWheelCommand(Arc(-0.8), SixWheels());
  for (const messages::Wheel wheel : {messages::Wheel::kLeftFront, messages::Wheel::kRightFront}) {
    EXPECT_GT(left.steer_rad[messages::Index(wheel)], 0.0);
    EXPECT_LT(right.steer_rad[messages::Index(wheel)], 0.0);
  }
  for (const messages::Wheel wheel : {messages::Wheel::kLeftRear, messages::Wheel::kRightRear}) {
    EXPECT_LT(left.steer_rad[messages::Index(wheel)], 0.0);
    EXPECT_GT(right.steer_rad[messages::Index(wheel)], 0.0);
  }
}

TEST(SteadyWheelCommand, RatesAreProportionalToTheRadiusAboutTheCentre) {
  const messages::DriveCalibration c = SixWheels();
  for (const double curvature_per_m : {-1.5, -0.6, 0.6, 1.5}) {
    const messages::WheelCommand command = SteadyWheelCommand(Arc(curvature_per_m), c);
    const double centre_y_m = 1.0 / curvature_per_m;
    const double turn_rate_rad_s =
        command.rate_rad_s[messages::Index(messages::Wheel::kLeftMiddle)] * c.wheel_radius_m /
        std::abs(centre_y_m - 0.19);
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const double radius_m = std::hypot(c.wheel_x_m[i], centre_y_m - c.wheel_y_m[i]);
      EXPECT_NEAR(command.rate_rad_s[i] * c.wheel_radius_m, turn_rate_rad_s * radius_m, kRounding);
    }
    EXPECT_NEAR(FastestRim(command, c), c.max_wheel_speed_m_s, kRounding);
  }
}

TEST(SteadyWheelCommand, WheelsInsideATightArcRollBackward) {
  // The centre of rotation lies at y = 0.125 m, between the middle and the left wheels.
  const messages::WheelCommand command = SteadyWheelCommand(Arc(8.0), SixWheels());
  EXPECT_LT(command.rate_rad_s[messages::Index(messages::Wheel::kLeftMiddle)], 0.0);
  EXPECT_GT(command.rate_rad_s[messages::Index(messages::Wheel::kRightMiddle)], 0.0);
  EXPECT_NEAR(FastestRim(command, SixWheels()), 0.15, kRounding);
}

TEST(SteadyWheelCommand, UnsteeredWheelTakesTheForwardComponent) {
  messages::DriveCalibration c = SixWheels();
  c.wheel_x_m[messages::Index(messages::Wheel::kRightMiddle)] = 0.05;
  const double curvature_per_m = 0.8;
  const messages::WheelCommand command = SteadyWheelCommand(Arc(curvature_per_m), c);
  const double ratio = command.rate_rad_s[messages::Index(messages::Wheel::kRightMiddle)] /
                       command.rate_rad_s[messages::Index(messages::Wheel::kLeftMiddle)];
  EXPECT_NEAR(ratio, (1.0 + 0.19 * curvature_per_m) / (1.0 - 0.19 * curvature_per_m), kRounding);
}

TEST(SteadyWheelCommand, BackwardKeepsTheSteeringAndReversesTheWheels) {
  for (const double curvature_per_m : kCurvatures_per_m) {
    const messages::WheelCommand forward = SteadyWheelCommand(Arc(curvature_per_m), SixWheels());
    const messages::WheelCommand backward =
        SteadyWheelCommand(Arc(curvature_per_m, -1), SixWheels());
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      EXPECT_NEAR(backward.steer_rad[i], forward.steer_rad[i], kRounding);
      EXPECT_NEAR(backward.rate_rad_s[i], -forward.rate_rad_s[i], kRounding);
    }
  }
}

TEST(SteadyWheelCommand, MirroredArcsMirrorTheWheels) {
  for (const double curvature_per_m : {0.01, 0.6, 1.5, 8.0}) {
    const messages::WheelCommand left = SteadyWheelCommand(Arc(curvature_per_m), SixWheels());
    const messages::WheelCommand right = SteadyWheelCommand(Arc(-curvature_per_m), SixWheels());
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const std::size_t other = (i + kWheelCount / 2) % kWheelCount;
      EXPECT_NEAR(left.steer_rad[i], -right.steer_rad[other], kRounding);
      EXPECT_NEAR(left.rate_rad_s[i], right.rate_rad_s[other], kRounding);
    }
  }
}

TEST(SteadyWheelCommand, TurnInPlaceRollsEveryWheelAboutTheOrigin) {
  const messages::DriveCalibration c = SixWheels();
  for (const int direction : {1, -1}) {
    const messages::WheelCommand command = SteadyWheelCommand(TurnInPlace(direction), c);
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      SCOPED_TRACE(i);
      EXPECT_LE(std::abs(command.steer_rad[i]), c.max_steer_rad);
      // Rolling velocity against that of the contact point, for the turn rate of a middle wheel.
      const double turn_rate_rad_s =
          command.rate_rad_s[messages::Index(messages::Wheel::kRightMiddle)] * c.wheel_radius_m /
          0.19;
      const double rim_m_s = command.rate_rad_s[i] * c.wheel_radius_m;
      EXPECT_NEAR(rim_m_s * std::cos(command.steer_rad[i]), -turn_rate_rad_s * c.wheel_y_m[i],
                  kRounding);
      EXPECT_NEAR(rim_m_s * std::sin(command.steer_rad[i]), turn_rate_rad_s * c.wheel_x_m[i],
                  kRounding);
      EXPECT_EQ(turn_rate_rad_s > 0.0, direction > 0);
    }
    EXPECT_NEAR(FastestRim(command, c), c.max_wheel_speed_m_s, kRounding);
  }
}

TEST(SteadyWheelCommand, TurnInPlaceIsMirrorSymmetric) {
  const messages::WheelCommand left = SteadyWheelCommand(TurnInPlace(1), SixWheels());
  const messages::WheelCommand right = SteadyWheelCommand(TurnInPlace(-1), SixWheels());
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const std::size_t other = (i + kWheelCount / 2) % kWheelCount;
    EXPECT_NEAR(left.steer_rad[i], right.steer_rad[i], kRounding);
    EXPECT_NEAR(left.rate_rad_s[i], -right.rate_rad_s[i], kRounding);
    EXPECT_NEAR(left.steer_rad[i], -left.steer_rad[other], kRounding);
    EXPECT_NEAR(left.rate_rad_s[i], -left.rate_rad_s[other], kRounding);
  }
}

TEST(SteadyWheelCommand, SteeringIsClamped) {
  messages::DriveCalibration c = SixWheels();
  c.max_steer_rad = 0.3;
  for (const messages::MotionCommand& motion :
       {TurnInPlace(1), TurnInPlace(-1), Arc(5.0), Arc(-5.0), Arc(1.0 / 0.19)}) {
    const messages::WheelCommand command = SteadyWheelCommand(motion, c);
    double largest_rad = 0.0;
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      EXPECT_TRUE(std::isfinite(command.rate_rad_s[i]));
      largest_rad = std::max(largest_rad, std::abs(command.steer_rad[i]));
    }
    EXPECT_NEAR(largest_rad, 0.3, kRounding);
    EXPECT_NEAR(FastestRim(command, c), c.max_wheel_speed_m_s, kRounding);
  }
}

}  // namespace
}  // namespace rockyard::navigation
