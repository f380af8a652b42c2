// The tree of links against the geometry of the rover and the simulated one.
#include "rover/rover_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "rover/rover_layout_params.h"
#include "scenario/load.h"

namespace rockyard::rover {
namespace {

// Poses of all links in R.
std::vector<math::Transform> PosesIn(const std::vector<Link>& links,
                                     const truth::RoverPosture& posture) {
  std::vector<math::Transform> poses;
  for (const Link& link : links) {
    math::Transform X = math::Transform::Identity();
    if (link.parent >= 0) {
      X = poses.at(static_cast<std::size_t>(link.parent)) * Eigen::Translation3d(link.pivot_P) *
          Eigen::AngleAxisd(JointAngle(link, posture), link.axis);
    }
    poses.push_back(X);
  }
  return poses;
}

class RoverLinks : public testing::TestWithParam<const char*> {
 protected:
  RoverGeometryParams Geometry() const {
    return scenario::LoadScenario(std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/" + GetParam())
        .drive.rover.geometry;
  }
};

TEST_P(RoverLinks, WheelsAreWhereTheGeometrySays) {
  const RoverGeometry geometry = MakeRoverGeometry(Geometry());
  const std::vector<Link> links = MakeLinks(Geometry());
  const auto poses = PosesIn(links, {});
  std::set<std::string> names;
  std::size_t wheels = 0;
  std::size_t knuckles = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    EXPECT_TRUE(names.insert(links[i].name).second) << links[i].name;
    EXPECT_LT(links[i].parent, static_cast<int>(i));
    if (links[i].joint == LinkJoint::kSteering) ++knuckles;
    if (links[i].joint != LinkJoint::kWheel) continue;
    ++wheels;
    EXPECT_LT((poses[i].translation() - geometry.wheel_R[links[i].index]).norm(), 1e-12);
  }
  EXPECT_EQ(wheels, messages::kWheelCount);
  EXPECT_EQ(knuckles, static_cast<std::size_t>(
                          std::count(geometry.steered.begin(), geometry.steered.end(), true)));
}

TEST_P(RoverLinks, EveryAngleTurnsItsOwnJoint) {
  truth::RoverPosture posture{.left_rocker_rad = 0.1,
                              .right_rocker_rad = -0.1,
                              .left_bogie_rad = 0.2,
                              .right_bogie_rad = 0.3};
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    posture.steer_rad[i] = 0.4 + 0.01 * static_cast<double>(i);
    posture.wheel_angle_rad[i] = 5.0 + static_cast<double>(i);
  }
  std::set<double> angles;
  const std::vector<Link> links = MakeLinks(Geometry());
  for (const Link& link : links) angles.insert(JointAngle(link, posture));
  EXPECT_EQ(angles.size(), links.size());
}

INSTANTIATE_TEST_SUITE_P(Scenarios, RoverLinks,
                         testing::Values("pathfinder/nominal.json", "gestalt/narrow_course.json",
                                         "gestalt/viking_lander_2.json"));

}  // namespace
}  // namespace rockyard::rover
