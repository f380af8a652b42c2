#include "localization/error_state_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "localization/dead_reckoning.h"
#include "localization/filter_rover.h"

namespace rockyard::localization {
namespace {

constexpr int kX = error::kX;
constexpr int kY = error::kY;
constexpr int kHeading = error::kHeading;

// A rover whose heading, wheels and gyro are right: its place alone is uncertain.
ErrorStateFilterParams AlongOnly() {
  return ErrorStateFilterParams{
      .prior = {.gyro_scale_sd = 0.0, .wheel_scale_sd = 0.0},
      .drift = {.heading_variance_deg2_per_m = 0.0, .distance_variance_m2_per_m = 0.01}};
}

EstimatorSetup AlongX() {
  EstimatorSetup setup = FilterSetup();
  setup.start = {1.0, -2.0, 0.0};
  return setup;
}

void DriveStraight(Estimator& estimator, double way_m) {
  constexpr double kTick_m = 0.005;
  for (int i = 0; i < std::lround(way_m / kTick_m); ++i) {
    estimator.Propagate(Rolled(kTick_m, 0.0, 0.05));
  }
}

messages::PoseFix FixOf(int coordinate, messages::CaptureNumber capture, double value, double sd) {
  messages::PoseFix fix{.capture = capture, .measured = {}};
  fix.measured.set(static_cast<std::size_t>(coordinate));
  fix.pose[coordinate] = value;
  fix.covariance(coordinate, coordinate) = sd * sd;
  return fix;
}

// From the moment 1 to the moment 2.
messages::RelativeMotion SureMotion(double x_m, double y_m = 0.0, double turn_rad = 0.0) {
  messages::RelativeMotion motion{.from = 1, .to = 2};
  motion.motion_F[kX] = x_m;
  motion.motion_F[kY] = y_m;
  motion.motion_F[kHeading] = turn_rad;
  motion.covariance *= 1e-6;
  return motion;
}

TEST(ErrorStateFilter, IsDeadReckoningWithoutAids) {
  EstimatorSetup setup = FilterSetup();
  ErrorStateFilter filter({}, setup);
  DeadReckoningEstimator flown(setup);
  messages::VehicleState felt;
  for (int i = 0; i < 300; ++i) {
    const auto motion = Rolled(i % 7 == 0 ? -0.004 : 0.0061, 0.01 * std::sin(0.1 * i), 0.05);
    felt.specific_force_R = math::Vector3(0.2 * std::sin(0.05 * i), 0.1, 3.7);
    for (Estimator* estimator :
         {static_cast<Estimator*>(&filter), static_cast<Estimator*>(&flown)}) {
      estimator->Propagate(motion);
      estimator->Feel(felt, 0.05);
    }
  }
  EXPECT_EQ(filter.estimate().pose.x_m, flown.estimate().pose.x_m);
  EXPECT_EQ(filter.estimate().pose.y_m, flown.estimate().pose.y_m);
  EXPECT_EQ(filter.estimate().pose.heading_rad, flown.estimate().pose.heading_rad);
  EXPECT_EQ(filter.estimate().pose.distance_m, flown.estimate().pose.distance_m);
  EXPECT_EQ(filter.estimate().odometry.x_m, flown.estimate().odometry.x_m);
  EXPECT_EQ(filter.estimate().attitude.pitch_rad, flown.estimate().attitude.pitch_rad);
  EXPECT_EQ(filter.estimate().attitude.z_m, flown.estimate().attitude.z_m);
  EXPECT_FALSE(flown.estimate().covariance.has_value());
  ASSERT_TRUE(filter.estimate().covariance.has_value());
}

// q = 0.01 m2 a metre along x; a fix of sd 0.02 m after 0.5 m that arrives after 0.7 m.
TEST(ErrorStateFilter, TakesALateFixForWhatItWasWorthWhenItWasTaken) {
  ErrorStateFilter late(AlongOnly(), AlongX());
  ErrorStateFilter at_once(AlongOnly(), AlongX());
  DriveStraight(late, 0.5);
  DriveStraight(at_once, 0.5);
  late.Capture(1);
  at_once.Capture(1);
  EXPECT_EQ(at_once.Update(FixOf(kX, 1, 1.53, 0.02)), AidUse::kUsed);
  DriveStraight(late, 0.2);
  DriveStraight(at_once, 0.2);
  EXPECT_NEAR(late.estimate().pose.x_m, 1.7, 1e-9);
  EXPECT_EQ(late.Update(FixOf(kX, 1, 1.53, 0.02)), AidUse::kUsed);
  late.Forget(1);
  const double P1 = 0.01 * 0.5;
  const double gain = P1 / (P1 + 0.0004);
  EXPECT_NEAR(late.estimate().pose.x_m, 1.7 + gain * 0.03, 1e-9);
  EXPECT_NEAR(late.covariance()(kX, kX), 0.01 * 0.7 - gain * P1, 1e-9);
  EXPECT_NEAR(late.estimate().pose.x_m, at_once.estimate().pose.x_m, 1e-9);
  // The odometry frame never jumps.
  EXPECT_NEAR(late.estimate().odometry.x_m, 1.7, 1e-9);
  EXPECT_EQ(late.Update(FixOf(kX, 1, 1.53, 0.02)), AidUse::kUnknown);
}

// A measured motion of 0.2 m between two captured moments, 3 cm longer than believed.
TEST(ErrorStateFilter, TakesAMotionBetweenTwoMoments) {
  EstimatorSetup setup = FilterSetup();
  setup.start.heading_rad = math::DegToRad(90.0);
  ErrorStateFilter filter(AlongOnly(), setup);
  DriveStraight(filter, 0.5);
  filter.Capture(1);
  DriveStraight(filter, 0.2);
  filter.Capture(2);
  DriveStraight(filter, 0.3);
  messages::RelativeMotion motion{.from = 1, .to = 2};
  motion.motion_F[kX] = 0.23;  // along its own heading
  motion.covariance *= 1e6;    // says nothing but of x
  motion.covariance(kX, kX) = 0.0004;
  EXPECT_EQ(filter.Update(motion), AidUse::kUsed);
  const double d = 0.01 * 0.2;
  const double gain = d / (d + 0.0004);
  EXPECT_NEAR(filter.estimate().pose.y_m, -2.0 + 1.0 + gain * 0.03, 1e-6);
  EXPECT_NEAR(filter.covariance()(kY, kY), 0.01 * 1.0 - gain * d, 1e-6);
  filter.Forget(1);
  EXPECT_EQ(filter.Update(motion), AidUse::kUnknown);
}

// A gyro that jumps by 0.5 rad between two moments, where the filter knows of hardly any noise.
class MotionAgainstWheels : public testing::Test {
 protected:
  static ErrorStateFilterParams Params(MotionDisagreement disagreement) {
    ErrorStateFilterParams params = AlongOnly();
    params.motion_disagreement = disagreement;
    return params;
  }

