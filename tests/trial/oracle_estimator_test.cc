#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/tracker.h"
#include "trial/drive/make_estimator.h"

namespace rockyard::trial {
namespace {

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

}  // namespace
}  // namespace rockyard::trial
