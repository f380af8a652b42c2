// Attitude and height against the poses that they describe.
#include <gtest/gtest.h>

#include <cmath>

#include "localization/dead_reckoning.h"

namespace rockyard::localization {
namespace {

using math::DegToRad;
using math::Vector3;

constexpr double kTick_s = 0.1;

AttitudeParams Unfiltered() { return AttitudeParams{.filter_s = 0.0}; }

// What accelerometers of a rover at rest feel, in any gravity.
messages::VehicleState AtRest(const math::Transform& X_WR, double gravity_m_s2 = 3.72) {
  messages::VehicleState state;
  state.specific_force_R = X_WR.linear().transpose() * Vector3(0.0, 0.0, gravity_m_s2);
  return state;
}

messages::AttitudeEstimate EstimateOf(const messages::VehicleState& state) {
  AttitudeEstimator estimator(Unfiltered());
  estimator.Integrate(state, 0.0, kTick_s);
  return estimator.estimate();
}

TEST(AttitudeTest, IsThatOfMakePose) {
  for (const double heading : {-2.0, 0.0, 1.0}) {
    for (const double pitch : {-0.5, -0.1, 0.0, 0.3}) {
      for (const double roll : {-0.4, 0.0, 0.2, 0.6}) {
        const math::Transform X_WR = math::MakePose({1.0, 2.0, 3.0}, heading, pitch, roll);
        const messages::AttitudeEstimate estimate = EstimateOf(AtRest(X_WR));
        EXPECT_NEAR(estimate.pitch_rad, pitch, 1e-12);
        EXPECT_NEAR(estimate.roll_rad, roll, 1e-12);
      }
    }
  }
}

TEST(AttitudeTest, PitchIsPositiveWithTheNoseDownAndRollWithTheLeftSideUp) {
  const math::Transform X_WR = math::MakePose(Vector3::Zero(), 0.7, 0.2, 0.0);
  EXPECT_LT((X_WR.linear() * Vector3::UnitX()).z(), 0.0);
  EXPECT_GT(EstimateOf(AtRest(X_WR)).pitch_rad, 0.1);
  const math::Transform X_WL = math::MakePose(Vector3::Zero(), 0.7, 0.0, 0.2);
  EXPECT_GT((X_WL.linear() * Vector3::UnitY()).z(), 0.0);
  EXPECT_GT(EstimateOf(AtRest(X_WL)).roll_rad, 0.1);
}

TEST(AttitudeTest, ForwardAccelerationLooksLikeANoseThatIsUp) {
  // atan(a / g).
  messages::VehicleState state = AtRest(math::Transform::Identity(), 9.81);
  state.specific_force_R->x() += 1.0;
  EXPECT_NEAR(EstimateOf(state).pitch_rad, -std::atan(1.0 / 9.81), 1e-12);
}

TEST(AttitudeTest, HeightGrowsByTheSineOfTheClimb) {
  AttitudeEstimator estimator(Unfiltered());
  const math::Transform uphill = math::MakePose(Vector3::Zero(), 0.0, DegToRad(-10.0), 0.1);
  for (int tick = 0; tick < 100; ++tick) estimator.Integrate(AtRest(uphill), 0.02, kTick_s);
  EXPECT_NEAR(estimator.estimate().z_m, 2.0 * std::sin(DegToRad(10.0)), 1e-12);
  for (int tick = 0; tick < 100; ++tick) estimator.Integrate(AtRest(uphill), -0.01, kTick_s);
  EXPECT_NEAR(estimator.estimate().z_m, std::sin(DegToRad(10.0)), 1e-12);
}

TEST(AttitudeTest, LowPassFollowsAStepExponentially) {
  // Of a step between two attitudes n ticks ago, exp(-n dt / tau) of the old force is left.
  AttitudeParams params{.filter_s = 0.5};
  AttitudeEstimator estimator(params);
  const math::Transform level = math::Transform::Identity();
  const math::Transform down = math::MakePose(Vector3::Zero(), 0.0, 0.3, 0.0);
  estimator.Integrate(AtRest(level, 1.0), 0.0, kTick_s);
  EXPECT_EQ(estimator.estimate().pitch_rad, 0.0);
  for (int n = 1; n <= 20; ++n) {
    estimator.Integrate(AtRest(down, 1.0), 0.0, kTick_s);
    const double left = std::exp(-n * kTick_s / 0.5);
    const double x = (1.0 - left) * std::sin(0.3);
    const double z = left + (1.0 - left) * std::cos(0.3);
    EXPECT_NEAR(estimator.estimate().pitch_rad, std::atan2(x, z), 1e-12);
  }
  estimator.Restart();
  estimator.Integrate(AtRest(level, 1.0), 0.0, kTick_s);
  EXPECT_EQ(estimator.estimate().pitch_rad, 0.0);
}

TEST(AttitudeTest, IsLevelWithoutAccelerometersAndWhereItIsToldSo) {
  const math::Transform X_WR = math::MakePose(Vector3::Zero(), 0.0, 0.3, 0.2);
  AttitudeEstimator blind(Unfiltered());
  blind.Integrate({}, 1.0, kTick_s);
  AttitudeParams params{.source = AttitudeSource::kLevel};
  AttitudeEstimator told(params);
  told.Integrate(AtRest(X_WR), 1.0, kTick_s);
  for (const auto& estimate : {blind.estimate(), told.estimate()}) {
    EXPECT_EQ(estimate.roll_rad, 0.0);
    EXPECT_EQ(estimate.pitch_rad, 0.0);
    EXPECT_EQ(estimate.z_m, 0.0);
  }
  params = Unfiltered();
  params.height = HeightSource::kLevel;
  AttitudeEstimator flat(params);
  flat.Integrate(AtRest(X_WR), 1.0, kTick_s);
  EXPECT_NEAR(flat.estimate().pitch_rad, 0.3, 1e-12);
  EXPECT_EQ(flat.estimate().z_m, 0.0);
}

TEST(AttitudeTest, AFallTellsNothing) {
  messages::VehicleState falling;
  falling.specific_force_R = Vector3::Zero();
  EXPECT_EQ(EstimateOf(falling).pitch_rad, 0.0);
  EXPECT_EQ(EstimateOf(falling).roll_rad, 0.0);
}

TEST(AttitudeTest, ForwardStepHasTheSignOfTheDrive) {
  const messages::PoseEstimate before{.x_m = 1.0, .y_m = 2.0, .heading_rad = 2.0};
  messages::PoseEstimate after = before;
  after.x_m += 0.3 * std::cos(2.1);
  after.y_m += 0.3 * std::sin(2.1);
  after.heading_rad = 2.2;
  EXPECT_NEAR(ForwardStep(before, after), 0.3, 1e-12);
  EXPECT_NEAR(ForwardStep(after, before), -0.3, 1e-12);
}

}  // namespace
}  // namespace rockyard::localization
