// Goals as a lander designates them: Matthies 1995, section 4 and figure 4.

#include "trial/course/goal_designation.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/statistical_checks.h"

namespace rockyard::trial {
namespace {

CourseParams Course(double range_m) {
  CourseParams course;
  course.goal_x_m = range_m;
  course.designation.enabled = true;
  return course;
}

double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

TEST(GoalDesignationTest, OffTellsTheTrueGoal) {
  CourseParams course = Course(7.6);
  course.designation.enabled = false;
  const messages::Goal goal = DesignatedGoal(course, {1, 2});
  EXPECT_EQ(goal.x_m, 7.6);
  EXPECT_EQ(goal.y_m, 0.0);
}

// Sections 4, 5 and 8, figure 4: below 17.5 cm at 10 m, the largest being the pan error's; sigma_d
// and the pan error together one vehicle length (60 cm) at 20 m.
TEST(GoalDesignationTest, PublishedNumbersComeOut) {
  const DesignationParams params;
  const DesignationErrors at_10 = params.ErrorsAt(10.0);
  EXPECT_NEAR(at_10.crossrange_sd_m, 0.01, 1e-12);
  EXPECT_NEAR(at_10.downrange_sd_m, 0.0667, 1e-4);
  EXPECT_NEAR(at_10.crossrange_bias_m, 0.17, 0.005);
  const DesignationErrors at_20 = params.ErrorsAt(20.0);
  EXPECT_NEAR(at_20.downrange_sd_m, 0.267, 1e-3);
  EXPECT_NEAR(at_20.downrange_sd_m + at_20.crossrange_bias_m, 0.60, 0.02);
}

// Kolmogorov and Smirnov, alpha 0.001 each, 4000 goals of fixed seeds.
TEST(GoalDesignationTest, SpreadIsTheClosedForm) {
  const CourseParams course = Course(20.0);
  const DesignationErrors errors = course.designation.ErrorsAt(20.0);
  std::vector<double> downrange;
  std::vector<double> crossrange;
  for (std::uint32_t trial = 0; trial < 4000; ++trial) {
    const messages::Goal goal = DesignatedGoal(course, {3, trial});
    downrange.push_back((goal.x_m - 20.0) / errors.downrange_sd_m);
    crossrange.push_back((goal.y_m - errors.crossrange_bias_m) / errors.crossrange_sd_m);
  }
  EXPECT_GT(core::KolmogorovP(downrange, NormalCdf), 0.001);
  EXPECT_GT(core::KolmogorovP(crossrange, NormalCdf), 0.001);
  // Negative control: a disparity known 15 % worse.
  for (double& z : downrange) z *= 1.15;
  EXPECT_LT(core::KolmogorovP(downrange, NormalCdf), 0.001);
}

TEST(GoalDesignationTest, UniformPanErrorFillsItsBound) {
  CourseParams course = Course(20.0);
  course.designation.pan_kind = PanError::kUniform;
  course.designation.pixel_sd_px = 0.0;
  const double bound_m = course.designation.ErrorsAt(20.0).crossrange_bias_m;
  std::vector<double> left;
  for (std::uint32_t trial = 0; trial < 2000; ++trial) {
    left.push_back(DesignatedGoal(course, {3, trial}).y_m);
  }
  const auto cdf = [&](double y_m) { return (y_m / bound_m + 1.0) / 2.0; };
  EXPECT_GT(core::KolmogorovP(left, cdf), 0.001);
}

// The lander stands 20 m ahead of the start, beside the goal, 5 m left of the line.
TEST(GoalDesignationTest, ErrorsLieAlongTheLineOfSight) {
  CourseParams course = Course(20.0);
  course.designation.lander_ahead_m = 20.0;
  course.designation.lander_left_m = 5.0;
  course.designation.pixel_sd_px = 0.0;
  EXPECT_NEAR(course.DesignationRange_m({course.goal_x_m, course.goal_y_m}), 5.0, 1e-12);
  // Seen from there the goal lies to the right (-y): the pan error, to the left, goes to +x.
  const messages::Goal goal = DesignatedGoal(course, {3, 1});
  EXPECT_NEAR(goal.x_m, 20.0 + 5.0 * course.designation.pan_error_rad, 1e-9);
  EXPECT_NE(goal.y_m, 0.0);
}

TEST(GoalDesignationTest, OneErrorShiftsNoOther) {
  CourseParams course = Course(20.0);
  const messages::Goal before = DesignatedGoal(course, {3, 1});
  course.designation.pixel_sd_px = 0.0;
  course.designation.pan_kind = PanError::kUniform;
  EXPECT_EQ(DesignatedGoal(course, {3, 1}).x_m, before.x_m);
}

CourseParams CourseOfThree() {
  CourseParams course = Course(20.0);
  course.waypoints = {.x_m = {10.0, 20.0}, .y_m = {0.0, 5.0}};
  return course;
}

TEST(GoalDesignationTest, WaypointsAreToldInOrderAndTheGoalLast) {
  CourseParams course = CourseOfThree();
  course.designation.enabled = false;
  const std::vector<messages::Goal> goals = DesignatedGoals(course, {3, 1});
  ASSERT_EQ(goals.size(), 3U);
  EXPECT_EQ(goals[0].x_m, 10.0);
  EXPECT_EQ(goals[1].y_m, 5.0);
  EXPECT_EQ(goals[2].x_m, 20.0);
}

TEST(GoalDesignationTest, WaypointsChangeNothingAboutTheGoal) {
  for (const PanError kind : {PanError::kFixed, PanError::kUniform}) {
    CourseParams course = CourseOfThree();
    course.designation.pan_kind = kind;
    const messages::Goal goal = DesignatedGoals(course, {3, 1}).back();
    course.waypoints = {};
    EXPECT_EQ(DesignatedGoals(course, {3, 1}).size(), 1U);
    EXPECT_EQ(DesignatedGoals(course, {3, 1}).back().x_m, goal.x_m);
    EXPECT_EQ(DesignatedGoal(course, {3, 1}).x_m, goal.x_m);
    EXPECT_EQ(DesignatedGoal(course, {3, 1}).y_m, goal.y_m);
  }
}

// Kolmogorov and Smirnov, alpha 0.001, of a waypoint at half the range: half the error across, a
// quarter along. Errors of one trial are independent: the mean product of two standard normals has
// the deviation 1 / sqrt(n).
TEST(GoalDesignationTest, EveryWaypointHasErrorsOfItsOwnByItsRange) {
  const CourseParams course = CourseOfThree();
  const DesignationErrors errors = course.designation.ErrorsAt(10.0);
  const DesignationErrors at_goal = course.designation.ErrorsAt(20.0);
  std::vector<double> downrange;
  std::vector<double> crossrange;
  double product = 0.0;
  constexpr std::uint32_t kTrials = 4000;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    const std::vector<messages::Goal> goals = DesignatedGoals(course, {3, trial});
    downrange.push_back((goals[0].x_m - 10.0) / errors.downrange_sd_m);
    crossrange.push_back((goals[0].y_m - errors.crossrange_bias_m) / errors.crossrange_sd_m);
    product += downrange.back() * (goals[2].x_m - 20.0) / at_goal.downrange_sd_m;
  }
  EXPECT_GT(core::KolmogorovP(downrange, NormalCdf), 0.001);
  EXPECT_GT(core::KolmogorovP(crossrange, NormalCdf), 0.001);
  EXPECT_GT(2.0 * NormalCdf(-std::abs(product) / std::sqrt(double{kTrials})), 0.001);
}

// The pan axis is wrong by one angle in a trial: across the line of sight to each place.
TEST(GoalDesignationTest, ThePanErrorIsOneOfTheTrial) {
  CourseParams course = CourseOfThree();
  course.designation.pan_kind = PanError::kUniform;
  course.designation.pixel_sd_px = 0.0;
  course.designation.disparity_sd_px = 0.0;
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const std::vector<messages::Goal> goals = DesignatedGoals(course, {3, trial});
    const double pan_rad = goals[2].y_m / 20.0;
    EXPECT_NEAR(goals[0].y_m, 10.0 * pan_rad, 1e-12);
    // To the left of (20, 5) as seen from the origin: (-5, 20) times the angle.
    EXPECT_NEAR(goals[1].x_m, 20.0 - 5.0 * pan_rad, 1e-12);
    EXPECT_NEAR(goals[1].y_m, 5.0 + 20.0 * pan_rad, 1e-12);
  }
}

