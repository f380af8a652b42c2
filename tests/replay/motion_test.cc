#include "replay/motion.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace rockyard::replay {
namespace {

using testing::ElementsAre;

ReplayPose PoseAt(double time_s, double x_m, double y_m, double heading_rad,
                  const char* activity = "drive") {
  ReplayPose pose;
  pose.sample.time_s = time_s;
  pose.sample.pose = {x_m, y_m, heading_rad};
  pose.sample.estimate = {x_m, y_m, heading_rad, 0.0};
  pose.sample.activity = activity;
  pose.sample.posture.X_WR = math::MakePose({x_m, y_m, 0.0}, heading_rad, 0.0, 0.0);
  pose.joint_rad = {0.0};
  return pose;
}

std::vector<ReplayPose> StraightLine(int moments) {
  std::vector<ReplayPose> poses;
  for (int i = 0; i < moments; ++i) poses.push_back(PoseAt(i, 0.1 * i, 0.0, 0.0));
  return poses;
}

// A circle of one metre, driven once.
std::vector<ReplayPose> Circle(int moments) {
  std::vector<ReplayPose> poses;
  for (int i = 0; i < moments; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / (moments - 1);
    poses.push_back(
        PoseAt(i, std::sin(angle_rad), 1.0 - std::cos(angle_rad), math::WrapAngle(angle_rad)));
  }
  return poses;
}

// Of every moment that is left out, as a share of the tolerance.
double WorstError(const std::vector<ReplayPose>& poses, const ThinnedMotion& motion) {
  double worst = 0.0;
  for (std::size_t k = 1; k < motion.kept.size(); ++k) {
    for (std::size_t i = motion.kept[k - 1] + 1; i < motion.kept[k]; ++i) {
      worst = std::max(worst, ShownError(poses[motion.kept[k - 1]], poses[motion.kept[k]], poses[i],
                                         motion.tolerance));
    }
  }
  return worst;
}

TEST(ReplayMotion, AStraightLineNeedsItsEnds) {
  EXPECT_THAT(ThinMotion(StraightLine(100)).kept, ElementsAre(0, 99));
}

TEST(ReplayMotion, KeepsWhatIsOffTheLine) {
  std::vector<ReplayPose> poses = StraightLine(11);
  poses[4].joint_rad[0] = math::DegToRad(3.0);
  EXPECT_THAT(ThinMotion(poses).kept, testing::Contains(4));
  poses = StraightLine(11);
  poses[6].sample.estimate.y_m = 0.003;
  EXPECT_THAT(ThinMotion(poses).kept, testing::Contains(6));
}

TEST(ReplayMotion, KeepsTheEndOfEveryActivity) {
  std::vector<ReplayPose> poses = StraightLine(10);
  for (std::size_t i = 3; i < 6; ++i) poses[i].sample.activity = "scan";
  EXPECT_THAT(ThinMotion(poses).kept, ElementsAre(0, 2, 5, 9));
}

TEST(ReplayMotion, NothingIsInterpolatedAcrossASettingBack) {
  std::vector<ReplayPose> poses = StraightLine(10);
  poses[5].set_back = true;
  EXPECT_THAT(ThinMotion(poses).kept, ElementsAre(0, 4, 5, 9));
}

TEST(ReplayMotion, ACurveStaysWithinTheTolerance) {
  const std::vector<ReplayPose> poses = Circle(5000);
  const ThinnedMotion motion = ThinMotion(poses);
  EXPECT_LE(WorstError(poses, motion), 1.0);
  EXPECT_LT(motion.kept.size(), 200U);
  // It keeps no more than it must: half the tolerance needs more moments.
  EXPECT_GT(motion.kept.size(), 40U);
}

TEST(ReplayMotion, TooManyMomentsLoosenTheTolerance) {
  const std::vector<ReplayPose> poses = Circle(5000);
  const ThinnedMotion motion = ThinMotion(poses, 20);
  EXPECT_LE(motion.kept.size(), 20U);
  EXPECT_GT(motion.tolerance.position_m, 0.002);
  EXPECT_LE(WorstError(poses, motion), 1.0);
  EXPECT_EQ(motion.kept.back(), poses.size() - 1);
}

TEST(ReplayMotion, HeadingsGoTheShortWayRound) {
  const double turn_rad = math::DegToRad(359.0);
  const ReplayPose before = PoseAt(0, 0, 0, 0.0);
  const ReplayPose after = PoseAt(2, 0, 0, math::WrapAngle(turn_rad));
  EXPECT_LT(ShownError(before, after, PoseAt(1, 0, 0, math::DegToRad(-0.5)), {}), 1e-6);
  EXPECT_GT(ShownError(before, after, PoseAt(1, 0, 0, math::DegToRad(179.5)), {}), 100.0);
}

TEST(ReplayMotion, NothingAndOneMoment) {
  EXPECT_TRUE(ThinMotion({}).kept.empty());
  EXPECT_THAT(ThinMotion(StraightLine(1)).kept, ElementsAre(0));
}

}  // namespace
}  // namespace rockyard::replay
