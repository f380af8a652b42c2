// Which files are a sequence: the layouts of benchmarks, their order, and what is told of broken
// ones. Files of poses: what is written reads back, and what is none is told with its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "campaign/odometry/pair_reader.h"
#include "campaign/odometry/path_tracker.h"
#include "campaign/odometry/pose_text.h"
#include "campaign/odometry/render_sequence.h"
#include "core/error.h"
#include "core/refusals.h"
#include "core/test_folder.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using math::MakePose;
using math::Transform;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class Sequence : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text = "x") const {
    fs::create_directories((top() / name).parent_path());
    std::ofstream(top() / name, std::ios::binary) << text;
  }
  const fs::path& top() const { return folder_.path(); }

  std::vector<std::string> Names(const fs::path& path) const {
    std::vector<std::string> names;
    for (const SequencePair& pair : FindSequence(path).pairs) {
      names.push_back(fs::relative(pair.left, top()).string() + " " +
                      fs::relative(pair.right, top()).string());
    }
    return names;
  }

  // All problems of a sequence that is none, one a line.
  std::string Complaints(const fs::path& path) const {
    return core::RefusalOf([&] { FindSequence(path); });
  }

 private:
  core::TestFolder folder_;
};

TEST_F(Sequence, FoldersInNaturalOrderWithTimesAndCalibration) {
  for (const char* eye : {"image_0", "image_1"}) {
    for (const char* name : {"10.png", "9.png", "100.png"}) Write(std::string(eye) + "/" + name);
    Write(std::string(eye) + "/.hidden");
  }
  Write("times.txt", "0\n0.5\n2.25\n");
  Write("calib.txt");
  const ImageSequence sequence = FindSequence(top());
  EXPECT_EQ(sequence.layout, "folders image_0 and image_1");
  EXPECT_THAT(Names(top()),
              ElementsAre("image_0/9.png image_1/9.png", "image_0/10.png image_1/10.png",
                          "image_0/100.png image_1/100.png"));
  EXPECT_EQ(sequence.pairs[2].time_s, 2.25);
  EXPECT_EQ(sequence.calibration, top() / "calib.txt");
  EXPECT_TRUE(sequence.left_free.empty());
  Write("left_free.png");
  EXPECT_EQ(FindSequence(top()).left_free, top() / "left_free.png");
  EXPECT_TRUE(FindSequence(top()).right_free.empty());
}

TEST_F(Sequence, NaturalOrder) {
  EXPECT_TRUE(NaturallyBefore("a2", "a10"));
  EXPECT_FALSE(NaturallyBefore("a10", "a2"));
  EXPECT_TRUE(NaturallyBefore("a9b", "a10a"));
  EXPECT_TRUE(NaturallyBefore("a", "a1"));
  EXPECT_TRUE(NaturallyBefore("7.png", "08.png"));
  EXPECT_TRUE(NaturallyBefore("a10", "b2"));
  EXPECT_FALSE(NaturallyBefore("a5", "a5"));
  // Equal as numbers: some order, but one that sorting can rely on.
  EXPECT_NE(NaturallyBefore("a05", "a5"), NaturallyBefore("a5", "a05"));
}

TEST_F(Sequence, MissingPartnersAreNamedAllAtOnce) {
  for (const char* name : {"left/1.png", "left/2.png", "right/2.png", "right/3.png"}) Write(name);
  EXPECT_THAT(Complaints(top()), AllOf(HasSubstr("left/1.png: has no partner"),
                                       HasSubstr("right/3.png: has no partner")));
  for (int i = 10; i < 60; ++i) Write("left/" + std::to_string(i) + ".png");
  EXPECT_EQ(core::ProblemsIn([&] { FindSequence(top()); }).size(), 20u);
  EXPECT_THAT(Complaints(top()), HasSubstr("and 32 more like it"));
}

TEST_F(Sequence, FoldersThatAreNone) {
  EXPECT_THAT(Complaints(top() / "nowhere"), HasSubstr("nowhere: does not exist"));
  EXPECT_THAT(Complaints(top()), HasSubstr("is no sequence of image pairs that is known"));
  fs::create_directories(top() / "left");
  EXPECT_THAT(Complaints(top()), HasSubstr("has a folder left but none right"));
  fs::create_directories(top() / "right");
  EXPECT_THAT(Complaints(top()), HasSubstr("left: holds no images"));
}

TEST_F(Sequence, TimesThatDoNotFit) {
  Write("left/1.png");
  Write("right/1.png");
  Write("times.txt", "0\n1\n");
  EXPECT_THAT(Complaints(top()), HasSubstr("times.txt: has 2 times, there are 1 pairs"));
}

