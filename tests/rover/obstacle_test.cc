// Steps and rocks that are climbed or not; and what touches besides the wheels: belly, arms, hubs
// and panel against rocks, panel and wheels against walls. It blocks, scrapes, deflects,
// high-centres and jams.
#include <gtest/gtest.h>

#include "rover/ground_touches.h"
#include "rover_drive.h"

namespace rockyard::rover {
namespace {

enum class Climb { kUp, kStuck, kTippedOver };

// Drives against a step of friction mu that stands on hard ground of the same friction.
Climb TryStep(double height_m, double friction, const RoverParams& rover_params = {}) {
  RoverParams params = rover_params;
  params.contact.wheel_rock_friction = friction;
  const RoverOn rover(StepTerrain(height_m, RigidGround(friction)), params);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  // The rear wheels stand on the step from x = 0.6 + 0.26 on.
  for (int i = 0; i < 20 * 60; ++i) {
    rover->Step(command);
    if (math::Tilt(rover->state().X_WR) > math::DegToRad(60.0)) return Climb::kTippedOver;
    if (rover->state().X_WR.translation().x() > 1.0) return Climb::kUp;
  }
  return Climb::kStuck;
}

// Matthies 1995 sec. 2: designed to climb vertical steps of 1.5 wheel diameters. Half the default
// torque of 4 Nm is enough; the wheel at the step presses it with what the other wheels push, and
// lifts itself by friction.
TEST(Step, ClimbsUpToOneAndAHalfWheelDiameters) {
  for (const double stall_torque_Nm : {2.0, 4.0}) {
    RoverParams params{.drive = {.stall_torque_Nm = stall_torque_Nm}};
    for (const double height_m : {0.10, 0.13, 0.195}) {
      for (const double friction : {0.8, 1.0}) {
        EXPECT_EQ(TryStep(height_m, friction, params), Climb::kUp) << height_m << ", " << friction;
      }
    }
  }
}

// At a friction of 0.8 it does not get up two wheel diameters, at 1.0 not two and a half.
TEST(Step, FailsOnHigherSteps) {
  EXPECT_NE(TryStep(0.26, 0.8), Climb::kUp);
  EXPECT_NE(TryStep(0.325, 1.0), Climb::kUp);
}

TEST(Step, FailsWithoutFrictionOrTorque) {
  EXPECT_EQ(TryStep(0.13, 0.2), Climb::kStuck);
  RoverParams weak{.drive = {.stall_torque_Nm = 0.5}};
  EXPECT_EQ(TryStep(0.13, 0.8, weak), Climb::kStuck);
}

// One side over a rock: the chassis takes half of that side's pitch.
TEST(Rock, DifferentialHalvesThePitchOfOneSide) {
  const RoverParams params;
  const RoverOn rover(FlatTerrain({MakeRock(0.6, 0.2, 0.0, 0.15, 0.15, 0.1)}), params);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  double max_rad = 0.0;
  for (int i = 0; i < 600; ++i) {
    rover->Step(command);
    const truth::RoverState& s = rover->state();
    EXPECT_NEAR(s.left_rocker_rad + s.right_rocker_rad, 0.0, math::DegToRad(0.5));
    const double roll = std::atan2(s.X_WR.linear()(2, 1), s.X_WR.linear()(2, 2));
    const double chassis = Pitch(s.X_WR);
    // Where the right side stands level, its rocker takes back what the chassis leans.
    EXPECT_NEAR(chassis + s.right_rocker_rad, 0.0, math::DegToRad(1.5) + 0.1 * std::abs(roll));
    max_rad = std::max(max_rad, std::abs(s.left_rocker_rad));
  }
  EXPECT_GT(max_rad, math::DegToRad(2.0));
}

using truth::BodyPart;

// What the rover feels while it drives straight ahead for a while.
struct Story {
  truth::RoverState end;
  std::array<double, 5> largest_force_N{};      // by BodyPart
  std::array<double, 5> largest_sliding_m_s{};  // where it scrapes
  double max_turn_rad = 0.0;

