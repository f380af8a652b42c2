// Whether the filter's belief is right where the world is as it believes: normalized estimation
// error squared (NEES) and normalized innovation squared (NIS) over many runs (Bar-Shalom, Li and
// Kirubarajan 2001, section 5.4), with controls in which it is wrong.
#include <gtest/gtest.h>

#include "core/distributions.h"
#include "localization/filter_rover.h"

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
        const Eigen::Vector2d r(fix.pose_W[0] - filter.estimate().pose.x_m,
                                fix.pose_W[1] - filter.estimate().pose.y_m);
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

}  // namespace
}  // namespace rockyard::localization