TEST_F(Sequence, EurocsListsAreMatchedByTime) {
  Write("mav0/cam0/data.csv", "#timestamp [ns],filename\n2000000000,b.png\r\n1500000000,a.png\n");
  Write("mav0/cam1/data.csv", "#timestamp [ns],filename\n1500000000,c.png\n2000000000,d.png\n");
  const std::vector<std::string> expected{"mav0/cam0/data/a.png mav0/cam1/data/c.png",
                                          "mav0/cam0/data/b.png mav0/cam1/data/d.png"};
  EXPECT_EQ(Names(top()), expected);
  EXPECT_EQ(Names(top() / "mav0"), expected);
  EXPECT_DOUBLE_EQ(*FindSequence(top()).pairs[0].time_s, 1.5);
  Write("mav0/cam1/data.csv", "1500000000,c.png\n2500000000,d.png\n");
  EXPECT_THAT(Complaints(top()), AllOf(HasSubstr("b.png: has no partner of time 2000000000"),
                                       HasSubstr("d.png: has no partner of time 2500000000")));
  for (const char* line : {"x,d.png", "2000000000", "2000000000,d.png,e.png"}) {
    Write("mav0/cam1/data.csv", std::string("1500000000,c.png\n") + line + "\n");
    EXPECT_THAT(Complaints(top()), HasSubstr("data.csv: line 2: is no time and name"));
  }
}

TEST_F(Sequence, AListNamesFilesBesideIt) {
  Write("list.txt", "# pairs\nl/1.png r/1.png\nl/2.png\tr/2.png 0.5\n\n");
  EXPECT_THAT(Names(top() / "list.txt"), ElementsAre("l/1.png r/1.png", "l/2.png r/2.png"));
  EXPECT_FALSE(FindSequence(top() / "list.txt").pairs[0].time_s.has_value());
  EXPECT_EQ(FindSequence(top() / "list.txt").pairs[1].time_s, 0.5);
  Write("list.txt", "l/1.png\n");
  EXPECT_THAT(Complaints(top() / "list.txt"), HasSubstr("line 1: is no pair of images"));
  Write("list.txt", "a b c\n");
  EXPECT_THAT(Complaints(top() / "list.txt"), HasSubstr("line 1: is no pair of images"));
  Write("list.txt", "# none\n");
  EXPECT_THAT(Complaints(top() / "list.txt"), HasSubstr("lists no pair of images"));
}

// Projections by hand: a point at (1, 2, 4) before camera 1, whose centre lies 0.5 m to the right.
TEST_F(Sequence, KittisCalibrationProjectsAsItsMatricesDo) {
  const std::string P0 = "700 0 600 0 0 710 180 0 0 0 1 0";
  const std::string P1 = "700 0 600 -350 0 710 180 0 0 0 1 0";
  for (const std::string& text : {P0 + "\n" + P1 + "\n", "P0: " + P0 + "\nP1: " + P1 + "\nP2: " +
                                                             P0 + "\nTr: " + P0 + "\n"}) {
    Write("calib.txt", text);
    const vision::CameraPair pair = LoadKittiCalibration(top() / "calib.txt", {1226, 370});
    EXPECT_EQ(pair.right.size.rows, 370);
    const auto left = vision::Project(pair.left, {1.0, 2.0, 4.0});
    const auto right = vision::Project(pair.right, {1.0, 2.0, 4.0});
    EXPECT_NEAR(left->x(), 600.0 + 700.0 / 4.0, 1e-9);
    EXPECT_NEAR(left->y(), 180.0 + 710.0 * 2.0 / 4.0, 1e-9);
    EXPECT_NEAR(right->x(), 600.0 + (700.0 - 350.0) / 4.0, 1e-9);
    EXPECT_NEAR(vision::CentreOf(pair.right).x(), 0.5, 1e-12);
  }
  const auto refused = [&](const std::string& text) {
    Write("calib.txt", text);
    EXPECT_THROW(LoadKittiCalibration(top() / "calib.txt", {1226, 370}), core::UserError) << text;
  };
  refused("");
  refused(P0 + "\n");
  refused("P2: " + P0 + "\nP3: " + P1 + "\n");
  refused(P0 + "\n700 0 600 -350 0 710 180 0 0 0 2 0\n");
  refused(P0 + "\n-700 0 600 -350 0 710 180 0 0 0 1 0\n");
}

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
  EXPECT_THAT(KittiPoses({{pose}}), testing::StartsWith("6.123233995736766e-17 -1 0 1 1 "));
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

// Ways of rendered sequences against circles and polygons.

using math::Pose2;

