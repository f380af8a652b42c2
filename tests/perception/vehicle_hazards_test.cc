// What the rover feels: hazards and their sides, and when it takes itself for stuck.
#include "perception/vehicle_hazards.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

#include "math/angles.h"
#include "perception/stuck_detector.h"

namespace rockyard::perception {
namespace {

using math::DegToRad;
using math::Vector3;
using messages::ContactSwitch;
using messages::HazardSide;
using messages::MotionMeasurement;
using messages::VehicleHazardKind;
using messages::VehicleState;
using messages::WheelCommand;

// When the rover feels a hazard, and on which side.

VehicleHazardParams AtOnce() {
  VehicleHazardParams params;
  params.tilt_ticks = params.articulation_ticks = params.current_ticks = params.contact_ticks = 1;
  return params;
}

std::optional<messages::VehicleHazard> Felt(const VehicleState& state,
                                            const WheelTurns& turns = {}) {
  return HazardToAvoid(VehicleHazardDetector(AtOnce()).Observe(state, turns));
}

void ExpectFelt(const VehicleState& state, VehicleHazardKind kind, HazardSide side,
                const WheelTurns& turns = {}) {
  const auto hazard = Felt(state, turns);
  ASSERT_TRUE(hazard);
  EXPECT_EQ(hazard->kind, kind);
  EXPECT_EQ(hazard->side, side);
}

// Specific force of a rover at rest: gravity seen from R after a roll (left side up) and a pitch
// (nose up).
VehicleState Leaning(double roll_deg, double pitch_deg) {
  VehicleState state;
  const Eigen::Matrix3d R_WR = (Eigen::AngleAxisd(-DegToRad(pitch_deg), Vector3::UnitY()) *
                                Eigen::AngleAxisd(DegToRad(roll_deg), Vector3::UnitX()))
                                   .toRotationMatrix();
  state.specific_force_R = R_WR.transpose() * (3.72 * Vector3::UnitZ());
  return state;
}

TEST(TiltTest, IsTheAngleToTheVertical) {
  EXPECT_NEAR(TiltOf(*Leaning(0, 20).specific_force_R), DegToRad(20.0), 1e-12);
  EXPECT_NEAR(TiltOf(*Leaning(-31, 0).specific_force_R), DegToRad(31.0), 1e-12);
  // cos(tilt) = cos(roll) cos(pitch)
  EXPECT_NEAR(std::cos(TiltOf(*Leaning(10, 15).specific_force_R)),
              std::cos(DegToRad(10.0)) * std::cos(DegToRad(15.0)), 1e-12);
}

TEST(TiltTest, IsFeltAboveTheThreshold) {
  EXPECT_FALSE(Felt(Leaning(24.9, 0)));
  EXPECT_FALSE(Felt(Leaning(0, -24.9)));
  ExpectFelt(Leaning(25.1, 0), VehicleHazardKind::kTilt, HazardSide::kLeft);
  ExpectFelt(Leaning(-25.1, 0), VehicleHazardKind::kTilt, HazardSide::kRight);
  ExpectFelt(Leaning(0, 25.1), VehicleHazardKind::kTilt, HazardSide::kAhead);
  ExpectFelt(Leaning(0, -25.1), VehicleHazardKind::kTilt, HazardSide::kAhead);
  ExpectFelt(Leaning(20, 17), VehicleHazardKind::kTilt, HazardSide::kLeft);
  EXPECT_TRUE(Felt(Leaning(180, 0)));  // upside down
}

VehicleState Bent(double left_rocker_deg, double left_bogie_deg, double right_bogie_deg) {
  VehicleState state;
  state.articulation = {DegToRad(left_rocker_deg), -DegToRad(left_rocker_deg),
                        DegToRad(left_bogie_deg), DegToRad(right_bogie_deg)};
  return state;
}

TEST(ArticulationTest, IsFeltAboveTheThreshold) {
  EXPECT_FALSE(Felt(Bent(14.9, 43.9, -43.9)));
  ExpectFelt(Bent(0, 44.1, 0), VehicleHazardKind::kArticulation, HazardSide::kLeft);
  ExpectFelt(Bent(0, 0, -44.1), VehicleHazardKind::kArticulation, HazardSide::kRight);
  ExpectFelt(Bent(0, -45, -45), VehicleHazardKind::kArticulation, HazardSide::kAhead);
  // The side whose front end is up: a rotation about y takes the nose down.
  ExpectFelt(Bent(-15.1, 0, 0), VehicleHazardKind::kArticulation, HazardSide::kLeft);
  ExpectFelt(Bent(15.1, 0, 0), VehicleHazardKind::kArticulation, HazardSide::kRight);
}

// Currents of all wheels at half of the limit, but for those of one.
VehicleState Drawing(std::size_t wheel, double current_A) {
  VehicleState state;
  state.motor_current_A.emplace().fill(0.5 * AtOnce().max_current_A);
  (*state.motor_current_A)[wheel] = current_A;
  return state;
}

// All wheels are told to turn by 0.1 rad a tick and do, but for one.
WheelTurns Turning(std::size_t wheel, double told_rad, double turned_rad) {
  WheelTurns turns;
  turns.told_rad.fill(0.1);
  turns.turned_rad.fill(0.1);
  turns.told_rad[wheel] = told_rad;
  turns.turned_rad[wheel] = turned_rad;
  return turns;
}

TEST(StallTest, IsCurrentNearStallOfAWheelThatHardlyTurns) {
  const double limit_A = AtOnce().max_current_A;
  const double share = AtOnce().max_turn_share;
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    const VehicleState strained = Drawing(wheel, limit_A + 1e-4);
    for (const double told_rad : {0.1, -0.1}) {
      const auto turned = [&](double part) { return Turning(wheel, told_rad, part * told_rad); };
      ExpectFelt(strained, VehicleHazardKind::kMotorCurrent,
                 wheel < 3 ? HazardSide::kLeft : HazardSide::kRight, turned(0.9 * share));
      EXPECT_TRUE(Felt(strained, turned(-0.5))) << "pushed back";
      EXPECT_FALSE(Felt(strained, turned(1.1 * share))) << "climbs";
      EXPECT_FALSE(Felt(Drawing(wheel, limit_A - 1e-4), turned(0.0))) << "light";
    }
    EXPECT_FALSE(Felt(strained, Turning(wheel, 0.0, 0.0))) << "at rest";
  }
}

TEST(StallTest, OnBothSidesIsAhead) {
  VehicleState state;
  state.motor_current_A.emplace().fill(1.0);
  ExpectFelt(state, VehicleHazardKind::kMotorCurrent, HazardSide::kAhead,
             {.told_rad = {1, 1, 1, 1, 1, 1}});
}

TEST(StallTest, FromTwoOnTheCurrentAloneDecides) {
  VehicleHazardParams params = AtOnce();
  params.max_turn_share = 2.0;
  VehicleHazardDetector detector(params);
  EXPECT_TRUE(HazardToAvoid(
      detector.Observe(Drawing(1, params.max_current_A + 1e-4), Turning(1, 0.1, 0.19))));
}

// Two wheels that stall in turn are not one that does; rests between do not count.
TEST(StallTest, HoldsAtOneWheelForTicksOfMotion) {
  VehicleHazardDetector detector({.current_ticks = 3});
  const auto stalls = [&](std::size_t wheel) {
    return HazardToAvoid(detector.Observe(Drawing(wheel, 1.0), Turning(wheel, 0.1, 0.0)))
        .has_value();
  };
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(stalls(0));
    EXPECT_FALSE(stalls(4));
  }
  EXPECT_FALSE(stalls(4));
  VehicleState resting;
  resting.motor_current_A.emplace();
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(HazardToAvoid(detector.Observe(resting, {})));
  EXPECT_TRUE(stalls(4));
  EXPECT_TRUE(HazardToAvoid(detector.Observe(resting, {}))) << "as long as it does not turn";
  detector.Reset();
  EXPECT_FALSE(stalls(4));
}