  double Force_N(BodyPart part) const { return largest_force_N[static_cast<std::size_t>(part)]; }
  double Sliding_m_s(BodyPart part) const {
    return largest_sliding_m_s[static_cast<std::size_t>(part)];
  }
};

Story DriveAhead(const terrain::Terrain& terrain, double time_s, const RoverParams& params = {},
                 const math::Pose2& X_WR = {}) {
  const auto rover = PlacedRover(params, terrain, X_WR);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  Story story;
  for (int i = 0; i < static_cast<int>(60.0 * time_s); ++i) {
    rover->Step(command);
    for (const truth::BodyContact& contact : rover->state().contacts) {
      const auto part = static_cast<std::size_t>(contact.part);
      story.largest_force_N[part] = std::max(story.largest_force_N[part], contact.normal_force_N);
      story.largest_sliding_m_s[part] =
          std::max(story.largest_sliding_m_s[part], contact.sliding_speed_m_s);
    }
    const double turn_rad = math::WrapAngle(math::Heading(rover->state().X_WR) - X_WR.heading_rad);
    story.max_turn_rad = std::max(story.max_turn_rad, std::abs(turn_rad));
  }
  story.end = rover->state();
  return story;
}

// Beside the belly, in front of the arm of the left rear wheel: lower than the knee of the front
// arm, as high as the hubs, too narrow for the wheels to meet it.
TEST(Rock, BetweenBellyAndWheelIsScrapedByHubAndArm) {
  const RoverGeometryParams size;
  const Story story =
      DriveAhead(FlatTerrain({MakeRock(0.7, size.arm_y_m - 0.01, 0.0, 0.03, 0.012, 0.09)}), 8.0);
  EXPECT_GT(story.Force_N(BodyPart::kHub), 1.0);
  EXPECT_GT(story.Sliding_m_s(BodyPart::kHub), 0.02);
}

// Tall, beyond the outer wheels' path but inside the panel's: the panel's front edge meets it.
TEST(Rock, TallOneStopsThePanelEdge) {
  // Leans over the wheels: widest at the height of the panel.
  const Story story = DriveAhead(FlatTerrain({MakeRock(0.75, 0.0, 0.29, 0.2, 0.2, 0.12)}), 8.0);
  EXPECT_GT(story.Force_N(BodyPart::kPanelEdge), 20.0);
  EXPECT_LT(story.end.X_WR.translation().x(), 0.35);
  EXPECT_LT(story.end.v_WR_m_s.norm(), 0.01);
}

// A wheel that rubs along a steep rock turns the rover away from it.
TEST(Rock, GlancingBlowDeflects) {
  const Story story = DriveAhead(FlatTerrain({MakeRock(0.8, 0.35, 0.0, 0.15, 0.15, 0.4)}), 6.0);
  EXPECT_GT(story.max_turn_rad, math::DegToRad(2.0));
}

// The same at both levels of fidelity.
class RockAtEachFidelity : public testing::TestWithParam<Fidelity> {
 protected:
  RockAtEachFidelity() { params_.fidelity = GetParam(); }
  RoverParams params_;
};

TEST_P(RockAtEachFidelity, LowerThanTheBellyPassesBetweenTheWheels) {
  const RoverOn rover(FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.1, 0.1, 0.12)}), params_);
  const messages::WheelCommand command = Drive(params_, 0.15, 0.0);
  for (double time_s = 0.0; time_s < 10.0; time_s += rover->step_s()) {
    rover->Step(command);
    EXPECT_TRUE(rover->state().contacts.empty());
  }
  EXPECT_GT(rover->state().X_WR.translation().x(), 1.3);
}

