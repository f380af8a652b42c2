#include <gtest/gtest.h>

#include <cmath>

#include "math/angles.h"
#include "trial/counters/drive_monitor.h"

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

}  // namespace
}  // namespace rockyard::trial
