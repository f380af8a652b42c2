// Whether the filter's belief is right where the world is as it believes: normalized estimation
// error squared (NEES) and normalized innovation squared (NIS) over many runs (Bar-Shalom, Li and
// Kirubarajan 2001, section 5.4), with controls in which it is wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "localization/aid_fixes.h"
#include "localization/filter_rover.h"
#include "math/angles.h"
#include "math/polar.h"

namespace rockyard::localization {
namespace {

constexpr int kRuns = 400;
constexpr double kAlpha = 0.001;  // of each two-sided bound

struct Consistency {
  double nees = 0.0;  // mean over the runs, of x, y and heading at the end
  double nis = 0.0;   // mean over all fixes, of x and y
  int fixes = 0;
};

ErrorStateFilterParams World() {
  ErrorStateFilterParams params{
      .prior = {.gyro_bias_sd_rad_s = math::DegToRad(0.005), .gyro_scale_sd = 0.03}};
  params.gate.chance = 0.0;  // every fix counts
  return params;
}

// Drives 6 m with a bend every metre and a fix of sd 0.1 m every 2 m that arrives 0.5 m later.
Consistency DriveMany(const ErrorStateFilterParams& belief, std::uint64_t seed) {
  constexpr double kFixSd_m = 0.1;
  Consistency sums;
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    const EstimatorSetup setup = FilterSetup();
    FilterRover rover(World(), setup.start, {seed, run});
    ErrorStateFilter filter(belief, setup);
    messages::PoseFix fix;
    for (int i = 0; i < 1200; ++i) {
      filter.Propagate(rover.Drive(0.005, i / 200 % 2 == 0 ? 0.002 : -0.002, 0.05));
      if (i % 400 == 399 && i < 1100) {
        const double x_m = rover.pose().x_m + rover.Normal(kFixSd_m);
        const double y_m = rover.pose().y_m + rover.Normal(kFixSd_m);
        fix = PlaceFix(i, x_m, y_m, kFixSd_m);
        filter.Capture(i);
        const Eigen::Vector2d r(fix.pose[0] - filter.estimate().pose.x_m,
                                fix.pose[1] - filter.estimate().pose.y_m);
        const Eigen::Matrix2d S = filter.covariance().topLeftCorner<2, 2>() +
                                  Eigen::Matrix2d::Identity() * kFixSd_m * kFixSd_m;
        sums.nis += r.dot(S.inverse() * r);
        ++sums.fixes;
      }
      if (i % 400 == 99 && i > 400) {
        filter.Update(fix);
        filter.Forget(fix.capture);
      }
    }
    filter.Capture(10000);  // carries the covariance on to the end
    Eigen::Matrix3d P;
    constexpr int kRows[] = {error::kX, error::kY, error::kHeading};
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) P(a, b) = filter.covariance()(kRows[a], kRows[b]);
    }
    const Eigen::Vector3d e(
        rover.pose().x_m - filter.estimate().pose.x_m,
        rover.pose().y_m - filter.estimate().pose.y_m,
        math::WrapAngle(rover.pose().heading_rad - filter.estimate().pose.heading_rad));
    sums.nees += e.dot(P.inverse() * e);
  }
  sums.nees /= kRuns;
  sums.nis /= sums.fixes;
  return sums;
}

// Whether the mean of `count` chi-squared numbers lies within its two-sided bounds.
bool Holds(double mean, int count, int degrees) {
  const int all = count * degrees;
  return mean * count >= core::ChiSquaredQuantile(0.5 * kAlpha, all) &&
         mean * count <= core::ChiSquaredQuantile(1.0 - 0.5 * kAlpha, all);
}

TEST(FilterConsistency, HoldsWhereTheWorldIsAsItBelieves) {
  const Consistency found = DriveMany(World(), 11);
  EXPECT_TRUE(Holds(found.nees, kRuns, 3)) << found.nees;
  EXPECT_TRUE(Holds(found.nis, found.fixes, 2)) << found.nis;
  EXPECT_EQ(found.fixes, 2 * kRuns);
}

TEST(FilterConsistency, BreaksWhereTheFilterBelievesTooMuch) {
  ErrorStateFilterParams belief = World();
  belief.drift.heading_variance_deg2_per_m *= 0.5;
  EXPECT_GT(DriveMany(belief, 11).nees, 3.3);
  belief = World();
  belief.prior.wheel_scale_sd = 0.02;
  EXPECT_FALSE(Holds(DriveMany(belief, 11).nis, 2 * kRuns, 2));
  belief = World();
  belief.drift.distance_variance_m2_per_m *= 0.25;
  EXPECT_FALSE(Holds(DriveMany(belief, 11).nees, kRuns, 3));
}

