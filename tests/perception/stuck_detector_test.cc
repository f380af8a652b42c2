// When the rover takes itself for stuck, from hand-made commands and measurements.
#include "perception/stuck_detector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/angles.h"

namespace rockyard::perception {
namespace {

using messages::MotionMeasurement;
using messages::VehicleState;
using messages::WheelCommand;

constexpr double kTick_s = 0.05;
constexpr double kHalfTrack_m = 0.2;
constexpr double kAxle_m = 0.26;

// Six wheels, all steered, that start to roll as they are told.
messages::DriveCalibration Calibration() {
  messages::DriveCalibration calibration;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    calibration.wheel_x_m[i] = kAxle_m * (1.0 - static_cast<double>(i % 3));
    calibration.wheel_y_m[i] = i < 3 ? kHalfTrack_m : -kHalfTrack_m;
  }
  return calibration;
}

// Wheels that roll without slip where the rover's origin moves at v and turns at w: each along its
// own velocity (v - w y, w x).
WheelCommand Rolling(double v_m_s, double w_rad_s) {
  const messages::DriveCalibration calibration = Calibration();
  WheelCommand command;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double x_m_s = v_m_s - w_rad_s * calibration.wheel_y_m[i];
    const double y_m_s = w_rad_s * calibration.wheel_x_m[i];
    const double sense = x_m_s < 0.0 ? -1.0 : 1.0;
    command.steer_rad[i] = std::atan2(sense * y_m_s, sense * x_m_s);
    command.rate_rad_s[i] = sense * std::hypot(x_m_s, y_m_s) / calibration.wheel_radius_m;
  }
  return command;
}

MotionMeasurement Turned(double rate_rad_s) {
  return {.duration_s = kTick_s, .turn_rad = rate_rad_s * kTick_s};
}

VehicleState Currents(const messages::PerWheel<double>& currents_A) {
  VehicleState felt;
  felt.motor_current_A = currents_A;
  return felt;
}

TEST(ToldTurnRateTest, IsThatOfTheCommonCentreOfRotation) {
  for (const double v_m_s : {-0.15, 0.0, 0.05, 0.15}) {
    for (const double w_rad_s : {-0.5, -0.1, 0.0, 0.2, 0.4}) {
      EXPECT_NEAR(ToldTurnRate(Rolling(v_m_s, w_rad_s), Calibration()), w_rad_s, 1e-12);
    }
  }
}

TEST(ToldTurnRateTest, HoldsWhereTheMiddleOfTheWheelsLiesAside) {
  messages::DriveCalibration calibration = Calibration();
  WheelCommand command = Rolling(0.1, 0.3);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    calibration.wheel_y_m[i] += 0.1;
    command.steer_rad[i] = 0.0;
    command.rate_rad_s[i] = (0.1 - 0.3 * calibration.wheel_y_m[i]) / calibration.wheel_radius_m;
  }
  EXPECT_NEAR(ToldTurnRate(command, calibration), 0.3, 1e-12);
}

// Worn wheels roll less far: they are driven faster for the same turn, and known to be.
TEST(ToldTurnRateTest, KnowsThatWheelsDifferInSize) {
  messages::DriveCalibration calibration = Calibration();
  WheelCommand command = Rolling(0.1, 0.3);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    calibration.radius_ratio[i] = 1.0 - 0.03 * static_cast<double>(i);
    command.rate_rad_s[i] /= calibration.radius_ratio[i];
  }
  EXPECT_NEAR(ToldTurnRate(command, calibration), 0.3, 1e-12);
}

class StuckDetectorTest : public testing::Test {
 protected:
  // Ticks until a sign, `seconds` at most; the time until then.
  std::optional<StuckSign> Run(double seconds, const WheelCommand& command,
                               const MotionMeasurement& motion, const VehicleState& felt = {}) {
    for (time_s_ = 0.0; time_s_ < seconds - 1e-9;) {
      time_s_ += kTick_s;
      if (const auto sign = detector_.Observe(command, motion, felt)) return sign;
    }
    return std::nullopt;
  }

  StuckDetectorParams params_;
  StuckDetector detector_{params_, Calibration()};
  double time_s_ = 0.0;
};