  static void DriveAndJump(ErrorStateFilter& filter) {
    DriveStraight(filter, 0.5);
    filter.Capture(1);
    filter.Propagate(Rolled(0.0, 0.5, 0.05));
    DriveStraight(filter, 0.4);
    filter.Capture(2);
    DriveStraight(filter, 0.1);
  }

  // It drove straight on, in truth.
  static messages::RelativeMotion Straight() { return SureMotion(0.4); }
};

TEST_F(MotionAgainstWheels, DoubtsTheWheels) {
  ErrorStateFilter filter(Params(MotionDisagreement::kDoubtWheels), AlongX());
  DriveAndJump(filter);
  EXPECT_NEAR(filter.estimate().pose.heading_rad, 0.5, 1e-9);
  EXPECT_EQ(filter.Update(Straight()), AidUse::kUsedInDoubt);
  EXPECT_NEAR(filter.estimate().pose.heading_rad, 0.0, 1e-3);
  EXPECT_NEAR(filter.estimate().pose.y_m, -2.0, 5e-3);
  // The tenth of a metre since then was laid off along a heading that is linear in its error.
  EXPECT_NEAR(filter.estimate().pose.x_m, 2.0, 2e-2);
  // Told once more it is no news.
  EXPECT_EQ(filter.Update(Straight()), AidUse::kUsed);
}

TEST_F(MotionAgainstWheels, OrTurnsTheMotionAway) {
  ErrorStateFilter filter(Params(MotionDisagreement::kTurnAway), AlongX());
  DriveAndJump(filter);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(filter.Update(Straight()), AidUse::kGatedOut);
  EXPECT_NEAR(filter.estimate().pose.heading_rad, 0.5, 1e-9);
}

// Motions say nothing of the place, so that they do not keep fixes from being heard.
TEST_F(MotionAgainstWheels, DoesNotInterruptTheWayBackOfFixes) {
  ErrorStateFilterParams params = Params(MotionDisagreement::kDoubtWheels);
  params.gate.patience = 2;
  ErrorStateFilter filter(params, AlongX());
  DriveAndJump(filter);
  EXPECT_EQ(filter.Update(FixOf(kX, 2, 9.0, 0.01)), AidUse::kGatedOut);
  EXPECT_EQ(filter.Update(Straight()), AidUse::kUsedInDoubt);
  EXPECT_EQ(filter.Update(FixOf(kX, 2, 9.0, 0.01)), AidUse::kUsedInDoubt);
}

// A motion whose heading at the first moment was wrong: measured across, it corrects that heading.
TEST(ErrorStateFilter, LearnsTheHeadingFromWhereAMotionLed) {
  ErrorStateFilterParams params = AlongOnly();
  params.drift.distance_variance_m2_per_m = 0.0;
  params.prior.heading_sd_rad = 0.1;
  ErrorStateFilter filter(params, AlongX());
  filter.Capture(1);
  DriveStraight(filter, 2.0);
  filter.Capture(2);
  // A fix of y at the second moment tells that the rover drives 0.05 rad to the left.
  EXPECT_EQ(filter.Update(FixOf(kY, 2, -2.0 + 0.1, 1e-4)), AidUse::kUsed);
  EXPECT_NEAR(filter.estimate().pose.heading_rad, 0.05, 1e-3);
  // In the frame of the first moment it still drove straight ahead, so that this is no news.
  const double before = filter.estimate().pose.y_m;
  EXPECT_EQ(filter.Update(SureMotion(2.0)), AidUse::kUsed);
  EXPECT_NEAR(filter.estimate().pose.y_m, before, 1e-3);
}

// Seen from where it began, a way that turned aside says how long it was, and nothing of the
// heading there: neither its value nor its variance changes.
TEST(ErrorStateFilter, AMotionSaysNothingOfTheHeadingBeforeIt) {
  ErrorStateFilterParams params = AlongOnly();
  params.prior.heading_sd_rad = 0.1;
  ErrorStateFilter filter(params, AlongX());
  filter.Capture(1);
  filter.Propagate(Rolled(0.0, math::DegToRad(45.0), 0.05));
  DriveStraight(filter, 2.0);
  filter.Capture(2);
  const double aside_m = 2.05 * std::sqrt(0.5);
  EXPECT_EQ(filter.Update(SureMotion(aside_m, aside_m, math::DegToRad(45.0))), AidUse::kUsed);
  EXPECT_NEAR(filter.estimate().pose.x_m, 1.0 + aside_m, 1e-3);
  EXPECT_NEAR(filter.estimate().pose.heading_rad, math::DegToRad(45.0), 1e-4);
  EXPECT_NEAR(filter.covariance()(kHeading, kHeading), 0.01, 1e-5);
}

TEST(ErrorStateFilter, LearnsHowItsSensorsAreWrong) {
  ErrorStateFilterParams params{.prior = {.gyro_bias_sd_rad_s = 0.002}};
  ErrorStateFilterParams noiseless = params;
  noiseless.drift.distance_variance_m2_per_m = 0.0;
  noiseless.drift.heading_variance_deg2_per_m = 0.0;
  ErrorStateFilter filter(params, FilterSetup());
  FilterRover rover(noiseless, FilterSetup().start, {7, 0});
  messages::CaptureNumber capture = 0;
  for (int i = 0; i < 8000; ++i) {
    filter.Propagate(rover.Drive(0.005, i / 400 % 2 == 0 ? 0.004 : -0.004, 0.05));
    if (i % 50 != 49) continue;
    filter.Capture(capture);
    for (const auto& [coordinate, value] :
         {std::pair{kX, rover.pose().x_m}, std::pair{kY, rover.pose().y_m},
          std::pair{kHeading, rover.pose().heading_rad}}) {
      EXPECT_EQ(filter.Update(FixOf(coordinate, capture, value, 1e-3)), AidUse::kUsed);
    }
    filter.Forget(capture++);
  }
  EXPECT_GT(std::abs(rover.gyro_scale() - 1.0), 0.01);  // there was something to learn
  EXPECT_NEAR(filter.gyro_scale(), rover.gyro_scale(), 0.01);
  EXPECT_NEAR(filter.wheel_scale(), rover.wheel_scale(), 0.01);
  EXPECT_NEAR(filter.gyro_bias_rad_s(), rover.bias_rad_s(), 5e-4);
  EXPECT_LT(filter.covariance()(error::kGyroScale, error::kGyroScale), 0.01 * 0.01);
}

// Angles that differ by a whole turn are one.
TEST(ErrorStateFilter, TakesAHeadingAcrossTheBack) {
  EstimatorSetup setup = FilterSetup();
  setup.start.heading_rad = math::DegToRad(179.0);
  ErrorStateFilter filter({.prior = {.heading_sd_rad = 0.1}}, setup);
  filter.Capture(1);
  EXPECT_EQ(filter.Update(FixOf(kHeading, 1, math::DegToRad(-179.0), 1e-4)), AidUse::kUsed);
  EXPECT_NEAR(filter.estimate().pose.heading_rad, math::DegToRad(-179.0), 1e-4);
}

class WayBack : public testing::Test {
 protected:
  WayBack() { DriveStraight(filter_, 1.0); }