VehicleState Touched(std::initializer_list<ContactSwitch> closed) {
  VehicleState state;
  state.contact.emplace();
  for (const ContactSwitch contact : closed) (*state.contact)[Index(contact)] = true;
  return state;
}

TEST(ContactTest, SideIsThatOfTheSwitch) {
  constexpr auto kContact = VehicleHazardKind::kContact;
  EXPECT_FALSE(Felt(Touched({})));
  using enum ContactSwitch;
  ExpectFelt(Touched({kFrontLeft}), kContact, HazardSide::kLeft);
  ExpectFelt(Touched({kLeftEdge}), kContact, HazardSide::kLeft);
  ExpectFelt(Touched({kFrontRight}), kContact, HazardSide::kRight);
  ExpectFelt(Touched({kRightEdge}), kContact, HazardSide::kRight);
  ExpectFelt(Touched({kFrontCentre}), kContact, HazardSide::kAhead);
  ExpectFelt(Touched({kUndercarriage}), kContact, HazardSide::kAhead);
  ExpectFelt(Touched({kFrontLeft, kFrontRight}), kContact, HazardSide::kAhead);
  ExpectFelt(Touched({kFrontCentre, kFrontLeft}), kContact, HazardSide::kLeft);
  ExpectFelt(Touched({kRearEdge, kUndercarriage}), kContact, HazardSide::kAhead);
}

