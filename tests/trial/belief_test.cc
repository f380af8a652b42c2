#include <gtest/gtest.h>

#include "core/random.h"
#include "math/angles.h"
#include "math/pose.h"
#include "sensing/tracker.h"
#include "trial/counters/drive_monitor.h"
#include "trial/drive/make_estimator.h"
#include "trial/drive/operators.h"

namespace rockyard::trial {
namespace {

messages::LocalizationEstimate EstimateWith(double sx, double sy, double sh) {
  messages::LocalizationEstimate estimate;
  estimate.pose = {1.0, 2.0, math::DegToRad(179.0), 0.0};
  estimate.covariance = messages::PoseCovariance::Identity();
  (*estimate.covariance)(0, 0) = sx * sx;
  (*estimate.covariance)(1, 1) = sy * sy;
  (*estimate.covariance)(5, 5) = sh * sh;
  return estimate;
}

TEST(BeliefTest, CountsErrorsInTheirDeviations) {
  const auto belief =
      BeliefOf(EstimateWith(0.3, 0.4, math::DegToRad(2.0)), {1.3, 2.8, math::DegToRad(-179.0)});
  ASSERT_TRUE(belief);
  EXPECT_NEAR(belief->nees, 1.0 + 4.0 + 1.0, 1e-9);
  EXPECT_NEAR(belief->position_sd_m, 0.5, 1e-12);
  EXPECT_NEAR(belief->heading_sd_rad, math::DegToRad(2.0), 1e-12);
  EXPECT_TRUE(belief->inside_95);
}

// 7.815 is the 95 % quantile of chi-squared with 3 degrees of freedom.
TEST(BeliefTest, HoldsTheTruthUpToTheQuantile) {
  const auto inside = [](double deviations) {
    return BeliefOf(EstimateWith(1.0, 1.0, 0.1), {1.0 + deviations, 2.0, math::DegToRad(179.0)})
        ->inside_95;
  };
  EXPECT_TRUE(inside(std::sqrt(7.81)));
  EXPECT_FALSE(inside(std::sqrt(7.82)));
}

TEST(BeliefTest, TakesCorrelationsIntoAccount) {
  auto estimate = EstimateWith(1.0, 1.0, 0.1);
  (*estimate.covariance)(0, 1) = (*estimate.covariance)(1, 0) = 0.9;
  const double along = BeliefOf(estimate, {2.0, 3.0, math::DegToRad(179.0)})->nees;
  const double across = BeliefOf(estimate, {2.0, 1.0, math::DegToRad(179.0)})->nees;
  EXPECT_NEAR(along, 2.0 / 1.9, 1e-9);
  EXPECT_NEAR(across, 2.0 / 0.1, 1e-9);
}

TEST(BeliefTest, IsOfEitherFrameWhereTheRoverTellsThemApart) {
  auto estimate = EstimateWith(1.0, 1.0, 0.1);
  estimate.world = {.pose = {5.0, 6.0, 0.0, 0.0},
                    .covariance = 4.0 * messages::PoseCovariance::Identity()};
  EXPECT_NEAR(BeliefOf(estimate, {7.0, 6.0, 0.0})->nees, 1.0, 1e-12);
  EXPECT_NEAR(GoalFrameBeliefOf(estimate, {3.0, 2.0, math::DegToRad(179.0)})->nees, 4.0, 1e-12);
  EXPECT_EQ(WorldPose(estimate).x_m, 5.0);
  estimate.world.reset();
  EXPECT_EQ(WorldPose(estimate).x_m, 1.0);
  EXPECT_NEAR(BeliefOf(estimate, {3.0, 2.0, math::DegToRad(179.0)})->nees, 4.0, 1e-12);
}

TEST(BeliefTest, IsNothingWithoutACovariance) {
  messages::LocalizationEstimate estimate;
  EXPECT_FALSE(BeliefOf(estimate, {}));
  estimate.covariance = messages::PoseCovariance::Zero();
  EXPECT_FALSE(BeliefOf(estimate, {}));
}

truth::RoverState StateAt(const math::Vector3& p_WoRo_W, double heading_rad, double pitch_rad,
                          double roll_rad) {
  truth::RoverState state;
  state.X_WR = math::MakePose(p_WoRo_W, heading_rad, pitch_rad, roll_rad);
  return state;
}

// A rover that is where a test puts it.
class PlacedRover final : public rover::Rover {
 public:
  void Place(const math::Pose2& pose) override {
    state_ = StateAt({pose.x_m, pose.y_m, 0.0}, pose.heading_rad, 0.0, 0.0);
  }
  void Step(const messages::WheelCommand& /*command*/) override {}
  const truth::RoverState& state() const override { return state_; }
  double step_s() const override { return 0.01; }
  double ramp_s() const override { return 0.0; }