  AidUse Tell(double x_m, double y_m) {
    filter_.Capture(next_);
    const AidUse use = filter_.Update(PlaceFix(next_, x_m, y_m, 0.02));
    filter_.Forget(next_++);
    return use;
  }

  ErrorStateFilter filter_{{}, AlongX()};
  messages::CaptureNumber next_ = 0;
};

// Wheels that spun: the rover is half a metre behind and an arm's length aside, and knows nothing.
TEST_F(WayBack, IsFoundWhenGoodFixesWereTurnedAway) {
  EXPECT_EQ(Tell(1.5, -1.0), AidUse::kGatedOut);
  EXPECT_NEAR(filter_.estimate().pose.x_m, 2.0, 1e-9);
  EXPECT_EQ(Tell(1.5, -1.0), AidUse::kGatedOut);
  EXPECT_EQ(Tell(1.5, -1.0), AidUse::kUsedInDoubt);
  EXPECT_NEAR(filter_.estimate().pose.x_m, 1.5, 0.05);
  EXPECT_NEAR(filter_.estimate().pose.y_m, -1.0, 0.05);
  // It knows that its heading may be off by as much as it came aside: 1.12 m over 1 m.
  EXPECT_GT(filter_.covariance()(kHeading, kHeading), 0.2);
  EXPECT_EQ(Tell(1.5, -1.0), AidUse::kUsed);
}

// As of a compass that is right all the time, while the wheels spun.
TEST_F(WayBack, IsFoundWhateverAnotherKindOfFixSays) {
  int turned_away = 0;
  AidUse use = AidUse::kGatedOut;
  while (use == AidUse::kGatedOut && turned_away < 10) {
    use = Tell(1.5, -1.0);
    turned_away += use == AidUse::kGatedOut ? 1 : 0;
    filter_.Capture(next_);
    const double heading_rad = filter_.estimate().pose.heading_rad;
    EXPECT_EQ(filter_.Update(FixOf(kHeading, next_, heading_rad, 0.01)), AidUse::kUsed);
    filter_.Forget(next_++);
  }
  EXPECT_EQ(use, AidUse::kUsedInDoubt);
  EXPECT_EQ(turned_away, 2);
}

// A coarse place a moment before is no reason to take the heading for right all the way.
TEST_F(WayBack, DoubtsTheHeadingByTheWayOfItsOwnKind) {
  messages::PoseFix fix = PlaceFix(0, 0.0, 0.0, 0.02);
  fix.in_lander_frame = true;  // another kind, though no lander is told apart here
  AidUse use = AidUse::kUsed;
  for (int i = 0; i < 3; ++i) {
    filter_.Capture(next_);
    EXPECT_EQ(filter_.Update(PlaceFix(next_, 2.0, -2.0, 2.0)), AidUse::kUsed);
    fix.capture = next_;
    fix.pose[kX] = 1.5;
    fix.pose[kY] = -1.0;
    use = filter_.Update(fix);
    filter_.Forget(next_++);
  }
  EXPECT_EQ(use, AidUse::kUsedInDoubt);
  EXPECT_GT(filter_.covariance()(kHeading, kHeading), 0.2);
}

// The heading has gone wrong since the last place that was believed, not before.
TEST_F(WayBack, DoubtsTheHeadingByTheWaySinceTheLastPlace) {
  const auto doubt = [&](double x_m) {
    for (int i = 0; i < 2; ++i) EXPECT_EQ(Tell(x_m, -1.0), AidUse::kGatedOut);
    EXPECT_EQ(Tell(x_m, -1.0), AidUse::kUsedInDoubt);
    return filter_.covariance()(kHeading, kHeading);
  };
  ASSERT_EQ(Tell(2.0, -2.0), AidUse::kUsed);
  DriveStraight(filter_, 1.0);
  const double after_a_metre = doubt(2.5);
  filter_ = ErrorStateFilter({}, AlongX());
  DriveStraight(filter_, 2.0);
  EXPECT_GT(after_a_metre, 2.0 * doubt(2.5));
}

TEST_F(WayBack, BeginsAnewWhereOperatorsPlacedTheRover) {
  for (int i = 0; i < 2; ++i) EXPECT_EQ(Tell(1.5, -1.0), AidUse::kGatedOut);
  filter_.Place({2.0, -2.0, 0.0});
  EXPECT_EQ(Tell(1.5, -1.0), AidUse::kGatedOut);
}

TEST_F(WayBack, IsNotTakenForOneWrongFix) {
  EXPECT_EQ(Tell(5.0, 3.0), AidUse::kGatedOut);
  EXPECT_EQ(Tell(2.0, -2.0), AidUse::kUsed);
  EXPECT_EQ(Tell(5.0, 3.0), AidUse::kGatedOut);
  EXPECT_EQ(Tell(5.0, 3.0), AidUse::kGatedOut);
  EXPECT_NEAR(filter_.estimate().pose.x_m, 2.0, 0.01);
}

TEST(ErrorStateFilter, BeginsAnewWhereItIsToldToBe) {
  ErrorStateFilter filter({}, FilterSetup());
  DriveStraight(filter, 3.0);
  filter.Capture(1);
  const double scale_variance = filter.covariance()(error::kWheelScale, error::kWheelScale);
  filter.Place({4.0, 1.0, 0.5});
  EXPECT_EQ(filter.estimate().pose.x_m, 4.0);
  EXPECT_EQ(filter.estimate().odometry.x_m, 4.0);
  EXPECT_EQ(filter.covariance()(kX, kX), 0.0);
  EXPECT_EQ(filter.covariance()(kX, error::kWheelScale), 0.0);
  EXPECT_EQ(filter.covariance()(error::kWheelScale, error::kWheelScale), scale_variance);
  EXPECT_EQ(filter.Update(FixOf(kX, 1, 4.0, 0.1)), AidUse::kUnknown);
  DriveStraight(filter, 0.2);
  EXPECT_GT(filter.covariance()(kX, kX), 0.0);
}

// Nobody measured where a mirrored rover is: its error is the mirror image of what it was.
TEST(ErrorStateFilter, KeepsItsErrorWhereItWasMirrored) {
  ErrorStateFilter filter({}, FilterSetup());
  for (int i = 0; i < 300; ++i) filter.Propagate(Rolled(0.01, 0.001, 0.05));
  filter.Capture(1);  // carries the covariance on
  const ErrorMatrix before = filter.covariance();
  filter.Place({2.0, 3.0, -0.6, true});
  const ErrorMatrix after = filter.covariance();
  EXPECT_GT(before(kX, kY), 1e-4);
  EXPECT_DOUBLE_EQ(after(kX, kX), before(kX, kX));
  EXPECT_DOUBLE_EQ(after(kX, kY), -before(kX, kY));
  EXPECT_DOUBLE_EQ(after(kY, kHeading), before(kY, kHeading));
  EXPECT_DOUBLE_EQ(after(kX, kHeading), -before(kX, kHeading));
  EXPECT_DOUBLE_EQ(after(kHeading, error::kGyroScale), -before(kHeading, error::kGyroScale));
  EXPECT_EQ(filter.estimate().pose.y_m, 3.0);
}

// Operators turn the rover in the world; what the mast and the world told of each other stays.
TEST(ErrorStateFilter, KeepsThePanAngleWhereItWasMirrored) {
  EstimatorSetup setup = AlongX();
  setup.lander = {.x_m = -8.0, .y_m = 1.0, .pan_sd_rad = 0.05};
  ErrorStateFilter filter({}, setup);
  DriveStraight(filter, 1.0);
  filter.Capture(1);
  messages::PoseFix mast = PlaceFix(1, 2.0, -1.8, 0.02);
  mast.in_lander_frame = true;
  ASSERT_EQ(filter.Update(mast), AidUse::kUsed);
  const double pan_rad = filter.pan_rad();
  EXPECT_GT(pan_rad, 0.01);
  const double before_m = filter.estimate().world->pose.x_m;
  filter.Propagate(Rolled(0.001, 0.0, 0.05));  // less than a stretch
  EXPECT_NEAR(filter.estimate().world->pose.x_m, before_m + 0.001, 1e-4);
  EXPECT_GT(filter.estimate().world->pose.x_m, before_m + 0.0009);
  const messages::PoseEstimate world = filter.estimate().world->pose;
  filter.Place({world.x_m, 2.0 * 0.5 - world.y_m, -world.heading_rad, true});
  EXPECT_EQ(filter.pan_rad(), pan_rad);
  EXPECT_EQ(filter.estimate().world->pose.y_m, 1.0 - world.y_m);
  const math::Pose2 told =
      math::TurnedAbout({world.x_m, 1.0 - world.y_m, -world.heading_rad}, -8.0, 1.0, pan_rad);
  EXPECT_DOUBLE_EQ(filter.estimate().pose.y_m, told.y_m);
  EXPECT_DOUBLE_EQ(filter.estimate().odometry.y_m, told.y_m);
}

// Noise at rest, and scrapes that it reckons with.
TEST(ErrorStateFilter, ReckonsWithTheDriftItIsTold) {
  ErrorStateFilterParams params;
  const double rad2 = math::DegToRad(1.0) * math::DegToRad(1.0);
  const auto heading_variance = [&] {
    ErrorStateFilter filter(params, FilterSetup());
    DriveStraight(filter, 1.0);                                             // 10 s at 0.1 m/s
    for (int i = 0; i < 100; ++i) filter.Propagate(Rolled(0.0, 0.0, 0.2));  // 20 s at rest
    filter.Capture(1);
    return filter.covariance()(kHeading, kHeading) / rad2;
  };
  EXPECT_NEAR(heading_variance(), 0.70 * 0.15 * 10.0, 1e-9);
  params.drift.drifts_at_rest = true;
  EXPECT_NEAR(heading_variance(), 0.70 * 0.15 * 30.0, 1e-9);
  params.drift.scrapes_per_m = 0.2;
  EXPECT_NEAR(heading_variance(), 0.70 * 0.15 * 30.0 + 0.2 * 25.0, 1e-6);
}

// Way is way, forwards or backwards.
TEST(ErrorStateFilter, LosesAsMuchBackwards) {
  ErrorStateFilterParams params{.drift = {.scrapes_per_m = 0.2}};
  const auto covariance = [&](double step_m) {
    ErrorStateFilter filter(params, FilterSetup());
    for (int i = 0; i < 200; ++i) filter.Propagate(Rolled(step_m, 0.0, 0.05));
    filter.Capture(1);
    return filter.covariance();
  };
  const ErrorMatrix forwards = covariance(0.005);
  const ErrorMatrix backwards = covariance(-0.005);
  for (const error::Row row : {error::kX, error::kY, error::kZ, error::kHeading}) {
    EXPECT_GT(backwards(row, row), 0.0);
    EXPECT_NEAR(backwards(row, row), forwards(row, row), 1e-12);
  }
}

TEST(ErrorStateFilter, CarriesTheCovarianceOnByStretches) {
  ErrorStateFilter filter({}, FilterSetup());
  filter.Propagate(Rolled(0.06, 0.0, 0.4));
  EXPECT_EQ((*filter.estimate().covariance)(kX, kX), 0.0);
  filter.Propagate(Rolled(0.01, 0.0, 0.07));
  EXPECT_GT((*filter.estimate().covariance)(kX, kX), 0.0);
}

TEST(ErrorStateFilter, HasNoInterestInAFixOfNothing) {
  ErrorStateFilter filter({}, FilterSetup());
  filter.Capture(1);
  messages::PoseFix fix{.capture = 1, .measured = {}};
  EXPECT_EQ(filter.Update(fix), AidUse::kNoInterest);
}

}  // namespace
}  // namespace rockyard::localization
