// The estimator alone on the tracks of a real drive, beside what another program made of them.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "vision/cameras/rectification.h"
#include "vision/odometry/consistent_set.h"

namespace rockyard::vision {
namespace {

const std::string kFolder = ROCKYARD_SOURCE_DIR "/tests/data/odometry/";

// The camera of tests/data/odometry/SOURCE.txt; the outer frame is the left camera's.
RectifiedPair DrivePair() {
  constexpr double kFocal_px = 721.5377;
  const Cahv left{{0, 0, 0}, {0, 0, 1}, {kFocal_px, 0, 609.5593}, {0, kFocal_px, 172.854}};
  Cahv right = left;
  right.C = {0.537150588, 0, 0};
  return {left, right, {1241, 376}, kFocal_px, 0.537150588};
}

using Tracks = std::map<int, StereoMeasurement>;  // by the number of the point

std::vector<Tracks> ReadTracks(const RectifiedPair& pair) {
  std::vector<Tracks> tracks;
  std::ifstream file(kFolder + "gtsam_tracks.txt");
  int number = 0;
  int point = 0;
  double left = 0.0;
  double right = 0.0;
  double row = 0.0;
  while (file >> number >> point >> left >> right >> row) {
    tracks.resize(std::max(tracks.size(), static_cast<std::size_t>(number)));
    StereoMeasurement seen{.left = {left, row},
                           .disparity_px = left - right,
                           .covariance_px2 = Eigen::Vector3d(0.25, 0.25, 0.25).asDiagonal()};
    const auto place = Triangulate(pair.left, pair.right, seen.left, seen.disparity_px);
    if (!place) continue;
    seen.p_A = place->p_A;
    seen.covariance_m2 = place->Covariance(seen.covariance_px2);
    tracks[static_cast<std::size_t>(number) - 1][point] = seen;
  }
  return tracks;
}

std::vector<math::Transform> ReadPoses() {
  std::vector<math::Transform> poses;
  std::ifstream file(kFolder + "gtsam_poses.txt");
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream numbers(line);
    int number = 0;
    if (!(numbers >> number)) continue;
    math::Transform X_WC = math::Transform::Identity();
    for (int i = 0; i < 16; ++i) numbers >> X_WC.matrix()(i / 4, i % 4);
    poses.push_back(X_WC);
  }
  return poses;
}

PointsSeenTwice Common(const Tracks& first, const Tracks& second) {
  PointsSeenTwice points;
  for (const auto& [point, seen] : first) {
    const auto again = second.find(point);
    if (again != second.end()) points.push_back({seen, again->second});
  }
  return points;
}

class GtsamTracksTest : public testing::TestWithParam<SelectionMethod> {};

// Every step within 1.2 cm of 92 cm and 0.025 deg.
TEST_P(GtsamTracksTest, EveryStepIsThatOfTheOtherProgram) {
  const RectifiedPair pair = DrivePair();
  const std::vector<Tracks> tracks = ReadTracks(pair);
  const std::vector<math::Transform> poses = ReadPoses();
  ASSERT_EQ(tracks.size(), 26u);
  ASSERT_EQ(poses.size(), 26u);
  const SelectionParams selection{.method = GetParam()};
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const PointsSeenTwice points = Common(tracks[i], tracks[i + 1]);
    core::RandomStream stream({25, 0}, core::Purpose::kRansac, static_cast<std::uint32_t>(i));
    const auto set = FindConsistentSet(points, pair, selection, stream);
    ASSERT_TRUE(set) << i;
    const EstimatedMotion found = MotionOfSet(points, pair, *set, selection, {}).estimated;
    ASSERT_TRUE(found.motion) << i;
    const math::Transform off = (poses[i].inverse() * poses[i + 1]).inverse() * found.motion->X_FS;
    EXPECT_LT(off.translation().norm(), 0.012) << i;
    EXPECT_LT(math::RadToDeg(Eigen::AngleAxisd(off.linear()).angle()), 0.025) << i;
    RecordProperty(
        "step_" + std::to_string(i) + "_mm_millideg",
        std::to_string(off.translation().norm() * 1e3) + " " +
            std::to_string(1e3 * math::RadToDeg(Eigen::AngleAxisd(off.linear()).angle())));
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, GtsamTracksTest,
                         testing::Values(SelectionMethod::kRansac, SelectionMethod::kRigidity));

}  // namespace
}  // namespace rockyard::vision