TEST(SequenceWay, ACircleClosesAfterAWholeTurn) {
  constexpr int kSteps = 36;
  const Pose2 start{1.0, 2.0, 0.3};
  const auto way = CircleWay(start, kSteps + 1, 0.5, 2.0 * std::numbers::pi / kSteps);
  ASSERT_EQ(way.size(), kSteps + 1u);
  EXPECT_NEAR(way.back().x_m, start.x_m, 1e-12);
  EXPECT_NEAR(way.back().y_m, start.y_m, 1e-12);
  // All lie on the circle whose circumference is that of the steps.
  const double radius_m = 0.5 * kSteps / (2.0 * std::numbers::pi);
  const double centre_x = start.x_m - radius_m * std::sin(start.heading_rad);
  const double centre_y = start.y_m + radius_m * std::cos(start.heading_rad);
  for (const Pose2& pose : way) {
    EXPECT_NEAR(std::hypot(pose.x_m - centre_x, pose.y_m - centre_y), radius_m, 1e-12);
  }
}

TEST(SequenceWay, StraightBackwardsAndStanding) {
  const auto back = CircleWay({1.0, 2.0, 0.5 * std::numbers::pi}, 3, -0.25, 0.0);
  EXPECT_NEAR(back[2].x_m, 1.0, 1e-12);
  EXPECT_NEAR(back[2].y_m, 1.5, 1e-12);
  const auto standing = CircleWay({1.0, 2.0, 0.5}, 4, 0.0, 0.0);
  EXPECT_EQ(standing.size(), 4u);
  EXPECT_EQ(standing[3].x_m, 1.0);
  const auto turning = CircleWay({1.0, 2.0, 0.5}, 2, 0.0, 0.1);
  EXPECT_EQ(turning[1].y_m, 2.0);
  EXPECT_DOUBLE_EQ(turning[1].heading_rad, 0.6);
}

// From the origin along x, then to the left: 1 m in steps of 0.4 m, a quarter turn in five.
TEST(SequenceWay, CornersAreTurnedAtAndReached) {
  const messages::Goal corners[] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}};
  const auto way = CornerWay({}, corners, 100, 0.4, 0.4);
  ASSERT_EQ(way.size(), 1u + 3u + 4u + 2u);
  EXPECT_DOUBLE_EQ(way[1].x_m, 0.4);
  EXPECT_DOUBLE_EQ(way[3].x_m, 1.0);
  for (int i = 1; i <= 4; ++i) {
    const Pose2& turned = way[static_cast<std::size_t>(3 + i)];
    EXPECT_DOUBLE_EQ(turned.x_m, 1.0);
    EXPECT_NEAR(turned.heading_rad, i * std::numbers::pi / 8.0, 1e-12);
  }
  EXPECT_DOUBLE_EQ(way[8].y_m, 0.4);
  EXPECT_DOUBLE_EQ(way[9].y_m, 0.5);
  EXPECT_EQ(CornerWay({}, corners, 6, 0.4, 0.4).size(), 6u);
}

// Of a way of 1e300 steps, and of as many turns, the first ones.
TEST(SequenceWay, StepsThatAreNotWantedAreNotTaken) {
  const std::vector<messages::Goal> corners{{1.0, 0.0}, {1.0, 1.0}};
  const auto way = CornerWay({}, corners, 3, 1e-300, 0.4);
  ASSERT_EQ(way.size(), 3u);
  EXPECT_EQ(way[2].x_m, 2e-300);
  const auto turned = CornerWay({0.0, 0.0, 3.0}, corners, 3, 1.0, 1e-300);
  ASSERT_EQ(turned.size(), 3u);
  EXPECT_EQ(turned[2].x_m, 0.0);
}

TEST(SequenceWay, TurnsTakeTheShorterWayRound) {
  const messages::Goal behind[] = {{-1.0, -0.1}};
  const auto way = CornerWay({0.0, 0.0, 3.0}, behind, 100, 1.0, 0.2);
  // From 3 rad over pi to -3.04 rad: 0.24 rad, in two turns.
  ASSERT_EQ(way.size(), 1u + 2u + 2u);
  EXPECT_NEAR(way[1].heading_rad,
              3.0 + 0.5 * (2.0 * std::numbers::pi + std::atan2(-0.1, -1.0) - 3.0), 1e-12);
  // Steps that divide the way, but for rounding, make no further one.
  const messages::Goal ahead[] = {{0.3, 0.0}};
  EXPECT_EQ(CornerWay({}, ahead, 100, 0.1, 0.2).size(), 4u);
}

// Paths from motions against keyframes, against poses put together by hand.

const Transform kStep = MakePose({0.5, 0.1, 0.0}, 0.2, 0.05, 0.0);

