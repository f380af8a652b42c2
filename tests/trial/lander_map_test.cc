// The rocks as a lander's stereo pair shows them: Matthies 1995, sections 2.1.1 and 4.

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "core/statistical_checks.h"
#include "trial/course/goal_designation.h"

namespace rockyard::trial {
namespace {

constexpr double kMast_m = 1.5;

// A lander at the origin that errs in nothing.
CourseParams ExactCourse() {
  CourseParams course;
  course.goal_x_m = 20.0;
  course.designation.enabled = true;
  course.designation.pan_error_rad = 0.0;
  course.lander_map.edge_sd_px = 0.0;
  course.lander_map.disparity_sd_px = 0.0;
  course.lander_map.resolved_px = 0.0;
  return course;
}

// A dome on the ground.
terrain::Rock Dome(double x_m, double y_m, double radius_m, double height_m) {
  return {.center_W = {x_m, y_m, 0.0},
          .semi_axes_m = {radius_m, radius_m, height_m},
          .diameter_m = 2.0 * radius_m,
          .height_m = height_m};
}

// 2 m across the x axis and 4 mm thick.
terrain::Rock Fence(double x_m, double height_m) {
  terrain::Rock rock = Dome(x_m, 0.0, 1.0, height_m);
  rock.semi_axes_m.y() = 0.002;
  rock.yaw_rad = std::numbers::pi / 2.0;
  return rock;
}

std::vector<MappedRock> Map(const CourseParams& course, std::vector<terrain::Rock> rocks,
                            core::TrialKey key = {1, 0}) {
  const terrain::Terrain terrain(terrain::Ground(), std::move(rocks), {});
  return MapFromLander(course, terrain, key);
}

double Distance(const terrain::Rock& rock) {
  return std::hypot(rock.center_W.x(), rock.center_W.y());
}

TEST(LanderMapTest, ALoneRoundRockIsKnownAsItIs) {
  for (const double bearing_rad : {0.0, 0.4, -2.0, std::numbers::pi}) {
    const double x_m = 6.0 * std::cos(bearing_rad);
    const double y_m = 6.0 * std::sin(bearing_rad);
    const std::vector<MappedRock> map = Map(ExactCourse(), {Dome(x_m, y_m, 0.3, 0.4)});
    ASSERT_EQ(map.size(), 1U);
    const terrain::Rock& rock = map[0].rock;
    EXPECT_NEAR(rock.center_W.x(), x_m, 0.01);
    EXPECT_NEAR(rock.center_W.y(), y_m, 0.01);
    EXPECT_NEAR(rock.semi_axes_m.x(), 0.3, 0.003);
    EXPECT_EQ(rock.semi_axes_m.y(), rock.semi_axes_m.x());
    EXPECT_EQ(rock.diameter_m, 2.0 * rock.semi_axes_m.x());
    EXPECT_NEAR(rock.height_m, 0.4, 1e-9);
    EXPECT_EQ(rock.semi_axes_m.z(), rock.height_m);
    EXPECT_EQ(map[0].index, 0U);
    EXPECT_EQ(map[0].share_seen, 1.0);
    EXPECT_NEAR(map[0].range_m, 5.7, 0.01);
  }
}

// The far side is not seen: a rock twice as deep as wide is believed to be as deep as it is wide,
// and so nearer.
TEST(LanderMapTest, DepthIsBelievedToBeTheWidth) {
  terrain::Rock deep = Dome(8.0, 0.0, 0.4, 0.3);
  deep.semi_axes_m.y() = 0.2;
  const std::vector<MappedRock> map = Map(ExactCourse(), {deep});
  ASSERT_EQ(map.size(), 1U);
  EXPECT_NEAR(map[0].rock.semi_axes_m.x(), 0.2, 0.01);
  EXPECT_NEAR(Distance(map[0].rock), 8.0 - 0.4 + 0.2, 0.02);
}

// Over a fence of 0.5 m at 4 m the mast of 1.5 m sees nothing lower than 1.5 - x / 4 m behind it:
// 0.25 m at 5 m, and the ground from 6 m on.
TEST(LanderMapTest, WhatStandsInTheShadowOfAHigherRockIsNotKnown) {
  const auto known = [](double x_m, double height_m, bool fence) {
    std::vector<terrain::Rock> rocks{Dome(x_m, 0.0, 0.1, height_m)};
    if (fence) rocks.push_back(Fence(4.0, 0.5));
    for (const MappedRock& rock : Map(ExactCourse(), rocks)) {
      if (rock.index == 0) return rock.share_seen;
    }
    return 0.0;
  };
  EXPECT_EQ(known(5.0, 0.24, true), 0.0);
  EXPECT_EQ(known(5.0, 0.24, false), 1.0);
  const double half = known(5.0, 0.30, true);
  EXPECT_GT(half, 0.0);
  EXPECT_LT(half, 0.8);
  EXPECT_EQ(known(5.85, 0.02, true), 0.0);
  EXPECT_EQ(known(6.15, 0.02, true), 1.0);
  // Before the fence.
  EXPECT_EQ(known(3.8, 0.02, true), 1.0);
}

// Of a rock beside the fence's end, which is at a bearing of atan(1 / 4), the outer part shows.
TEST(LanderMapTest, WhatIsHiddenOfASideIsBelievedNotToBeThere) {
  const double y_m = 5.0 * 1.0 / 4.0;  // the line past the end leads over the rock's middle
  const std::vector<terrain::Rock> both{Fence(4.0, 20.0), Dome(5.0, y_m, 0.3, 0.3)};
  const std::vector<MappedRock> map = Map(ExactCourse(), both);
  ASSERT_EQ(map.size(), 2U);
  EXPECT_EQ(map[1].index, 1U);
  EXPECT_NEAR(map[1].rock.semi_axes_m.x(), 0.15, 0.04);
  EXPECT_GT(map[1].rock.center_W.y(), y_m + 0.05);
  EXPECT_LT(map[1].share_seen, 0.7);
}

// A dome of radius r at d m is 2 asin(r / d) wide: 5.00 mrad, 5.00 pixels; seen from 1.5 m above
// one that is low and wide is some h / d high.
TEST(LanderMapTest, TheSmallestRockHasSoManyPixels) {
  CourseParams course = ExactCourse();
  const std::vector<terrain::Rock> narrow{Dome(8.0, 0.0, 0.02, 0.3)};
  course.lander_map.resolved_px = 4.9;
  ASSERT_EQ(Map(course, narrow).size(), 1U);
  EXPECT_NEAR(Map(course, narrow)[0].resolved_px, 5.0, 0.1);
  course.lander_map.resolved_px = 5.1;
  EXPECT_TRUE(Map(course, narrow).empty());
  course.designation.pixel_rad = 0.0005;
  course.lander_map.resolved_px = 9.8;
  EXPECT_EQ(Map(course, narrow).size(), 1U);

  // From the base in front, 1.5 m below and 6.98 m away, to the top: no 10 pixels high.
  course = ExactCourse();
  const std::vector<terrain::Rock> low{Dome(7.0, 0.0, 0.02, 0.05)};
  const double high_px = 1000.0 * (std::atan2(kMast_m, 6.98) - std::atan2(kMast_m - 0.05, 7.0));
  EXPECT_NEAR(Map(course, low)[0].resolved_px, std::min(high_px, 40.0 / 7.0), 0.3);
}

TEST(LanderMapTest, NothingIsKnownBeyondItsReach) {
  CourseParams course = ExactCourse();
  const std::vector<terrain::Rock> rocks{Dome(10.0, 0.0, 0.2, 0.2)};  // nearest point: 9.80 m
  course.lander_map.reach_m = 9.79;
  EXPECT_TRUE(Map(course, rocks).empty());
  course.lander_map.reach_m = 9.82;
  EXPECT_EQ(Map(course, rocks).size(), 1U);
}

// Of a dome from 5.5 to 6.5 m the foot is hidden behind a fence: what is seen of it is farther.
TEST(LanderMapTest, ReachIsThatOfWhatIsSeen) {
  CourseParams course = ExactCourse();
  const std::vector<terrain::Rock> rocks{Dome(6.0, 0.0, 0.5, 0.4), Fence(5.3, 0.3)};
  const std::vector<MappedRock> map = Map(course, rocks);
  ASSERT_EQ(map.size(), 2U);
  EXPECT_GT(map[0].range_m, 5.55);
  course.lander_map.reach_m = 5.52;
  EXPECT_EQ(Map(course, rocks).size(), 1U);
}

TEST(LanderMapTest, TheMastStandsWhereDesignationSays) {
  CourseParams course = ExactCourse();
  course.designation.lander_ahead_m = -5.0;
  course.designation.lander_left_m = 3.0;
  course.start_x_m = 1.0;
  course.goal_x_m = 1.0;  // the line from the start leads along +y
  course.goal_y_m = 9.0;
  const messages::Goal lander = course.LanderPlace();
  EXPECT_NEAR(lander.x_m, -2.0, 1e-12);
  EXPECT_NEAR(lander.y_m, -5.0, 1e-12);
  const std::vector<MappedRock> map = Map(course, {Dome(-2.0, 2.0, 0.2, 0.2)});
  ASSERT_EQ(map.size(), 1U);
  EXPECT_NEAR(map[0].range_m, 6.8, 0.01);
  // A higher mast looks over what hides it.
  const std::vector<terrain::Rock> hidden{Dome(5.0, 0.0, 0.1, 0.24), Fence(4.0, 0.5)};
  course = ExactCourse();
  EXPECT_EQ(Map(course, hidden).size(), 1U);
  course.lander_map.mast_height_m = 4.0;
  EXPECT_EQ(Map(course, hidden).size(), 2U);
}

double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// Errors of a dome of 0.3 m radius and 0.4 m height, its nearest point at 20 m, in their closed
// forms' deviations.
struct Errors {
  std::vector<double> downrange;
  std::vector<double> bearing;
  std::vector<double> width;
  std::vector<double> height;
};

Errors ErrorsAt20m(double edge_sd_px, double disparity_sd_px) {
  CourseParams course = ExactCourse();
  const std::vector<terrain::Rock> rocks{Dome(20.3, 0.0, 0.3, 0.4)};
  const terrain::Rock exact = Map(course, rocks).at(0).rock;
  course.lander_map.edge_sd_px = edge_sd_px;
  course.lander_map.disparity_sd_px = disparity_sd_px;
  const double range_m = std::hypot(20.0, kMast_m);
  const double half_rad = std::asin(exact.semi_axes_m.x() / Distance(exact));
  Errors errors;
  for (std::uint32_t trial = 0; trial < 4000; ++trial) {
    const terrain::Rock rock = Map(course, rocks, {3, trial}).at(0).rock;
    const double nearest_m = Distance(rock) - rock.semi_axes_m.x();
    errors.downrange.push_back((nearest_m - (Distance(exact) - exact.semi_axes_m.x())) /
                               (disparity_sd_px * 0.001 * range_m * range_m / 0.15));
    errors.bearing.push_back(std::atan2(rock.center_W.y(), rock.center_W.x()) /
                             (edge_sd_px * 0.001 / std::numbers::sqrt2));
    errors.width.push_back((std::asin(rock.semi_axes_m.x() / Distance(rock)) - half_rad) /
                           (edge_sd_px * 0.001 / std::numbers::sqrt2));
    errors.height.push_back((rock.height_m - 0.4) /
                            (edge_sd_px * 0.001 * range_m * std::numbers::sqrt2));
  }
  return errors;
}

// Kolmogorov and Smirnov, alpha 0.001 each, 4000 trials of one seed: equation 2 along the line of
// sight, equation 1 for each of two edges across it and up (a mean and half a difference of two
// edges: 1 / sqrt 2 of one, a difference: sqrt 2).
TEST(LanderMapTest, ErrorsAreThoseOfTheClosedForms) {
  Errors errors = ErrorsAt20m(1.0, 0.1);
  EXPECT_GT(core::KolmogorovP(errors.downrange, NormalCdf), 0.001);
  EXPECT_GT(core::KolmogorovP(errors.bearing, NormalCdf), 0.001);
  EXPECT_GT(core::KolmogorovP(errors.width, NormalCdf), 0.001);
  // Without an error of the range, on which believed sizes hang.
  EXPECT_GT(core::KolmogorovP(ErrorsAt20m(1.0, 1e-9).height, NormalCdf), 0.001);
  // Independent: the mean product of two standard normals has the deviation 1 / sqrt(n).
  double product = 0.0;
  for (std::size_t i = 0; i < errors.width.size(); ++i) {
    product += errors.downrange[i] * errors.width[i];
  }
  EXPECT_LT(std::abs(product), 3.3 * std::sqrt(4000.0));
  // Negative controls: 15 % more of each.
  for (std::vector<double>* z : {&errors.downrange, &errors.bearing, &errors.width}) {
    for (double& each : *z) each *= 1.15;
    EXPECT_LT(core::KolmogorovP(*z, NormalCdf), 0.001);
  }
}

// The range is that along the ray: 5 m from a mast of 4 m to a rock 3 m off, where equation 2 gives
// the error of 20 m and 1.5 m times (5^2) / (20^2 + 1.5^2).
TEST(LanderMapTest, ErrorsGoByTheRangeAlongTheRay) {
  const auto error_m = [](double nearest_m, double mast_m) {
    CourseParams course = ExactCourse();
    course.lander_map.mast_height_m = mast_m;
    const std::vector<terrain::Rock> rocks{Dome(nearest_m + 0.3, 0.0, 0.3, 0.4)};
    const auto nearest = [&] {
      const terrain::Rock rock = Map(course, rocks, {3, 5}).at(0).rock;
      return Distance(rock) - rock.semi_axes_m.x();
    };
    const double exact_m = nearest();
    course.lander_map.disparity_sd_px = 0.1;
    return nearest() - exact_m;
  };
  EXPECT_NEAR(error_m(3.0, 4.0) / error_m(20.0, kMast_m), 25.0 / 402.25, 1e-4);
}

// Believed sizes go with the believed range.
TEST(LanderMapTest, ARockThatIsBelievedFartherIsBelievedLarger) {
  CourseParams course = ExactCourse();
  const std::vector<terrain::Rock> rocks{Dome(20.3, 0.0, 0.3, 0.4)};
  const terrain::Rock exact = Map(course, rocks).at(0).rock;
  course.lander_map.disparity_sd_px = 0.1;
  const terrain::Rock rock = Map(course, rocks, {3, 7}).at(0).rock;
  const double factor = Distance(rock) / Distance(exact);
  EXPECT_GT(std::abs(factor - 1.0), 1e-4);
  EXPECT_NEAR(rock.semi_axes_m.x() / exact.semi_axes_m.x(), factor, 1e-9);
  EXPECT_NEAR(rock.height_m / exact.height_m, factor, 1e-9);
}

// A rock where the goal is moves with it, whatever the pan axis is wrong by.
TEST(LanderMapTest, MapAndGoalAreWrongTogether) {
  CourseParams course = ExactCourse();
  course.designation.pixel_sd_px = 0.0;
  course.designation.disparity_sd_px = 0.0;
  course.designation.pan_error_rad = 0.02;
  course.designation.lander_ahead_m = 2.0;
  course.designation.lander_left_m = -6.0;
  for (const PanError kind : {PanError::kFixed, PanError::kUniform}) {
    course.designation.pan_kind = kind;
    for (std::uint32_t trial = 0; trial < 10; ++trial) {
      const messages::Goal goal = DesignatedGoal(course, {3, trial});
      const auto map = Map(course, {Dome(course.goal_x_m, course.goal_y_m, 0.1, 0.4)}, {3, trial});
      ASSERT_EQ(map.size(), 1U);
      EXPECT_NEAR(map[0].rock.center_W.x(), goal.x_m, 0.006);
      EXPECT_NEAR(map[0].rock.center_W.y(), goal.y_m, 0.006);
      if (kind == PanError::kFixed) {
        EXPECT_GT(std::hypot(goal.x_m - 20.0, goal.y_m), 0.3);
      }
    }
  }
}

TEST(LanderMapTest, OneRockOrErrorShiftsNoOther) {
  CourseParams course = ExactCourse();
  course.lander_map.edge_sd_px = 1.0;
  course.lander_map.disparity_sd_px = 0.1;
  const terrain::Rock first = Dome(9.0, 1.0, 0.2, 0.3);
  const std::vector<MappedRock> one = Map(course, {first});
  const std::vector<MappedRock> two = Map(course, {first, first});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].rock.center_W, one[0].rock.center_W);
  EXPECT_EQ(two[0].rock.height_m, one[0].rock.height_m);
  EXPECT_NE(two[1].rock.height_m, one[0].rock.height_m);
  EXPECT_NE(Map(course, {first}, {1, 1})[0].rock.height_m, one[0].rock.height_m);
  course.lander_map.edge_sd_px = 0.0;
  const terrain::Rock exact_edges = Map(course, {first})[0].rock;
  EXPECT_NEAR(Distance(exact_edges) - exact_edges.semi_axes_m.x(),
              Distance(one[0].rock) - one[0].rock.semi_axes_m.x(), 1e-9);
}

// Edges that are found 100 pixels off leave rocks without any width, or none at all.
TEST(LanderMapTest, ARockWithoutSizeIsNotInTheMap) {
  CourseParams course = ExactCourse();
  course.lander_map.edge_sd_px = 100.0;
  std::size_t known = 0;
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    for (const MappedRock& rock : Map(course, {Dome(20.0, 0.0, 0.05, 0.1)}, {3, trial})) {
      EXPECT_GT(rock.rock.semi_axes_m.x(), 0.0);
      EXPECT_GT(rock.rock.height_m, 0.0);
      ++known;
    }
  }
  // Half of the widths and half of the heights are above 0.
  EXPECT_GT(known, 25U);
  EXPECT_LT(known, 85U);
}

}  // namespace
}  // namespace rockyard::trial
