// Files of poses: what is written reads back, and what is none is told with its line.
#include "campaign/odometry/pose_text.h"

#include <gmock/gmock.h>

#include <fstream>
#include <string>

#include "core/error.h"
#include "core/refusals.h"
#include "core/test_folder.h"

namespace rockyard::campaign {
namespace {

using math::MakePose;
using math::Transform;
using testing::ElementsAre;
using testing::HasSubstr;

class PoseText : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& text) const {
    std::filesystem::path path = folder_.path() / "poses.txt";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  std::string Complaint(const std::string& text) const {
    return core::RefusalOf([&] { ReadPoses(Write(text)); });
  }

 private:
  core::TestFolder folder_;
};

const std::vector<Transform> kPoses{Transform::Identity(),
                                    MakePose({1.25, -2.0, 0.125}, 2.5, 0.3, -0.4),
                                    MakePose({1e-7, 3e5, -7.0}, -3.1, -1.2, 3.0)};

TEST_F(PoseText, KittisFormReadsBack) {
  const PoseFile read = ReadPoses(Write(KittiPoses(kPoses)));
  ASSERT_EQ(read.poses.size(), kPoses.size());
  EXPECT_FALSE(read.times_s.has_value());
  for (std::size_t i = 0; i < kPoses.size(); ++i) {
    EXPECT_EQ(read.poses[i].translation(), kPoses[i].translation());
    EXPECT_LT((read.poses[i].linear() - kPoses[i].linear()).norm(), 1e-14);
  }
}

TEST_F(PoseText, TumsFormReadsBackWithTimes) {
  const std::vector<double> times_s{0.5, 1.5, 1403636579.7635553};
  const PoseFile read = ReadPoses(Write(TumPoses(kPoses, times_s)));
  ASSERT_EQ(read.poses.size(), kPoses.size());
  EXPECT_THAT(*read.times_s, ElementsAre(0.5, 1.5, 1403636579.7635553));
  for (std::size_t i = 0; i < kPoses.size(); ++i) {
    EXPECT_EQ(read.poses[i].translation(), kPoses[i].translation());
    EXPECT_LT((read.poses[i].linear() - kPoses[i].linear()).norm(), 1e-14);
  }
}

// The order of the numbers, by hand: a quarter turn about z at (1, 2, 3).
TEST_F(PoseText, TheOrderOfTheNumbers) {
  const Transform pose = MakePose({1.0, 2.0, 3.0}, 0.5 * M_PI, 0.0, 0.0);
  const Transform kitti = ReadPoses(Write("0 -1 0 1 1 0 0 2 0 0 1 3\n")).poses[0];
  EXPECT_TRUE(kitti.isApprox(pose, 1e-12));
  const double half = std::sqrt(0.5);
  const std::string number = std::to_string(half);
  const Transform tum = ReadPoses(Write("7, 1 2 3 0 0 " + number + " " + number + "\r\n")).poses[0];
  EXPECT_TRUE(tum.isApprox(pose, 1e-5));
  EXPECT_THAT(KittiPoses({{pose}}), testing::StartsWith("2.220446049250313e-16 -1 0 1 1 "));
}

// Seven digits, as benchmarks write them: the rotation is made exact.
TEST_F(PoseText, RoundedRotationsAreMadeExact) {
  const Transform read =
      ReadPoses(
          Write("0.9999995 7.196824e-04 -6.870876e-04 0 -7.197717e-04 0.9999997 -1.295633e-04 "
                "0 6.869946e-04 1.300585e-04 0.9999998 1\n"))
          .poses[0];
  EXPECT_LT((read.linear().transpose() * read.linear() - Eigen::Matrix3d::Identity()).norm(),
            1e-14);
  EXPECT_NEAR(read.linear()(0, 1), 7.19727e-04, 1e-7);
}

TEST_F(PoseText, WhatIsNoPoseIsTold) {
  EXPECT_THAT(Complaint("1 0 0 0 0 1 0 0 0 0 1\n"), HasSubstr("line 1: has 11 numbers"));
  EXPECT_THAT(Complaint("0 1 2 3 0 0 0 1\n1 0 0 0 0 1 0 0 0 0 1 0\n"),
              HasSubstr("line 2: has 12 numbers"));
  EXPECT_THAT(Complaint("1 0 0 0 0 1 0 0 0 0 -1 0\n"), HasSubstr("line 1: holds no rotation"));
  EXPECT_THAT(Complaint("1.01 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr("holds no rotation"));
  EXPECT_THAT(Complaint("0 1 2 3 0 0 0 1\n\n# x\n1 1 2 3 0 0 0 1.1\n"),
              HasSubstr("line 4: holds no unit quaternion"));
  EXPECT_THAT(Complaint("0 1 2 3 0 0 0 1\n0 1 2 3 0 0 0 1\n"),
              HasSubstr("line 2: its time is not later"));
  EXPECT_THAT(Complaint("0 1 2 3 0 0 nan 1\n"), HasSubstr("\"nan\" is no finite number"));
  EXPECT_THAT(Complaint("0 1 2 3 0 0 1x 1\n"), HasSubstr("\"1x\" is no finite number"));
  EXPECT_THAT(Complaint("# only this\n"), HasSubstr("holds no numbers"));
  EXPECT_THROW(ReadPoses("/nowhere/poses.txt"), core::UserError);
}

TEST_F(PoseText, TimesAreOneALineAndGrow) {
  EXPECT_THAT(ReadTimes(Write(TimesText(std::vector<double>{0.0, 0.1, 2.0}))),
              ElementsAre(0.0, 0.1, 2.0));
  EXPECT_THROW(ReadTimes(Write("0\n1 2\n")), core::UserError);
  EXPECT_THROW(ReadTimes(Write("1\n0\n")), core::UserError);
}

}  // namespace
}  // namespace rockyard::campaign
