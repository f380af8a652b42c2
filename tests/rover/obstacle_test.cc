// Climbing, scraping, getting stuck.
#include <gtest/gtest.h>

#include <algorithm>

#include "rover_drive.h"

namespace rockyard::rover {
namespace {

using truth::BodyPart;

bool Climbs(double step_height_m) {
  RoverParams params;
  params.contact.wheel_rock_friction = 0.8;
  const terrain::Terrain terrain = StepTerrain(step_height_m);
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  // The rear wheels stand on the step from x = 0.6 + 0.26 on.
  for (int i = 0; i < 20 * 60; ++i) {
    rover->Step(command);
    if (rover->state().X_WR.translation().x() > 1.0) return true;
  }
  return false;
}

// Matthies 1995 sec. 2: designed to climb vertical steps of 1.5 wheel diameters.
TEST(Step, ClimbsUpToOneAndAHalfWheelDiameters) {
  EXPECT_TRUE(Climbs(0.10));
  EXPECT_TRUE(Climbs(0.13));
  EXPECT_TRUE(Climbs(0.195));
}

TEST(Step, FailsOnTwoWheelDiameters) { EXPECT_FALSE(Climbs(0.26)); }

TEST(Step, FailsWithoutFriction) {
  RoverParams params;
  params.contact.wheel_rock_friction = 0.2;
  const terrain::Terrain terrain = StepTerrain(0.13);
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, Drive(params, 0.15, 0.0), 15.0);
  EXPECT_LT(rover->state().X_WR.translation().x(), 1.0);
}

// One side over a rock: the chassis takes half of that side's pitch.
TEST(Rock, DifferentialHalvesThePitchOfOneSide) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.6, 0.2, 0.0, 0.15, 0.15, 0.1)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  double most_rad = 0.0;
  for (int i = 0; i < 600; ++i) {
    rover->Step(command);
    const truth::RoverState& s = rover->state();
    EXPECT_NEAR(s.left_rocker_rad + s.right_rocker_rad, 0.0, math::DegToRad(0.5));
    const double roll = std::atan2(s.X_WR.linear()(2, 1), s.X_WR.linear()(2, 2));
    const double chassis = Pitch(s.X_WR);
    // Where the right side stands level, its rocker takes back what the chassis leans.
    EXPECT_NEAR(chassis + s.right_rocker_rad, 0.0, math::DegToRad(1.5) + 0.1 * std::abs(roll));
    most_rad = std::max(most_rad, std::abs(s.left_rocker_rad));
  }
  EXPECT_GT(most_rad, math::DegToRad(2.0));
}

TEST(Rock, LowerThanTheBellyPassesBetweenTheWheels) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.1, 0.1, 0.12)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  for (int i = 0; i < 600; ++i) {
    rover->Step(command);
    EXPECT_TRUE(rover->state().contacts.empty());
  }
  EXPECT_GT(rover->state().X_WR.translation().x(), 1.3);
}

TEST(Rock, TallerThanTheBellyBlocksIt) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.12, 0.12, 0.2)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, Drive(params, 0.15, 0.0), 10.0);
  const truth::RoverState& state = rover->state();
  EXPECT_LT(state.X_WR.translation().x(), 0.5);
  ASSERT_EQ(state.contacts.size(), 1U);
  EXPECT_EQ(state.contacts[0].part, BodyPart::kBelly);
  EXPECT_EQ(state.contacts[0].rock, 0);
  EXPECT_GT(state.contacts[0].normal_force_N, 50.0);
}

TEST(Rock, UnderTheBellyScrapesAndLiftsIt) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.12, 0.08, 0.137)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  bool scraped = false;
  for (int i = 0; i < 420; ++i) {
    rover->Step(command);
    for (const truth::BodyContact& contact : rover->state().contacts) {
      scraped |= contact.part == BodyPart::kBelly && contact.sliding_speed_m_s > 0.05;
    }
  }
  EXPECT_TRUE(scraped);
}

// High-centred: the belly rests on a rock, the wheels hang or slip, and it does not get off.
TEST(Rock, HighCentresTheRoverPlacedOnIt) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.0, 0.0, 0.0, 0.2, 0.16, 0.18)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, Drive(params, 0.15, 0.0), 10.0);
  const truth::RoverState& state = rover->state();
  const auto belly =
      std::find_if(state.contacts.begin(), state.contacts.end(),
                   [](const truth::BodyContact& c) { return c.part == BodyPart::kBelly; });
  ASSERT_NE(belly, state.contacts.end());
  EXPECT_GT(belly->normal_force_N, 0.5 * params.mass.total_kg * 9.81);
  EXPECT_LT(state.X_WR.translation().head<2>().norm(), 0.1);
  EXPECT_GT(state.wheel_angle_rad[1], 20.0);
}

// Between two steep rocks nearer to each other than the rover is wide. At the default friction the
// wheels climb the wedge.
TEST(Rock, TwoRocksJamTheRover) {
  RoverParams params;
  params.contact.wheel_rock_friction = 0.3;
  const terrain::Terrain terrain = FlatTerrain(
      {MakeRock(0.7, 0.33, 0.0, 0.15, 0.15, 0.5), MakeRock(0.7, -0.33, 0.0, 0.15, 0.15, 0.5)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, Drive(params, 0.15, 0.0), 10.0);
  EXPECT_LT(rover->state().X_WR.translation().x(), 0.5);
  EXPECT_LT(rover->state().v_WR_m_s.norm(), 0.01);
}

TEST(Wall, StopsThePanel) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain({}, {{math::Vector3::UnitX(), 0.8}});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, Drive(params, 0.15, 0.0), 6.0);
  EXPECT_NEAR(rover->state().X_WR.translation().x(), 0.8 - 0.5 * params.geometry.length_m, 0.01);
  ASSERT_FALSE(rover->state().contacts.empty());
  EXPECT_EQ(rover->state().contacts[0].part, BodyPart::kPanelEdge);
  EXPECT_EQ(rover->state().contacts[0].rock, -1);
}

}  // namespace
}  // namespace rockyard::rover