TEST_P(RockAtEachFidelity, TallerThanTheBellyBlocksItUntilItBacksOff) {
  const RoverOn rover(FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.12, 0.12, 0.2)}), params_);
  RunFor(*rover, Drive(params_, 0.15, 0.0), 10.0);
  const truth::RoverState& state = rover->state();
  EXPECT_LT(state.X_WR.translation().x(), 0.5);
  ASSERT_EQ(state.contacts.size(), 1U);
  EXPECT_EQ(state.contacts[0].part, BodyPart::kBelly);
  EXPECT_EQ(state.contacts[0].rock, 0);
  EXPECT_GT(state.contacts[0].normal_force_N, 50.0);
  const double blocked_x = state.X_WR.translation().x();
  RunFor(*rover, Drive(params_, -0.15, 0.0), 1.0);
  EXPECT_LT(rover->state().X_WR.translation().x(), blocked_x - 0.1);
}

// What contact switches go by: the place on the rover, here the front edge of the belly, wherever
// in the world the rover is and whichever way it faces.
TEST_P(RockAtEachFidelity, ContactIsPlacedInTheRoversFrame) {
  const double heading_rad = 2.0;
  const math::Vector3 ahead(std::cos(heading_rad), std::sin(heading_rad), 0.0);
  const math::Vector3 rock = math::Vector3(3.0, -1.0, 0.0) + 0.6 * ahead;
  const terrain::Terrain terrain =
      FlatTerrain({MakeRock(rock.x(), rock.y(), 0.0, 0.12, 0.12, 0.2)});
  const auto rover = PlacedRover(params_, terrain, {3.0, -1.0, heading_rad});
  RunFor(*rover, Drive(params_, 0.15, 0.0), 6.0);
  const truth::RoverState& state = rover->state();
  ASSERT_EQ(state.contacts.size(), 1U);
  ASSERT_EQ(state.contacts[0].part, BodyPart::kBelly);
  const math::Vector3& p_R = state.contacts[0].p_RoC_R;
  EXPECT_NEAR(p_R.x(), 0.5 * params_.geometry.belly_length_m, 0.012);  // its rounding is 0.01
  EXPECT_NEAR(p_R.y(), 0.0, 0.02);
  EXPECT_NEAR(p_R.z(), params_.geometry.belly_clearance_m, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Fidelity, RockAtEachFidelity,
                         testing::Values(Fidelity::kMultibody, Fidelity::kQuasiStatic));

TEST_P(RockAtEachFidelity, UnderTheBellyScrapesAndLiftsIt) {
  const RoverOn rover(FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.12, 0.08, 0.137)}), params_);
  const messages::WheelCommand command = Drive(params_, 0.15, 0.0);
  bool scraped = false;
  for (double time_s = 0.0; time_s < 7.0; time_s += rover->step_s()) {
    rover->Step(command);
    for (const truth::BodyContact& contact : rover->state().contacts) {
      scraped |= contact.part == BodyPart::kBelly && contact.sliding_speed_m_s > 0.05;
    }
  }
  EXPECT_TRUE(scraped);
}

// High-centred: the belly rests on a rock, the wheels hang or slip, and it does not get off.
TEST_P(RockAtEachFidelity, HighCentresTheRoverPlacedOnIt) {
  const RoverOn rover(FlatTerrain({MakeRock(0.0, 0.0, 0.0, 0.2, 0.16, 0.18)}), params_);
  RunFor(*rover, Drive(params_, 0.15, 0.0), 10.0);
  const truth::RoverState& state = rover->state();
  const auto belly =
      std::find_if(state.contacts.begin(), state.contacts.end(),
                   [](const truth::BodyContact& c) { return c.part == BodyPart::kBelly; });
  ASSERT_NE(belly, state.contacts.end());
  EXPECT_GT(belly->normal_force_N, 0.5 * Weights(params_).total_N);
  EXPECT_GT(belly->lift_share, 0.9);
  EXPECT_LT(state.X_WR.translation().head<2>().norm(), 0.1);
  EXPECT_GT(state.wheel_angle_rad[1], 20.0);
}