  void Put(const truth::RoverState& state) { state_ = state; }

 private:
  truth::RoverState state_;
};

class OracleTest : public testing::Test {
 protected:
  OracleTest() {
    rover_.Put(StateAt({0.0, 0.0, 0.1}, 0.0, 0.0, 0.0));
    oracle_.See(rover_);
  }

  const messages::LocalizationEstimate& After(const truth::RoverState& state) {
    rover_.Put(state);
    oracle_.Propagate({});
    return oracle_.estimate();
  }

  PlacedRover rover_;
  OracleEstimator oracle_{{}};
};

// MakePose and TrueAttitude are inverse to each other: pitch positive nose down, roll positive left
// side up.
TEST_F(OracleTest, TellsTheAttitudeThatMakesThePose) {
  core::RandomStream stream({1, 0}, core::Purpose::kTest);
  for (int i = 0; i < 1000; ++i) {
    const double heading_rad = 6.0 * (stream.Uniform() - 0.5);
    const double pitch_rad = 2.0 * (stream.Uniform() - 0.5);
    const double roll_rad = 2.0 * (stream.Uniform() - 0.5);
    const auto attitude =
        sensing::TrueAttitude(StateAt({3.0, -2.0, 0.7}, heading_rad, pitch_rad, roll_rad), 0.2);
    EXPECT_NEAR(attitude.pitch_rad, pitch_rad, 1e-12);
    EXPECT_NEAR(attitude.roll_rad, roll_rad, 1e-12);
    EXPECT_NEAR(attitude.z_m, 0.5, 1e-12);
  }
}

TEST_F(OracleTest, FollowsAllSixDegreesOfFreedom) {
  EXPECT_EQ(oracle_.estimate().attitude.z_m, 0.0);
  const auto& estimate = After(StateAt({0.4, 0.3, 0.25}, 0.5, -0.2, 0.1));
  EXPECT_NEAR(estimate.pose.x_m, 0.4, 1e-12);
  EXPECT_NEAR(estimate.pose.y_m, 0.3, 1e-12);
  EXPECT_NEAR(estimate.pose.heading_rad, 0.5, 1e-12);
  EXPECT_NEAR(estimate.odometry.y_m, 0.3, 1e-12);
  EXPECT_NEAR(estimate.attitude.pitch_rad, -0.2, 1e-12);
  EXPECT_NEAR(estimate.attitude.roll_rad, 0.1, 1e-12);
  EXPECT_NEAR(estimate.attitude.z_m, 0.15, 1e-12);
  EXPECT_TRUE(estimate.covariance->isZero());
}

TEST_F(OracleTest, TheOdometerCountsForwardMotion) {
  EXPECT_NEAR(After(StateAt({0.5, 0.0, 0.0}, 0.0, 0.0, 0.0)).pose.distance_m, 0.5, 1e-12);
  // Turns in place, then backs up.
  EXPECT_NEAR(After(StateAt({0.5, 0.0, 0.0}, 1.0, 0.0, 0.0)).pose.distance_m, 0.5, 1e-12);
  const auto back = StateAt({0.5 - std::cos(1.0), -std::sin(1.0), 0.0}, 1.0, 0.0, 0.0);
  EXPECT_NEAR(After(back).pose.distance_m, 1.5, 1e-12);
  EXPECT_NEAR(oracle_.estimate().odometry.distance_m, 1.5, 1e-12);
}

// The odometer keeps; the next tick takes the truth again.
TEST_F(OracleTest, OperatorsTellItWhereItWasPut) {
  After(StateAt({0.5, 0.0, 0.0}, 0.0, 0.0, 0.0));
  oracle_.Place({3.0, -1.0, 0.5});
  EXPECT_EQ(oracle_.estimate().pose.x_m, 3.0);
  EXPECT_EQ(oracle_.estimate().odometry.y_m, -1.0);
  EXPECT_NEAR(oracle_.estimate().pose.distance_m, 0.5, 1e-12);
}

const MirrorArena kArena(1.1);

TEST(MirrorArenaTest, NothingHappensInside) {
  EXPECT_FALSE(kArena.Reflect({3.0, 1.09, 1.0}, +1, {}).has_value());
  EXPECT_FALSE(kArena.Reflect({3.0, -1.09, -1.0}, +1, {}).has_value());
}

TEST(MirrorArenaTest, NothingHappensOnTheWayBackIn) {
  EXPECT_FALSE(kArena.Reflect({3.0, 1.12, -0.1}, +1, {}).has_value());
  EXPECT_FALSE(kArena.Reflect({3.0, -1.12, 0.1}, +1, {}).has_value());
}

TEST(MirrorArenaTest, LeftLineMirrorsHeadingAndEstimate) {
  const auto reflection = kArena.Reflect({3.0, 1.1, 0.4}, +1, {2.9, 1.3, 0.5, 4.0});
  ASSERT_TRUE(reflection.has_value());
  EXPECT_DOUBLE_EQ(reflection->pose.x_m, 3.0);
  EXPECT_DOUBLE_EQ(reflection->pose.y_m, 1.1);
  EXPECT_DOUBLE_EQ(reflection->pose.heading_rad, -0.4);
  EXPECT_DOUBLE_EQ(reflection->update.x_m, 2.9);
  EXPECT_DOUBLE_EQ(reflection->update.y_m, 0.9);
  EXPECT_DOUBLE_EQ(reflection->update.heading_rad, -0.5);
}

// A rover that backs off crosses a line tail first.
TEST(MirrorArenaTest, DrivingBackwardsIsOutwardByTheTail) {
  EXPECT_FALSE(kArena.Reflect({3.0, 1.12, 0.4}, -1, {}).has_value());
  EXPECT_FALSE(kArena.Reflect({3.0, -1.12, -0.4}, -1, {}).has_value());
  const auto left = kArena.Reflect({3.0, 1.12, -0.4}, -1, {});
  ASSERT_TRUE(left.has_value());
  EXPECT_DOUBLE_EQ(left->pose.heading_rad, 0.4);
  EXPECT_DOUBLE_EQ(left->line_m, 1.1);
  const auto right = kArena.Reflect({3.0, -1.12, 0.4}, -1, {});
  ASSERT_TRUE(right.has_value());
  EXPECT_DOUBLE_EQ(right->pose.heading_rad, -0.4);
  EXPECT_DOUBLE_EQ(right->line_m, -1.1);
}

// The reflection turns an error into its mirror image: it neither hides nor adds any.
TEST(MirrorArenaTest, ErrorsKeepTheirSize) {
  const math::Pose2 pose{5.0, -1.15, -0.7};
  const messages::PoseEstimate estimate{5.2, -0.8, -0.9, 6.0};
  const auto reflection = kArena.Reflect(pose, +1, estimate);
  ASSERT_TRUE(reflection.has_value());
  EXPECT_NEAR(reflection->update.x_m - reflection->pose.x_m, estimate.x_m - pose.x_m, 1e-15);
  // The true position lies 5 cm beyond the line and stays there; its mirror image lies 5 cm inside.
  EXPECT_NEAR(reflection->update.y_m - (2.0 * -1.1 - pose.y_m), -(estimate.y_m - pose.y_m), 1e-15);
  EXPECT_NEAR(reflection->update.heading_rad - reflection->pose.heading_rad,
              -(estimate.heading_rad - pose.heading_rad), 1e-15);
}

}  // namespace
}  // namespace rockyard::trial
