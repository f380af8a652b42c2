// The growth of errors over a stretch, against differences of two dead reckonings and closed forms.
#include "localization/error_stretch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/angles.h"

namespace rockyard::localization {
namespace {

// What is believed of one drive: a pose and how its sensors are read.
struct Rover {
  double x = 0.3, y = -0.2, z = 0.0, heading = 0.4, pitch = 0.1;
  double bias = 0.01, gyro_scale = 0.95, wheel_scale = 1.03, pan = 0.0;

  MotionTick Believed(double wheels_m, double gyro_rad, double share, double duration_s) const {
    const double turn = (gyro_rad - bias * duration_s) / gyro_scale;
    return {.forward_m = wheels_m * wheel_scale,
            .turn_rad = turn,
            .along_rad = heading + share * turn,
            .turn_share = share,
            .pitch_rad = pitch,
            .duration_s = duration_s,
            .gyro_scale = gyro_scale,
            .wheel_scale = wheel_scale};
  }
  void Drive(const MotionTick& tick) {
    x += tick.forward_m * std::cos(tick.along_rad);
    y += tick.forward_m * std::sin(tick.along_rad);
    z -= tick.forward_m * std::sin(pitch);
    heading += tick.turn_rad;
  }
  ErrorVector Values() const {
    ErrorVector values;
    values << x, y, z, 0.0, pitch, heading, bias, gyro_scale, wheel_scale, pan;
    return values;
  }
  // Off by `step` in one row of the error.
  Rover Off(error::Row row, double step) const {
    Rover off = *this;
    if (row == error::kX) off.x += step;
    if (row == error::kY) off.y += step;
    if (row == error::kZ) off.z += step;
    if (row == error::kPitch) off.pitch += step;
    if (row == error::kHeading) off.heading += step;
    if (row == error::kGyroBias) off.bias += step;
    if (row == error::kGyroScale) off.gyro_scale += step;
    if (row == error::kWheelScale) off.wheel_scale += step;
    if (row == error::kPan) off.pan += step;
    return off;
  }
};

ErrorVector DriveCurve(Rover rover, double share, ErrorStretch* stretch = nullptr) {
  for (int i = 0; i < 40; ++i) {
    const double gyro_rad = i < 20 ? 0.02 : -0.03;
    const double wheels_m = i % 10 == 9 ? -0.002 : 0.0035;
    const MotionTick tick = rover.Believed(wheels_m, gyro_rad, share, 0.05);
    if (stretch != nullptr) stretch->Add(tick, {.tilt_kept = 1.0});
    rover.Drive(tick);
  }
  return rover.Values();
}

TEST(ErrorStretch, CarriesEveryErrorOnAsDeadReckoningDoes) {
  constexpr double kStep = 1e-6;
  for (const double share : {0.5, 0.0}) {
    ErrorStretch stretch;
    DriveCurve(Rover{}, share, &stretch);
    for (const error::Row row :
         {error::kX, error::kY, error::kZ, error::kPitch, error::kHeading, error::kGyroBias,
          error::kGyroScale, error::kWheelScale, error::kPan}) {
      const ErrorVector difference = (DriveCurve(Rover{}.Off(row, kStep), share) -
                                      DriveCurve(Rover{}.Off(row, -kStep), share)) /
                                     (2.0 * kStep);
      const ErrorVector column = stretch.transition().col(row);
      EXPECT_LT((column - difference).cwiseAbs().maxCoeff(), 1e-7) << "row " << row;
    }
    EXPECT_NEAR(stretch.way_m(), 1.03 * (36 * 0.0035 + 4 * 0.002), 1e-12);
  }
}

// Heading noise of q a metre, integrated twice: the variance across is q L^3 / 3, the covariance
// with the heading q L^2 / 2; that of the distance grows with the way.
TEST(ErrorStretch, GrowsAsTheClosedFormOfAStraightDrive) {
  constexpr double kLength_m = 10.0;
  constexpr int kTicks = 20000;
  const double q = 0.70 * math::DegToRad(1.0) * math::DegToRad(1.0);
  const double step_m = kLength_m / kTicks;
  ErrorStretch stretch;
  for (int i = 0; i < kTicks; ++i) {
    stretch.Add(
        {.forward_m = step_m, .along_rad = 0.0, .duration_s = 0.05},
        {.heading_rad2 = q * step_m, .distance_m2 = 0.0039 * step_m, .height_m2 = 1e-4 * step_m});
  }
  const ErrorMatrix& N = stretch.noise();
  EXPECT_NEAR(N(error::kHeading, error::kHeading), q * kLength_m, 1e-12);
  EXPECT_NEAR(N(error::kY, error::kY), q * std::pow(kLength_m, 3) / 3.0, 1e-5);
  EXPECT_NEAR(N(error::kY, error::kHeading), q * kLength_m * kLength_m / 2.0, 1e-6);
  EXPECT_NEAR(N(error::kX, error::kX), 0.0039 * kLength_m, 1e-12);
  EXPECT_NEAR(N(error::kZ, error::kZ), 1e-4 * kLength_m, 1e-12);
  EXPECT_NEAR(std::sqrt(N(error::kY, error::kY)), 0.267, 0.001);  // Matthies 1995, figure 6a
}

// A bias that walks is a heading whose rate walks: variances r T, r T^3 / 3, covariance -r T^2 / 2.
TEST(ErrorStretch, TurnsTheWalkOfTheBiasIntoHeading) {
  constexpr double kRate = 1e-8;  // rad2/s2 a second
  constexpr int kTicks = 10000;
  constexpr double kTick_s = 0.01;
  ErrorStretch stretch;
  for (int i = 0; i < kTicks; ++i) {
    stretch.Add({.duration_s = kTick_s}, {.bias_rad2_s2 = kRate * kTick_s});
  }
  const double T = kTicks * kTick_s;
  const ErrorMatrix& N = stretch.noise();
  EXPECT_NEAR(N(error::kGyroBias, error::kGyroBias) / (kRate * T), 1.0, 1e-9);
  EXPECT_NEAR(N(error::kHeading, error::kHeading) / (kRate * T * T * T / 3.0), 1.0, 1e-3);
  EXPECT_NEAR(N(error::kHeading, error::kGyroBias) / (-kRate * T * T / 2.0), 1.0, 1e-3);
}

// Half of a tick's turn is in its own step: noise of one tick alone.
TEST(ErrorStretch, PutsAShareOfATicksNoiseIntoItsOwnStep) {
  ErrorStretch stretch;
  stretch.Add({.forward_m = 2.0, .along_rad = 0.0, .turn_share = 0.5}, {.heading_rad2 = 0.01});
  EXPECT_NEAR(stretch.noise()(error::kY, error::kY), 0.01, 1e-15);
  EXPECT_NEAR(stretch.noise()(error::kY, error::kHeading), 0.01, 1e-15);
  ErrorStretch across;
  across.Add({.forward_m = 1.0, .along_rad = math::DegToRad(90.0)}, {.distance_m2 = 0.04});
  EXPECT_NEAR(across.noise()(error::kY, error::kY), 0.04, 1e-15);
  EXPECT_NEAR(across.noise()(error::kX, error::kX), 0.0, 1e-15);
  ErrorStretch oblique;
  oblique.Add({.forward_m = 1.0, .along_rad = math::DegToRad(45.0)}, {.distance_m2 = 0.04});
  EXPECT_NEAR(oblique.noise()(error::kX, error::kY), 0.02, 1e-15);
  EXPECT_NEAR(oblique.noise()(error::kY, error::kX), 0.02, 1e-15);
}

// The tilt's error forgets itself and stays as large as it is.
TEST(ErrorStretch, KeepsTheTiltsErrorStationary) {
  constexpr double kVariance = 4e-4;
  ErrorStretch stretch;
  for (int i = 0; i < 50; ++i) {
    stretch.Add({.forward_m = 0.0}, {.tilt_kept = 0.9, .tilt_rad2 = kVariance});
  }
  const double kept = std::pow(0.9, 50);
  for (const error::Row row : {error::kRoll, error::kPitch}) {
    EXPECT_NEAR(stretch.transition()(row, row), kept, 1e-12);
    EXPECT_NEAR(stretch.noise()(row, row), kVariance * (1.0 - kept * kept), 1e-12);
  }
}

TEST(ErrorStretch, BeginsAnew) {
  ErrorStretch stretch;
  EXPECT_TRUE(stretch.empty());
  stretch.Add({.forward_m = -1.0}, {.distance_m2 = 1.0});
  EXPECT_FALSE(stretch.empty());
  EXPECT_EQ(stretch.way_m(), 1.0);
  stretch.Restart();
  EXPECT_TRUE(stretch.empty());
  EXPECT_EQ(stretch.way_m(), 0.0);
  EXPECT_EQ(stretch.transition(), ErrorMatrix::Identity());
  EXPECT_EQ(stretch.noise(), ErrorMatrix::Zero());
}

}  // namespace
}  // namespace rockyard::localization