// Between two steep rocks nearer to each other than the rover is wide. At the default friction the
// wheels climb the wedge.
TEST_P(RockAtEachFidelity, TwoOfThemJamTheRover) {
  params_.contact.wheel_rock_friction = 0.3;
  const RoverOn rover(FlatTerrain({MakeRock(0.7, 0.33, 0.0, 0.15, 0.15, 0.5),
                                   MakeRock(0.7, -0.33, 0.0, 0.15, 0.15, 0.5)}),
                      params_);
  RunFor(*rover, Drive(params_, 0.15, 0.0), 10.0);
  EXPECT_LT(rover->state().X_WR.translation().x(), 0.5);
  EXPECT_LT(rover->state().v_WR_m_s.norm(), 0.01);
}

// Wheels turned as far as they go stick out beyond the panel.
TEST(Wall, PushesTurnedWheelsAway) {
  const RoverParams params;
  const RoverGeometryParams& size = params.geometry;
  const double turn = params.drive.max_steer_rad;
  const double wheel_y_m = 0.5 * (size.width_m - size.wheel_width_m);
  const double wall_y_m = 0.5 * size.width_m + 0.01;
  // The rounded edge of the wheel ends somewhat short of its corner.
  const double corner_y_m =
      wheel_y_m + size.wheel_radius_m * std::sin(turn) + 0.5 * size.wheel_width_m * std::cos(turn);
  ASSERT_GT(corner_y_m, wall_y_m + 0.015);
  messages::WheelCommand command;
  command.steer_rad.fill(turn);
  for (const bool walled : {false, true}) {
    std::vector<terrain::Wall> walls;
    if (walled) walls.push_back({math::Vector3::UnitY(), wall_y_m});
    const RoverOn rover(FlatTerrain({}, std::move(walls)), params);
    RunFor(*rover, command, 3.0);
    const double y_m = rover->state().X_WR.translation().y();
    if (walled) {
      EXPECT_LT(y_m, -0.01);
      EXPECT_GT(y_m, wall_y_m - corner_y_m - 0.001);
    } else {
      EXPECT_NEAR(y_m, 0.0, 1e-4);
    }
  }
}

TEST_P(RockAtEachFidelity, AWallStopsThePanel) {
  const RoverOn rover(FlatTerrain({}, {{math::Vector3::UnitX(), 0.8}}), params_);
  RunFor(*rover, Drive(params_, 0.15, 0.0), 6.0);
  EXPECT_NEAR(rover->state().X_WR.translation().x(), 0.8 - 0.5 * params_.geometry.length_m, 0.01);
  ASSERT_FALSE(rover->state().contacts.empty());
  EXPECT_EQ(rover->state().contacts[0].part, BodyPart::kPanelEdge);
  EXPECT_EQ(rover->state().contacts[0].rock, -1);
}

// A ditch across the way, with both fidelities.

// What happened to a rover that drove ahead for a while across a ditch whose middle lies at x = 1.
struct Crossing {
  double x_m = 0.0;  // at the end
  double z_m = 0.0;
  double nose_down_rad = 0.0;  // largest pitches
  double nose_up_rad = 0.0;
  double lowest_m = 0.0;  // of R's origin
};

Crossing DriveAcross(Fidelity fidelity, double width_m, double depth_m, double flank_m) {
  const RoverParams params = WithFidelity(fidelity);
  terrain::GroundParams ground{.soil = RigidGround(0.8)};
  ground.ditches = {.x_m = {1.0},
                    .y_m = {0.0},
                    .direction_deg = {90.0},
                    .length_m = {0.0},
                    .width_m = {width_m},
                    .depth_m = {depth_m},
                    .flank_m = {flank_m}};
  const RoverOn rover(terrain::Terrain(terrain::Ground(ground, {}), {}, {}), params);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  Crossing crossing;
  for (int i = 0; i < 1200; ++i) {  // 20 s
    rover->Step(command);
    const math::Transform& X_WR = rover->state().X_WR;
    // The x axis points up where the nose does.
    const double pitch_rad = std::asin(std::clamp(X_WR.linear()(2, 0), -1.0, 1.0));
    crossing.nose_up_rad = std::max(crossing.nose_up_rad, pitch_rad);
    crossing.nose_down_rad = std::max(crossing.nose_down_rad, -pitch_rad);
    crossing.lowest_m = std::min(crossing.lowest_m, X_WR.translation().z());
  }
  crossing.x_m = rover->state().X_WR.translation().x();
  crossing.z_m = rover->state().X_WR.translation().z();
  return crossing;
}