TEST_F(StuckDetectorTest, NoticesATurnThatDoesNotHappenAfterOneWindow) {
  EXPECT_EQ(Run(60.0, Rolling(0.0, 0.4), Turned(0.0)), StuckSign::kNoTurn);
  EXPECT_NEAR(time_s_, params_.window_s, 1.5 * kTick_s);
  EXPECT_EQ(Run(60.0, Rolling(0.0, -0.4), Turned(0.0)), StuckSign::kNoTurn);
  EXPECT_NEAR(time_s_, params_.window_s, 1.5 * kTick_s);
}

TEST_F(StuckDetectorTest, HoldsTheGyroAgainstTheShare) {
  const double share = params_.min_turn_share;
  EXPECT_EQ(Run(30.0, Rolling(0.0, 0.4), Turned(0.4 * (share + 0.01))), std::nullopt);
  EXPECT_EQ(Run(30.0, Rolling(0.0, 0.4), Turned(0.4 * (share - 0.01))), StuckSign::kNoTurn);
  // Turned the other way is not turned as it was told.
  EXPECT_EQ(Run(30.0, Rolling(0.0, 0.4), Turned(-0.4)), StuckSign::kNoTurn);
}

TEST_F(StuckDetectorTest, NoticesThatAnArcDoesNotTurnIt) {
  EXPECT_EQ(Run(30.0, Rolling(0.15, 0.1), Turned(0.0)), StuckSign::kNoTurn);
  EXPECT_EQ(Run(30.0, Rolling(0.15, 0.1), Turned(0.094)), std::nullopt);
  EXPECT_EQ(Run(30.0, Rolling(-0.15, 0.1), Turned(0.0)), StuckSign::kNoTurn);
}

// About a middle wheel, which stands while the others turn the rover around it.
TEST_F(StuckDetectorTest, NoticesThatItDoesNotTurnAboutOneOfItsWheels) {
  for (const double side_m : {kHalfTrack_m, -kHalfTrack_m}) {
    const WheelCommand pivot = Rolling(0.3 * side_m, 0.3);
    const std::size_t standing = side_m > 0.0 ? 1 : 4;
    ASSERT_EQ(pivot.rate_rad_s[standing], 0.0);
    EXPECT_EQ(Run(30.0, pivot, Turned(0.0)), StuckSign::kNoTurn);
    EXPECT_EQ(Run(30.0, pivot, Turned(0.28)), std::nullopt);
    detector_.Restart();
  }
  // About its left front wheel, which is the first of the six.
  messages::DriveCalibration calibration = Calibration();
  WheelCommand pivot = Rolling(0.3 * kHalfTrack_m, 0.3);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double x_m_s = 0.3 * (kHalfTrack_m - calibration.wheel_y_m[i]);
    const double y_m_s = 0.3 * (calibration.wheel_x_m[i] - kAxle_m);
    pivot.steer_rad[i] = std::atan2(y_m_s, x_m_s);
    pivot.rate_rad_s[i] = std::hypot(x_m_s, y_m_s) / calibration.wheel_radius_m;
  }
  ASSERT_EQ(pivot.rate_rad_s[0], 0.0);
  EXPECT_EQ(Run(30.0, pivot, Turned(0.0)), StuckSign::kNoTurn);
}

// Below min_told_turn_deg a window says nothing.
TEST_F(StuckDetectorTest, NearlyStraightDrivesDoNotCount) {
  const double least_rad_s = params_.min_told_turn_rad / params_.window_s;
  EXPECT_EQ(Run(60.0, Rolling(0.15, 0.0), Turned(0.0)), std::nullopt);
  EXPECT_EQ(Run(60.0, Rolling(0.15, 0.98 * least_rad_s), Turned(0.0)), std::nullopt);
  EXPECT_EQ(Run(60.0, Rolling(0.15, 1.02 * least_rad_s), Turned(0.0)), StuckSign::kNoTurn);
}

