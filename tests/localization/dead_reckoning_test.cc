// Dead reckoning: the pose from wheels and gyro, attitude and height against the poses that they
// describe.
#include "localization/dead_reckoning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "localization/filter_rover.h"

namespace rockyard::localization {
namespace {

using math::DegToRad;
using math::Vector3;
using messages::MotionMeasurement;

messages::DriveCalibration Calibration() {
  return messages::DriveCalibration{.wheel_radius_m = kWheelRadius_m,
                                    .steered = {true, false, true, true, false, true}};
}

MotionMeasurement Straight(double distance_m, double turn_rad = 0.0) {
  return Rolled(distance_m, turn_rad, 0.1);
}

DeadReckoning Make(const DeadReckoningParams& params = {}, const math::Pose2& initial = {}) {
  return {Calibration(), params, initial};
}

TEST(DeadReckoningTest, StraightAlongTheHeading) {
  auto dead_reckoning = Make({}, {1.0, 2.0, 0.5});
  dead_reckoning.Integrate(Straight(2.0));
  EXPECT_NEAR(dead_reckoning.estimate().x_m, 1.0 + 2.0 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(dead_reckoning.estimate().y_m, 2.0 + 2.0 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(dead_reckoning.estimate().heading_rad, 0.5, 1e-15);
  EXPECT_NEAR(dead_reckoning.estimate().distance_m, 2.0, 1e-12);
}

TEST(DeadReckoningTest, BackwardMotionAddsToTheOdometer) {
  auto dead_reckoning = Make();
  dead_reckoning.Integrate(Straight(1.0));
  dead_reckoning.Integrate(Straight(-1.0));
  EXPECT_NEAR(dead_reckoning.estimate().x_m, 0.0, 1e-12);
  EXPECT_NEAR(dead_reckoning.estimate().distance_m, 2.0, 1e-12);
}

TEST(DeadReckoningTest, TurnInPlaceMovesNothing) {
  auto dead_reckoning = Make();
  dead_reckoning.Integrate({.wheel_turn_rad = {-2.0, -1.5, -2.0, 2.0, 1.5, 2.0}, .turn_rad = 0.3});
  EXPECT_EQ(dead_reckoning.estimate().x_m, 0.0);
  EXPECT_EQ(dead_reckoning.estimate().distance_m, 0.0);
  EXPECT_DOUBLE_EQ(dead_reckoning.estimate().heading_rad, 0.3);
}

TEST(DeadReckoningTest, CalibratedScaleAndRadius) {
  auto dead_reckoning = Make({.distance_scale = 0.95});
  dead_reckoning.Integrate(Straight(1.0));
  EXPECT_NEAR(dead_reckoning.estimate().x_m, 0.95, 1e-12);
}

// A circle in n steps closes exactly with the midpoint rule, and misses by a step's second order
// with the equations of section 5 as printed.
double ClosingError(StepHeading rule, int steps) {
  auto dead_reckoning = Make({.step_heading = rule});
  // A quarter of a circle of radius 1 m ends at (1, 1).
  for (int i = 0; i < steps; ++i) {
    const double turn = 0.5 * std::numbers::pi / steps;
    dead_reckoning.Integrate(Straight(turn, turn));
  }
  return std::hypot(dead_reckoning.estimate().x_m - 1.0, dead_reckoning.estimate().y_m - 1.0);
}

TEST(DeadReckoningTest, OrderOfTheIntegrationRules) {
  EXPECT_NEAR(ClosingError(StepHeading::kMidpoint, 50) / ClosingError(StepHeading::kMidpoint, 100),
              4.0, 0.05);
  EXPECT_NEAR(ClosingError(StepHeading::kStart, 50) / ClosingError(StepHeading::kStart, 100), 2.0,
              0.05);
}

TEST(DeadReckoningTest, CornerWheelsLengthenArcs) {
  // Arc of radius 0.75 m to the left; wheels at x = +-0.25 and 0, y = +-0.2.
  const double turn = 0.1;
  const auto path = [&](double x, double y) { return std::hypot(0.75 - y, x) * turn; };
  MotionMeasurement motion{.wheel_turn_rad = {path(0.25, 0.2), path(0.0, 0.2), path(-0.25, 0.2),
                                              path(0.25, -0.2), path(0.0, -0.2), path(-0.25, -0.2)},
                           .turn_rad = turn};
  for (double& rad : motion.wheel_turn_rad) rad /= kWheelRadius_m;
  auto all = Make();
  all.Integrate(motion);
  EXPECT_NEAR(all.estimate().distance_m / (0.75 * turn), 1.038, 0.001);
  auto middle = Make({.wheels = OdometryWheels::kUnsteered});
  middle.Integrate(motion);
  EXPECT_NEAR(middle.estimate().distance_m, 0.75 * turn, 1e-12);
}

// Six wheels at x = +-half_length and 0, y = +-half_track roll about (0, R), and steer for it.
MotionMeasurement SteeredWheels(double half_length_m, double half_track_m, double radius_m,
                                double turn_rad) {
  MotionMeasurement motion{.turn_rad = turn_rad};
  const double x_m[] = {half_length_m, 0.0, -half_length_m, half_length_m, 0.0, -half_length_m};
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    const double y_m = wheel < 3 ? half_track_m : -half_track_m;
    const double ahead_m = radius_m - y_m;
    const double sign = ahead_m < 0.0 ? -1.0 : 1.0;  // a wheel rolls backwards beyond the centre
    motion.steer_rad[wheel] = std::atan2(sign * x_m[wheel], sign * ahead_m);
    motion.wheel_turn_rad[wheel] =
        sign * std::hypot(ahead_m, x_m[wheel]) * turn_rad / kWheelRadius_m;
  }
  return motion;
}

// What an odometer reads too much on an arc, in per cent, with the wheels of Rocky 3.2.
double OverCountPercent(OdometryWheels wheels, double radius_m) {
  constexpr double kTurn_rad = 0.01;
  auto dead_reckoning = Make({.wheels = wheels});
  dead_reckoning.Integrate(SteeredWheels(0.26, 0.20, radius_m, kTurn_rad));
  return 100.0 * (dead_reckoning.estimate().distance_m / (radius_m * kTurn_rad) - 1.0);
}

// By hand: the mean of hypot(0.26, R +- 0.20) twice and of R +- 0.20 once, over R.
TEST(DeadReckoningTest, OverCountOnTheArcsOfRocky32) {
  for (const auto& [radius_m, percent] :
       {std::pair{3.0, 0.25}, {1.5, 1.01}, {1.0, 2.30}, {0.75, 4.15}, {0.5, 9.58}}) {
    EXPECT_NEAR(OverCountPercent(OdometryWheels::kAll, radius_m), percent, 0.005) << radius_m;
    EXPECT_NEAR(OverCountPercent(OdometryWheels::kForward, radius_m), 0.0, 1e-9);
    EXPECT_NEAR(OverCountPercent(OdometryWheels::kUnsteered, radius_m), 0.0, 1e-9);
  }
}

// All six wheels of the Athena SDM.
TEST(DeadReckoningTest, SteeringTakenIntoAccountIsExactOnArcs) {
  const DeadReckoningParams params{.wheels = OdometryWheels::kForward};
  for (const double radius_m : {0.5, 1.0, 4.0}) {
    auto forward = Make(params);
    forward.Integrate(SteeredWheels(0.42, 0.36, radius_m, 0.1));
    EXPECT_NEAR(forward.estimate().distance_m, radius_m * 0.1, 1e-12) << radius_m;
  }
  // The plain mean on the tightest arc: (4 corner wheels, 2 middle ones) over the radius.
  const double corners = std::hypot(0.14, 0.42) + std::hypot(0.86, 0.42);
  auto all = Make();
  all.Integrate(SteeredWheels(0.42, 0.36, 0.5, 0.1));
  EXPECT_NEAR(all.estimate().distance_m / 0.05, (2.0 * corners + 1.0) / 6.0 / 0.5, 1e-9);
  // A turn in place goes nowhere.
  auto turning = Make(params);
  turning.Integrate(SteeredWheels(0.42, 0.36, 0.0, 0.5));
  EXPECT_NEAR(turning.estimate().distance_m, 0.0, 1e-12);
}

TEST(DeadReckoningTest, HeadingsStayWrapped) {
  auto dead_reckoning = Make({}, {0.0, 0.0, 3.0});
  dead_reckoning.Integrate(Straight(0.0, 0.3));
  EXPECT_NEAR(dead_reckoning.estimate().heading_rad, 3.3 - 2.0 * std::numbers::pi, 1e-12);
}

TEST(DeadReckoningTest, UpdatesMoveThePoseAndKeepTheOdometer) {
  auto dead_reckoning = Make();
  dead_reckoning.Integrate(Straight(3.0));
  dead_reckoning.Apply({7.0, 8.0, -0.4});
  EXPECT_EQ(dead_reckoning.estimate().x_m, 7.0);
  EXPECT_EQ(dead_reckoning.estimate().y_m, 8.0);
  EXPECT_EQ(dead_reckoning.estimate().heading_rad, -0.4);
  EXPECT_NEAR(dead_reckoning.estimate().distance_m, 3.0, 1e-12);
}

// Attitude and height against the poses that they describe.

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
  AttitudeEstimator estimator({.filter_s = 0.5});
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
  AttitudeEstimator told({.source = AttitudeSource::kLevel});
  told.Integrate(AtRest(X_WR), 1.0, kTick_s);
  for (const auto& estimate : {blind.estimate(), told.estimate()}) {
    EXPECT_EQ(estimate.roll_rad, 0.0);
    EXPECT_EQ(estimate.pitch_rad, 0.0);
    EXPECT_EQ(estimate.z_m, 0.0);
  }
  AttitudeEstimator flat({.filter_s = 0.0, .height = HeightSource::kLevel});
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