TEST(FilterConsistency, BreaksWhereTheFilterBelievesTooLittle) {
  ErrorStateFilterParams belief = World();
  belief.drift.heading_variance_deg2_per_m *= 2.0;
  belief.drift.distance_variance_m2_per_m *= 2.0;
  const Consistency found = DriveMany(belief, 11);
  EXPECT_FALSE(Holds(found.nees, kRuns, 3));
  EXPECT_LT(found.nees, 2.6);
}

// What a mast tells whose pan angle is wrong by another angle in each run, and a beacon that knows
// the world.
struct Aids {
  bool mast = false;
  bool beacon = false;
  bool told_apart = true;   // the filter knows that they are of two frames
  bool by_reading = false;  // the beacon's covariance is taken at what it measured
};

struct InTwoFrames {
  double world_nees = 0.0;  // mean of x, y and heading
  double goal_nees = 0.0;   // in the mast's frame, in which goals are told
  double world_m = 0.0;     // rms
  double goal_m = 0.0;
};

constexpr LanderFrame kMast{.x_m = -18.0, .y_m = 5.0, .pan_sd_rad = math::DegToRad(1.5)};

double Nees(const messages::PoseEstimate& pose, const messages::PoseCovariance& covariance,
            const math::Pose2& truth) {
  constexpr std::array kPlanar{error::kX, error::kY, error::kHeading};
  const Eigen::Vector3d e(truth.x_m - pose.x_m, truth.y_m - pose.y_m,
                          math::WrapAngle(truth.heading_rad - pose.heading_rad));
  return e.dot(covariance(kPlanar, kPlanar).inverse() * e);
}

double SquaredError_m2(const messages::PoseEstimate& pose, const math::Pose2& truth) {
  return (pose.x_m - truth.x_m) * (pose.x_m - truth.x_m) +
         (pose.y_m - truth.y_m) * (pose.y_m - truth.y_m);
}

messages::PoseFix MastFix(int capture, FilterRover& rover, double pan_rad, bool told_apart) {
  constexpr double kRangeSd = 0.05;
  constexpr double kBearingSd_rad = 0.001;
  constexpr double kHeadingSd_rad = 0.03;
  const math::Pose2 seen = math::TurnedAbout(rover.pose(), kMast.x_m, kMast.y_m, pan_rad);
  const double true_range_m = std::hypot(seen.x_m - kMast.x_m, seen.y_m - kMast.y_m);
  const double range_m = true_range_m * (1.0 + rover.Normal(kRangeSd));
  const double bearing_rad =
      std::atan2(seen.y_m - kMast.y_m, seen.x_m - kMast.x_m) + rover.Normal(kBearingSd_rad);
  messages::PoseFix fix = PlaceFix(capture, kMast.x_m + range_m * std::cos(bearing_rad),
                                   kMast.y_m + range_m * std::sin(bearing_rad), 1.0);
  fix.covariance.topLeftCorner<2, 2>() =
      math::PolarCovariance(bearing_rad, range_m * kRangeSd, range_m * kBearingSd_rad);
  fix.measured.set(error::kHeading);
  fix.pose[error::kHeading] = math::WrapAngle(seen.heading_rad + rover.Normal(kHeadingSd_rad));
  fix.covariance(error::kHeading, error::kHeading) = kHeadingSd_rad * kHeadingSd_rad;
  fix.in_lander_frame = told_apart;
  return fix;
}

// As far from the station as a rover of a short drive is.
messages::PoseFix BeaconFix(int capture, FilterRover& rover,
                            const messages::LocalizationEstimate& believed, bool by_reading) {
  messages::BeaconReading reading{.capture = capture,
                                  .station_x_m = -2.0,
                                  .station_y_m = -3.0,
                                  .range_sd_m = 1.0,
                                  .bearing_sd_rad = math::DegToRad(3.0)};
  const double dx_m = rover.pose().x_m - reading.station_x_m;
  const double dy_m = rover.pose().y_m - reading.station_y_m;
  reading.range_m = std::max(0.0, std::hypot(dx_m, dy_m) + rover.Normal(reading.range_sd_m));
  reading.bearing_rad = std::atan2(dy_m, dx_m) + rover.Normal(reading.bearing_sd_rad);
  messages::PoseFix fix = PlaceFromBeacon(reading, believed);
  if (by_reading) {
    fix.covariance.topLeftCorner<2, 2>() = math::PolarCovariance(
        reading.bearing_rad, reading.range_sd_m, reading.range_m * reading.bearing_sd_rad);
  }
  return fix;
}