// A pressed rear switch is no hazard to get away from, and hides none.
TEST(ContactTest, TouchBehindHidesNothing) {
  VehicleState state = Leaning(30, 0);
  state.contact = Touched({ContactSwitch::kRearEdge}).contact;
  ExpectFelt(state, VehicleHazardKind::kTilt, HazardSide::kLeft);
  const auto all_felt = [](const VehicleState& from) {
    return VehicleHazardDetector(AtOnce()).Observe(from, {});
  };
  const FeltHazards felt = all_felt(state);
  EXPECT_TRUE(felt.touches_behind);
  ASSERT_TRUE(felt.by_kind[0]);
  EXPECT_EQ(felt.by_kind[0]->side, HazardSide::kBehind);
  const FeltHazards both = all_felt(Touched({ContactSwitch::kRearEdge, ContactSwitch::kFrontLeft}));
  EXPECT_TRUE(both.touches_behind);
  EXPECT_EQ(both.by_kind[0]->side, HazardSide::kLeft);
  EXPECT_FALSE(Felt(Touched({ContactSwitch::kRearEdge})));
  EXPECT_FALSE(all_felt(Touched({ContactSwitch::kFrontLeft})).touches_behind);
}

TEST(ContactTest, TouchBehindHoldsForTicksInARow) {
  VehicleHazardDetector detector({.contact_ticks = 2});
  const VehicleState behind = Touched({ContactSwitch::kRearEdge});
  EXPECT_FALSE(detector.Observe(behind, {}).touches_behind);
  EXPECT_TRUE(detector.Observe(behind, {}).touches_behind);
  detector.Reset();
  EXPECT_FALSE(detector.Observe(behind, {}).touches_behind);
}

TEST(VehicleHazardDetectorTest, HoldsForTicksInARowAndResetForgetsThem) {
  VehicleHazardDetector detector({.tilt_ticks = 3});
  // Ticks on a slope (s) and on the level (l), and resets (r): whether a tick feels the hazard.
  const auto felt = [&](std::string_view ticks) {
    std::string answers;
    for (const char tick : ticks) {
      if (tick == 'r') {
        detector.Reset();
        continue;
      }
      answers += HazardToAvoid(detector.Observe(Leaning(tick == 's' ? 30 : 0, 0), {})) ? 'x' : '.';
    }
    return answers;
  };
  EXPECT_EQ(felt("sslssssl"), ".....xx.");
  EXPECT_EQ(felt("ssrsss"), "....x");
}

TEST(VehicleHazardDetectorTest, TouchComesFirstAndMissingSensorsSayNothing) {
  VehicleState state = Leaning(30, 0);
  state.articulation = Bent(0, 46, 0).articulation;
  ExpectFelt(state, VehicleHazardKind::kTilt, HazardSide::kLeft);
  state.contact = Touched({ContactSwitch::kFrontRight}).contact;
  ExpectFelt(state, VehicleHazardKind::kContact, HazardSide::kRight);
  EXPECT_FALSE(Felt({}));
}

// When the rover takes itself for stuck, from hand-made commands and measurements.

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
  for (int i = 0; i < 60; ++i) EXPECT_EQ(detector_.Observe({}, Turned(0.0), {}), std::nullopt);
  EXPECT_EQ(Run(params_.window_s - 2.0 * kTick_s, Rolling(0.0, 0.4), Turned(0.0)), std::nullopt);
  EXPECT_EQ(detector_.Observe({}, Turned(0.0), {}), std::nullopt);
  EXPECT_EQ(Run(3.0 * kTick_s, Rolling(0.0, 0.4), Turned(0.0)), StuckSign::kNoTurn);
}

TEST_F(StuckDetectorTest, StrainOfEnoughMotorsIsStuckOnAStraightDrive) {
  const double high_A = params_.strain_current_A;
  const double low_A = high_A - 0.001;
  const WheelCommand straight = Rolling(0.15, 0.0);
  const auto sign = [&](double fourth_A) {
    return Run(30.0, straight, Turned(0.0),
               Currents({high_A, high_A, high_A, fourth_A, low_A, low_A}));
  };
  EXPECT_EQ(sign(high_A), StuckSign::kStrain);
  EXPECT_NEAR(time_s_, params_.window_s, 1.5 * kTick_s);
  EXPECT_EQ(sign(low_A), std::nullopt);
  EXPECT_EQ(Run(30.0, straight, Turned(0.0)), std::nullopt);  // no sensor
}

TEST_F(StuckDetectorTest, StrainHasToLast) {
  const WheelCommand straight = Rolling(0.15, 0.0);
  const VehicleState strained = Currents({0.1, 0.1, 0.1, 0.1, 0.1, 0.1});
  const auto with_rest = [&](double rest_share) {
    detector_.Restart();
    const double rest_s = rest_share * params_.window_s;
    Run(rest_s, straight, Turned(0.0), Currents({}));
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