// What a map has in common with its goals.
TEST(GoalDesignationTest, ThePanErrorIsToldByItself) {
  CourseParams course = CourseOfThree();
  EXPECT_EQ(PanError_rad(course.designation, {3, 1}), course.designation.pan_error_rad);
  course.designation.pan_kind = PanError::kUniform;
  course.designation.pixel_sd_px = 0.0;
  EXPECT_NEAR(PanError_rad(course.designation, {3, 1}), DesignatedGoal(course, {3, 1}).y_m / 20.0,
              1e-12);
  course.designation.enabled = false;
  EXPECT_EQ(PanError_rad(course.designation, {3, 1}), 0.0);
}

// The lander stands 20 m ahead of the start and 5 m left of the line.
TEST(GoalDesignationTest, RangesOfWaypointsAreTheirOwn) {
  CourseParams course = CourseOfThree();
  course.designation.lander_ahead_m = 20.0;
  course.designation.lander_left_m = 5.0;
  EXPECT_NEAR(course.DesignationRange_m({20.0, 5.0}), 0.0, 1e-12);
  EXPECT_NEAR(course.DesignationRange_m({17.0, 1.0}), 5.0, 1e-12);
  EXPECT_NEAR(course.DesignationRange_m({20.0, 8.0}), 3.0, 1e-12);
  const std::vector<messages::Goal> goals = DesignatedGoals(course, {3, 1});
  EXPECT_EQ(goals[1].x_m, 20.0) << "under the lander";
  EXPECT_EQ(goals[1].y_m, 5.0);
}

}  // namespace
}  // namespace rockyard::trial