vision::OdometryStep Found(std::int64_t number, std::int64_t reference, bool keyframe,
                           const std::optional<Transform>& X_FS) {
  vision::OdometryStep step;
  step.number = number;
  step.reference = reference;
  step.keyframe = keyframe;
  if (X_FS) {
    step.result.motion.emplace();
    step.result.motion->X_FS = *X_FS;
    step.result.motion->covariance = vision::MotionCovariance::Identity();
  } else if (number != reference) {
    step.result.reason = vision::NoMotion::kFewMatches;
  }
  return step;
}

PathStep Place(PathTracker& tracker, const vision::OdometryStep& found,
               const std::optional<Transform>& predicted = std::nullopt) {
  PathStep step;
  tracker.Place(found, predicted, step);
  return step;
}

TEST(PathTracker, MotionsCountFromTheirKeyframe) {
  PathTracker tracker;
  EXPECT_TRUE(Place(tracker, Found(0, 0, true, {})).X_AB.isApprox(Transform::Identity()));
  EXPECT_TRUE(Place(tracker, Found(1, 0, false, kStep)).X_AB.isApprox(kStep));
  EXPECT_TRUE(Place(tracker, Found(2, 0, true, kStep * kStep)).X_AB.isApprox(kStep * kStep));
  const PathStep last = Place(tracker, Found(3, 2, false, kStep));
  EXPECT_TRUE(last.X_AB.isApprox(kStep * kStep * kStep));
  ASSERT_TRUE(last.covariance);
  // Two motions of unit covariance one after the other, with a lever: more than twice one.
  EXPECT_DOUBLE_EQ((*last.covariance)(5, 5), 2.0);
  EXPECT_GT((*last.covariance)(0, 0), 2.0);
}

TEST(PathTracker, TheCovarianceOfAKeyframeCountsOnce) {
  PathTracker tracker;
  Place(tracker, Found(0, 0, true, {}));
  Place(tracker, Found(1, 0, false, kStep));
  Place(tracker, Found(2, 0, false, kStep));
  EXPECT_DOUBLE_EQ((*Place(tracker, Found(3, 0, false, kStep)).covariance)(5, 5), 1.0);
}

TEST(PathTracker, GapsAreFilledByThePredictionAndLoseTheCovariance) {
  PathTracker tracker;
  Place(tracker, Found(0, 0, true, {}));
  Place(tracker, Found(1, 0, true, kStep));
  const Transform predicted = MakePose({0.4, 0.0, 0.0}, 0.0, 0.0, 0.0);
  const PathStep gap = Place(tracker, Found(2, 1, true, {}), predicted);
  EXPECT_TRUE(gap.X_AB.isApprox(kStep * predicted));
  EXPECT_FALSE(gap.covariance);
  const PathStep after = Place(tracker, Found(3, 2, false, kStep));
  EXPECT_TRUE(after.X_AB.isApprox(kStep * predicted * kStep));
  EXPECT_FALSE(after.covariance);

  PathTracker without;
  Place(without, Found(0, 0, true, {}));
  Place(without, Found(1, 0, false, kStep));
  EXPECT_TRUE(Place(without, Found(2, 0, true, {})).X_AB.isApprox(kStep));
}

TEST(PathTracker, PredictionsAreToldInTheKeyframe) {
  PathTracker tracker;
  Place(tracker, Found(0, 0, true, {}));
  EXPECT_FALSE(tracker.Predict(Prediction::kSteady, {}));
  EXPECT_TRUE(tracker.Predict(Prediction::kFile, kStep)->isApprox(kStep));
  EXPECT_FALSE(tracker.Predict(Prediction::kFile, {}));
  Place(tracker, Found(1, 0, false, kStep));
  // The keyframe is still the first pair: two steps from it.
  EXPECT_TRUE(tracker.Predict(Prediction::kSteady, {})->isApprox(kStep * kStep));
  EXPECT_FALSE(tracker.Predict(Prediction::kNone, kStep));
  Place(tracker, Found(2, 0, true, kStep * kStep));
  EXPECT_TRUE(tracker.Predict(Prediction::kSteady, {})->isApprox(kStep));
  const Transform other = MakePose({0.1, 0.0, 0.0}, 0.0, 0.0, 0.0);
  EXPECT_TRUE(tracker.Predict(Prediction::kFile, other)->isApprox(other));
  // A gap that nobody predicted says nothing of the next step.
  Place(tracker, Found(3, 2, true, {}));
  EXPECT_FALSE(tracker.Predict(Prediction::kSteady, {}));
}

}  // namespace
}  // namespace rockyard::campaign
