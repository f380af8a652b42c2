// When the rover feels a hazard, and on which side.
#include "perception/vehicle_hazards.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "math/angles.h"

namespace rockyard::perception {
namespace {

using math::DegToRad;
using math::Vector3;
using messages::ContactSwitch;
using messages::HazardSide;
using messages::VehicleHazardKind;
using messages::VehicleState;

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
  for (int i = 0; i < 9; ++i) {
    EXPECT_FALSE(HazardToAvoid(detector.Observe(resting, {})));
  }
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
  ExpectFelt(Touched({ContactSwitch::kFrontLeft}), kContact, HazardSide::kLeft);
  ExpectFelt(Touched({ContactSwitch::kLeftEdge}), kContact, HazardSide::kLeft);
  ExpectFelt(Touched({ContactSwitch::kFrontRight}), kContact, HazardSide::kRight);
  ExpectFelt(Touched({ContactSwitch::kRightEdge}), kContact, HazardSide::kRight);
  ExpectFelt(Touched({ContactSwitch::kFrontCentre}), kContact, HazardSide::kAhead);
  ExpectFelt(Touched({ContactSwitch::kUndercarriage}), kContact, HazardSide::kAhead);
  ExpectFelt(Touched({ContactSwitch::kFrontLeft, ContactSwitch::kFrontRight}), kContact,
             HazardSide::kAhead);
  ExpectFelt(Touched({ContactSwitch::kFrontCentre, ContactSwitch::kFrontLeft}), kContact,
             HazardSide::kLeft);
  ExpectFelt(Touched({ContactSwitch::kRearEdge, ContactSwitch::kUndercarriage}), kContact,
             HazardSide::kAhead);
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
      const VehicleState state = Leaning(tick == 's' ? 30 : 0, 0);
      answers += HazardToAvoid(detector.Observe(state, {})) ? 'x' : '.';
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

}  // namespace
}  // namespace rockyard::perception