class Ditch : public testing::TestWithParam<Fidelity> {};
INSTANTIATE_TEST_SUITE_P(Fidelities, Ditch,
                         testing::Values(Fidelity::kMultibody, Fidelity::kQuasiStatic));

TEST_P(Ditch, AShallowOneIsCrossedNoseDownAndUp) {
  const Crossing crossing = DriveAcross(GetParam(), 0.8, 0.1, 0.4);
  EXPECT_GT(crossing.x_m, 2.3);
  EXPECT_NEAR(crossing.z_m, 0.0, 0.005);
  EXPECT_GT(crossing.nose_down_rad, 0.05);
  EXPECT_GT(crossing.nose_up_rad, 0.05);
  EXPECT_LT(crossing.lowest_m, -0.03);
  EXPECT_GT(crossing.lowest_m, -0.1);
}

TEST_P(Ditch, ADeepOneTrapsTheRover) {
  const Crossing crossing = DriveAcross(GetParam(), 0.5, 0.4, 0.15);
  EXPECT_LT(crossing.x_m, 1.4);
  EXPECT_GT(crossing.nose_down_rad, 0.05);
}

// Narrower than a wheel, 13 cm: the rim rests on both edges and sinks by no more than its sagitta
// over 6 cm, R - sqrt(R^2 - 3^2) = 0.7 cm.
TEST_P(Ditch, ACrackIsDrivenOver) {
  const Crossing crossing = DriveAcross(GetParam(), 0.06, 0.2, 0.03);
  EXPECT_GT(crossing.x_m, 2.6);
  EXPECT_GT(crossing.lowest_m, -0.02);
}

// A thin wheel of 10 cm over the middle of a ditch narrower than itself touches both flanks, the
// one behind first, where steps of 0.01 mrad around its rim find the least heights.
TEST(GroundTouchesTest, LieOnBothFlanksWhereTheRimIsNearest) {
  constexpr double kRadius_m = 0.1;
  terrain::GroundParams params{.ditches = {.x_m = {1.0},
                                           .y_m = {0.0},
                                           .direction_deg = {90.0},
                                           .length_m = {0.0},
                                           .width_m = {0.14},
                                           .depth_m = {0.2},
                                           .flank_m = {0.07}}};
  const terrain::Ground ground(params, {});
  const math::Vector3 center_W(1.0, 0.0, 0.08);
  const auto support = [&](const math::Vector3& n_W) -> math::Vector3 {
    return center_W - kRadius_m * n_W;
  };
  const GroundTouches found =
      FindGroundTouches(ground, center_W, math::Vector3::UnitY(), kRadius_m, support);
  ASSERT_EQ(found.count, 2u);
  double least_m = 1.0;
  for (double angle_rad = 0.0; angle_rad < 1.4; angle_rad += 1e-5) {
    const math::Vector3 p_W = support({std::sin(angle_rad), 0.0, std::cos(angle_rad)});
    least_m = std::min(least_m, p_W.z() - ground.Height(p_W.x(), p_W.y()));
  }
  for (const GroundTouch& touch : found.touches) {
    EXPECT_NEAR(touch.gap_m / touch.n_W.z(), least_m, 1e-8);
  }
  EXPECT_LT(found.touches[0].p_W.x(), 0.97);
  EXPECT_GT(found.touches[1].p_W.x(), 1.03);
  EXPECT_GT(found.touches[0].n_W.x(), 0.3);  // away from the flank behind
}

}  // namespace
}  // namespace rockyard::rover
