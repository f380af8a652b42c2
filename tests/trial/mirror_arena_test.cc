#include <gtest/gtest.h>

#include "trial/drive/operators.h"

namespace rockyard::trial {
namespace {

const MirrorArena kArena(1.1);

TEST(MirrorArenaTest, NothingHappensInside) {
  EXPECT_FALSE(kArena.Reflect({3.0, 1.09, 1.0}, +1, {}).has_value());
  EXPECT_FALSE(kArena.Reflect({3.0, -1.09, -1.0}, +1, {}).has_value());
}

TEST(MirrorArenaTest, NothingHappensOnTheWayBackIn) {
  EXPECT_FALSE(kArena.Reflect({3.0, 1.12, -0.1}, +1, {}).has_value());
  EXPECT_FALSE(kArena.Reflect({3.0, -1.12, 0.1}, +1, {}).has_value());
}

TEST(MirrorArenaTest, LeftLineMirrorsHeadingAndEstimate) {
  const auto reflection = kArena.Reflect({3.0, 1.1, 0.4}, +1, {2.9, 1.3, 0.5, 4.0});
  ASSERT_TRUE(reflection.has_value());
  EXPECT_DOUBLE_EQ(reflection->pose.x_m, 3.0);
  EXPECT_DOUBLE_EQ(reflection->pose.y_m, 1.1);
  EXPECT_DOUBLE_EQ(reflection->pose.heading_rad, -0.4);
  EXPECT_DOUBLE_EQ(reflection->update.x_m, 2.9);
  EXPECT_DOUBLE_EQ(reflection->update.y_m, 0.9);
  EXPECT_DOUBLE_EQ(reflection->update.heading_rad, -0.5);
}

// A rover that backs off crosses a line tail first.
TEST(MirrorArenaTest, DrivingBackwardsIsOutwardByTheTail) {
  EXPECT_FALSE(kArena.Reflect({3.0, 1.12, 0.4}, -1, {}).has_value());
  EXPECT_FALSE(kArena.Reflect({3.0, -1.12, -0.4}, -1, {}).has_value());
  const auto left = kArena.Reflect({3.0, 1.12, -0.4}, -1, {});
  ASSERT_TRUE(left.has_value());
  EXPECT_DOUBLE_EQ(left->pose.heading_rad, 0.4);
  EXPECT_DOUBLE_EQ(left->line_m, 1.1);
  const auto right = kArena.Reflect({3.0, -1.12, 0.4}, -1, {});
  ASSERT_TRUE(right.has_value());
  EXPECT_DOUBLE_EQ(right->pose.heading_rad, -0.4);
  EXPECT_DOUBLE_EQ(right->line_m, -1.1);
}

// The reflection turns an error into its mirror image: it neither hides nor adds any.
TEST(MirrorArenaTest, ErrorsKeepTheirSize) {
  const math::Pose2 pose{5.0, -1.15, -0.7};
  const messages::PoseEstimate estimate{5.2, -0.8, -0.9, 6.0};
  const auto reflection = kArena.Reflect(pose, +1, estimate);
  ASSERT_TRUE(reflection.has_value());
  EXPECT_NEAR(reflection->update.x_m - reflection->pose.x_m, estimate.x_m - pose.x_m, 1e-15);
  // The true position lies 5 cm beyond the line and stays there; its mirror image lies 5 cm inside.
  const double image_y_m = 2.0 * -1.1 - pose.y_m;
  EXPECT_NEAR(reflection->update.y_m - image_y_m, -(estimate.y_m - pose.y_m), 1e-15);
  EXPECT_NEAR(reflection->update.heading_rad - reflection->pose.heading_rad,
              -(estimate.heading_rad - pose.heading_rad), 1e-15);
}

}  // namespace
}  // namespace rockyard::trial
