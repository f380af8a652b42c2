// A point that replans every half metre and drives the chosen splines exactly, on open ground.
#include <gtest/gtest.h>

#include <numbers>

#include "grids.h"
#include "navigation/gestalt/splines.h"

namespace rockyard::navigation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kReplan_m = 0.5;

struct Drive {
  bool arrived = false;
  double length_m = 0.0;
  double largest_corner_per_m = 0.0;  // of the curvature, between a plan and the next
  math::Pose2 end;
};

// Drives until it is within the tolerance, up to limit_m.
Drive DriveTo(const messages::Goal& goal, double limit_m, SplineLaw law) {
  GestaltParams params;
  params.splines.law = law;
  params.speed.min_speed_share = 0.5;
  const SplineVoter voter(params, 0.07);
  const CurvatureLaw curves(law, params.speed);
  const GoodnessGrid grid = GridOf([](double, double) { return kGood; }, 400, 0.2);
  Drive drive;
  double curvature = 0.0;
  while (drive.length_m < limit_m) {
    const messages::PoseEstimate start = At(drive.end.x_m, drive.end.y_m, drive.end.heading_rad);
    const SplineVotes votes = voter.Vote(grid, start, curvature, goal);
    const Spline spline = ChooseSpline(votes, params)->spline;
    drive.largest_corner_per_m = std::max(drive.largest_corner_per_m,
                                          std::abs(CurvatureAt(spline, 0.0, curves) - curvature));
    for (int i = 0; i < 10; ++i) {
      const double from_m = kReplan_m * i / 10;
      const double to_m = kReplan_m * (i + 1) / 10;
      drive.end = AlongSpline(drive.end, spline, from_m, to_m, curves);
      drive.length_m += to_m - from_m;
      drive.arrived = std::hypot(goal.x_m - drive.end.x_m, goal.y_m - drive.end.y_m) <=
                      params.waypoints.goal_tolerance_m;
      if (drive.arrived) return drive;
    }
    curvature = CurvatureAt(spline, kReplan_m, curves);
  }
  return drive;
}

// As far as Howard's goal, up to abeam: no more than a fifth farther than its distance, since
// steering takes a while, and what is in the disc of the goal where a spline ends is not yet aimed
// at.
TEST(GestaltSplineDrive, LeadsToTheGoal) {
  for (const SplineLaw law : {SplineLaw::kDistance, SplineLaw::kTime}) {
    for (int bearing_deg = 0; bearing_deg <= 90; bearing_deg += 15) {
      SCOPED_TRACE(bearing_deg);
      const double bearing = bearing_deg * kPi / 180.0;
      const messages::Goal goal{15.0 * std::cos(bearing), 15.0 * std::sin(bearing)};
      const Drive drive = DriveTo(goal, 40.0, law);
      EXPECT_TRUE(drive.arrived);
      EXPECT_LT(drive.length_m, 15.0 * 1.2);
      EXPECT_EQ(drive.largest_corner_per_m, 0.0);
    }
  }
}

TEST(GestaltSplineDrive, IsMirroredWithTheGoal) {
  const Drive left = DriveTo({9.0, 8.0}, 40.0, SplineLaw::kDistance);
  const Drive right = DriveTo({9.0, -8.0}, 40.0, SplineLaw::kDistance);
  EXPECT_TRUE(left.arrived);
  EXPECT_EQ(left.length_m, right.length_m);
  EXPECT_EQ(left.end.x_m, right.end.x_m);
  EXPECT_EQ(left.end.y_m, -right.end.y_m);
}

// A limit: a goal within the tightest circle to either side is driven round for ever, as it always
// lies abeam.
TEST(GestaltSplineDrive, NeverReachesAGoalInsideItsTightestCircle) {
  EXPECT_FALSE(DriveTo({1.0, 1.7}, 60.0, SplineLaw::kDistance).arrived);
  EXPECT_TRUE(DriveTo({3.0, 1.0}, 60.0, SplineLaw::kDistance).arrived);
}

}  // namespace
}  // namespace rockyard::navigation