// To and fro as it is told, without net turn: it gets on.
TEST_F(StuckDetectorTest, DitheringAsToldIsNotStuck) {
  for (int swing = 0; swing < 60; ++swing) {
    const double rate_rad_s = swing % 2 == 0 ? 0.4 : -0.4;
    ASSERT_EQ(Run(0.5, Rolling(0.0, rate_rad_s), Turned(0.94 * rate_rad_s)), std::nullopt);
  }
}

// Rocked to and fro while it is told to turn one way.
TEST_F(StuckDetectorTest, BeingRockedIsStuck) {
  std::optional<StuckSign> sign;
  for (int swing = 0; swing < 60 && !sign; ++swing) {
    sign = Run(0.5, Rolling(0.0, 0.4), Turned(swing % 2 == 0 ? 0.4 : -0.4));
  }
  EXPECT_EQ(sign, StuckSign::kNoTurn);
}

// Looks and steering at rest last as long as they last.
TEST_F(StuckDetectorTest, TimeAtRestDoesNotCount) {
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(detector_.Observe({}, Turned(0.0), {}), std::nullopt);
  }
  EXPECT_EQ(Run(params_.window_s - 2.0 * kTick_s, Rolling(0.0, 0.4), Turned(0.0)), std::nullopt);
  EXPECT_EQ(detector_.Observe({}, Turned(0.0), {}), std::nullopt);
  EXPECT_EQ(Run(3.0 * kTick_s, Rolling(0.0, 0.4), Turned(0.0)), StuckSign::kNoTurn);
}

TEST_F(StuckDetectorTest, StrainOfEnoughMotorsIsStuckOnAStraightDrive) {
  const double high_A = params_.strain_current_A;
  const double low_A = high_A - 0.001;
  const WheelCommand straight = Rolling(0.15, 0.0);
  EXPECT_EQ(
      Run(30.0, straight, Turned(0.0), Currents({high_A, high_A, high_A, high_A, low_A, low_A})),
      StuckSign::kStrain);
  EXPECT_NEAR(time_s_, params_.window_s, 1.5 * kTick_s);
  EXPECT_EQ(
      Run(30.0, straight, Turned(0.0), Currents({high_A, high_A, high_A, low_A, low_A, low_A})),
      std::nullopt);
  EXPECT_EQ(Run(30.0, straight, Turned(0.0)), std::nullopt);  // no sensor
}

TEST_F(StuckDetectorTest, StrainHasToLast) {
  const WheelCommand straight = Rolling(0.15, 0.0);
  const VehicleState strained = Currents({0.1, 0.1, 0.1, 0.1, 0.1, 0.1});
  const VehicleState relaxed = Currents({});
  const auto with_rest = [&](double rest_share) {
    detector_.Restart();
    const double rest_s = rest_share * params_.window_s;
    Run(rest_s, straight, Turned(0.0), relaxed);
    return Run(params_.window_s - rest_s + kTick_s, straight, Turned(0.0), strained);
  };
  const double most_rest = 1.0 - params_.strain_share;
  EXPECT_EQ(with_rest(most_rest - 0.03), StuckSign::kStrain);
  EXPECT_EQ(with_rest(most_rest + 0.03), std::nullopt);
}

// Each motor has to strain long enough, not one after the other.
TEST_F(StuckDetectorTest, MotorsThatStrainInTurnAreNotStuck) {
  const WheelCommand straight = Rolling(0.15, 0.0);
  for (int i = 0; i < 100; ++i) {
    const VehicleState felt = i % 2 == 0 ? Currents({0.1, 0.1, 0.1, 0.0, 0.0, 0.0})
                                         : Currents({0.0, 0.0, 0.0, 0.1, 0.1, 0.1});
    ASSERT_EQ(Run(0.5, straight, Turned(0.0), felt), std::nullopt);
  }
}

TEST_F(StuckDetectorTest, AMoveByHandBeginsAWindow) {
  EXPECT_EQ(Run(params_.window_s - 1.0, Rolling(0.0, 0.4), Turned(0.0)), std::nullopt);
  detector_.Restart();
  EXPECT_EQ(Run(params_.window_s - 1.0, Rolling(0.0, 0.4), Turned(0.0)), std::nullopt);
}

}  // namespace
}  // namespace rockyard::perception
