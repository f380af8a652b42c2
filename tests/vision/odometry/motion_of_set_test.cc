// The set that is taken anew by its own motion.
#include "vision/odometry/motion_of_set.h"

#include <gtest/gtest.h>

#include "vision/odometry/synthetic_points.h"

namespace rockyard::vision {
namespace {

// From ten points of a hundred, of which the last ten were seen elsewhere.
TEST(MotionOfSetTest, TakesAllPointsThatMovedWithTheSet) {
  const RectifiedPair pair = OdometryPair();
  core::RandomStream stream({259, 0}, core::Purpose::kTest, 0);
  PointsSeenTwice points = SeeTwice(pair, TestMotion(), PointField(), stream);
  for (std::size_t i = 90; i < 100; ++i) points[i].second.left += Pixel(8.0, -6.0);
  ConsistentSet set;
  for (std::size_t i = 0; i < 10; ++i) set.members.push_back(i);
  set.X_FS = TestMotion();
  const SelectionParams selection;
  EstimationParams estimation;
  estimation.max_fit = 1.0e-9;  // no motion, and yet a set
  const EstimatedMotion once = EstimateMotion(PointsSeenTwice(points.begin(), points.begin() + 10),
                                              pair, estimation, set.X_FS);
  const SetMotion found = MotionOfSet(points, pair, set, selection, estimation);
  EXPECT_GE(found.members.size(), 85u);
  EXPECT_LT(found.members.back(), 90u);
  EXPECT_EQ(found.members, PointsWith(points, pair, found.estimated.X_FS, selection.inlier_px));
  EXPECT_GT(found.estimated.iterations, once.iterations);
  EXPECT_FALSE(found.estimated.motion);
  EXPECT_EQ(found.estimated.reason, NoMotion::kPoorFit);
}

}  // namespace
}  // namespace rockyard::vision