// Put down somewhere near, so that nothing but the beacon tells of the world.
InTwoFrames DriveBy(const Aids& aids) {
  ErrorStateFilterParams belief = World();
  belief.prior.position_sd_m = 0.4;
  belief.prior.heading_sd_rad = 0.1;
  InTwoFrames sums;
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    EstimatorSetup setup = FilterSetup();
    setup.lander = kMast;
    core::RandomStream draws({29, run}, core::Purpose::kTest, 1);
    math::Pose2 start = setup.start;
    start.x_m += core::SampleNormal(draws, 0.0, belief.prior.position_sd_m);
    start.y_m += core::SampleNormal(draws, 0.0, belief.prior.position_sd_m);
    start.heading_rad += core::SampleNormal(draws, 0.0, belief.prior.heading_sd_rad);
    const double pan_rad = core::SampleNormal(draws, 0.0, kMast.pan_sd_rad);
    FilterRover rover(World(), start, {29, run});
    ErrorStateFilter filter(belief, setup);
    for (int i = 0; i < 1200; ++i) {
      filter.Propagate(rover.Drive(0.005, i / 200 % 2 == 0 ? 0.002 : -0.002, 0.05));
      if (i % 100 != 99) continue;
      filter.Capture(i);
      const auto fix = MastFix(i, rover, pan_rad, aids.told_apart);
      const auto place = BeaconFix(i, rover, filter.estimate(), aids.by_reading);
      if (aids.mast) filter.Update(fix);
      if (aids.beacon) filter.Update(place);
      filter.Forget(i);
    }
    const messages::LocalizationEstimate& found = filter.estimate();
    const math::Pose2 told = math::TurnedAbout(rover.pose(), kMast.x_m, kMast.y_m, pan_rad);
    sums.world_nees += Nees(found.world->pose, found.world->covariance, rover.pose()) / kRuns;
    sums.goal_nees += Nees(found.pose, *found.covariance, told) / kRuns;
    sums.world_m += SquaredError_m2(found.world->pose, rover.pose()) / kRuns;
    sums.goal_m += SquaredError_m2(found.pose, told) / kRuns;
  }
  sums.world_m = std::sqrt(sums.world_m);
  sums.goal_m = std::sqrt(sums.goal_m);
  return sums;
}

// All arms meet the same noise.
TEST(FilterConsistency, HoldsInTheFrameOfGoalsAndInTheWorlds) {
  const InTwoFrames mast = DriveBy({.mast = true});
  const InTwoFrames beacon = DriveBy({.beacon = true});
  const InTwoFrames both = DriveBy({.mast = true, .beacon = true});
  for (const InTwoFrames& found : {DriveBy({}), mast, beacon, both}) {
    EXPECT_TRUE(Holds(found.world_nees, kRuns, 3)) << found.world_nees;
    EXPECT_TRUE(Holds(found.goal_nees, kRuns, 3)) << found.goal_nees;
  }
  // Another aid makes it no worse in either frame, and the two together tell the pan angle.
  EXPECT_LT(both.world_m, 0.8 * std::min(mast.world_m, beacon.world_m));
  EXPECT_LT(both.goal_m, 1.02 * std::min(mast.goal_m, beacon.goal_m));
}

TEST(FilterConsistency, BreaksInTheWorldWhereTheMastIsTakenForRight) {
  EXPECT_GT(DriveBy({.mast = true, .beacon = true, .told_apart = false}).world_nees, 30.0);
}

TEST(FilterConsistency, BreaksWhereABeaconIsWeighedByWhatItMeasured) {
  for (const bool mast : {false, true}) {
    const double nees = DriveBy({.mast = mast, .beacon = true, .by_reading = true}).world_nees;
    EXPECT_GT(nees, 3.0);
    EXPECT_FALSE(Holds(nees, kRuns, 3)) << nees;
  }
}

}  // namespace
}  // namespace rockyard::localization
