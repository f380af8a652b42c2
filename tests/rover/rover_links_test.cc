// The tree of links against the geometry of the rover and the simulated one.
#include "rover/rover_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "rover/rover_layout_params.h"
#include "rover/rover_params.h"
#include "rover_drive.h"
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

TEST(MassProperties, BodiesMakeTheRover) {
  RoverParams params{.mass = {.chassis_com_x_m = 0.02}};
  const RoverMasses m = MakeRoverMasses(params);
  EXPECT_NEAR(
      m.chassis.mass_kg + 2.0 * (m.rocker.mass_kg + m.bogie.mass_kg) + 6.0 * m.wheel.mass_kg,
      params.mass.total_kg, 1e-12);
  EXPECT_EQ(m.chassis.com_B, math::Vector3(0.02, 0.0, params.mass.chassis_com_z_m));
}

// A cylinder: m r^2 / 2 about its axis, m (3 r^2 + w^2) / 12 across; a box: m (a^2 + b^2) / 12.
TEST(MassProperties, MomentsOfInertiaAreThoseOfCylinderAndBox) {
  const RoverParams params;
  const RoverMasses m = MakeRoverMasses(params);
  const double r = params.geometry.wheel_radius_m;
  const double w = params.geometry.wheel_width_m;
  EXPECT_DOUBLE_EQ(m.wheel.inertia_kg_m2.y(), 0.5 * m.wheel.mass_kg * r * r);
  EXPECT_DOUBLE_EQ(m.wheel.inertia_kg_m2.x(), m.wheel.mass_kg * (3.0 * r * r + w * w) / 12.0);
  EXPECT_EQ(m.wheel.inertia_kg_m2.x(), m.wheel.inertia_kg_m2.z());
  const double length = params.geometry.belly_length_m;
  const double width = params.geometry.belly_width_m;
  EXPECT_DOUBLE_EQ(m.chassis.inertia_kg_m2.z(),
                   m.chassis.mass_kg * (length * length + width * width) / 12.0);
}

// Forces and moments about the lateral axis balance, on whichever end the bogies are.
TEST(StaticLoads, CarryTheRoverAndItsMoment) {
  for (const BogieEnd end : {BogieEnd::kFront, BogieEnd::kRear}) {
    RoverParams params{.geometry = {.bogie_end = end}, .mass = {.chassis_com_x_m = 0.02}};
    const messages::PerWheel<double> load_N = StaticWheelLoads(params);
    const RoverGeometry g = MakeRoverGeometry(params.geometry);
    const Weights w(params);
    double sum_N = 0.0;
    double moment_Nm = -w.chassis_N * params.mass.chassis_com_x_m;
    for (std::size_t side = 0; side < 2; ++side) {
      moment_Nm -= w.rocker_N * g.rocker_pivot_R[side].x() + w.bogie_N * g.bogie_pivot_R[side].x();
    }
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      sum_N += load_N[i];
      moment_Nm += (load_N[i] - w.wheel_N) * g.wheel_R[i].x();
      EXPECT_EQ(load_N[i], load_N[i % 3]);
    }
    EXPECT_NEAR(sum_N, w.total_N, 1e-9);
    EXPECT_NEAR(moment_Nm, 0.0, 1e-9);
    // The bogie's wheels stand on even levers.
    const std::size_t bogie_outer = end == BogieEnd::kFront ? 0 : 2;
    EXPECT_NEAR(load_N[bogie_outer], load_N[1], 1e-9);
  }
}

// With the chassis' centre of mass on either end of the range some wheels carry nothing, and
// within it all carry something.
TEST(StaticLoads, AllWheelsCarryWithinTheRange) {
  for (const BogieEnd end : {BogieEnd::kFront, BogieEnd::kRear}) {
    RoverParams params{.geometry = {.bogie_end = end}};
    params.mass.chassis_com_x_m = 0.5;  // does not matter
    const ComRange range = StandingComRange(params);
    const auto least_N = [&params](double com_x_m) {
      params.mass.chassis_com_x_m = com_x_m;
      const messages::PerWheel<double> load_N = StaticWheelLoads(params);
      return *std::min_element(load_N.begin(), load_N.end());
    };
    for (const double limit_m : {range.min_m, range.max_m}) {
      EXPECT_NEAR(least_N(limit_m), 0.0, 1e-9);
      EXPECT_LT(std::abs(limit_m), params.geometry.length_m);
    }
    EXPECT_LT(least_N(range.min_m - 1e-3), 0.0);
    EXPECT_GT(least_N(range.min_m + 1e-3), 0.0);
    EXPECT_GT(least_N(range.max_m - 1e-3), 0.0);
    EXPECT_LT(least_N(range.max_m + 1e-3), 0.0);
  }
}

// A rover put down braked stays level just within the range and falls over just beyond it.
TEST(StaticLoads, RoverFallsOverBeyondTheRange) {
  RoverParams params;
  const ComRange range = StandingComRange(params);
  const auto tilt_rad = [&params](double com_x_m) {
    params.mass.chassis_com_x_m = com_x_m;
    const RoverOn rover(FlatTerrain(), params);
    RunFor(*rover, kBraked, 5.0);
    return math::Tilt(rover->state().X_WR);
  };
  constexpr double kMargin_m = 0.02;
  EXPECT_LT(tilt_rad(range.min_m + kMargin_m), math::DegToRad(2.0));
  EXPECT_LT(tilt_rad(range.max_m - kMargin_m), math::DegToRad(2.0));
  EXPECT_GT(tilt_rad(range.min_m - kMargin_m), math::DegToRad(10.0));
  EXPECT_GT(tilt_rad(range.max_m + kMargin_m), math::DegToRad(10.0));
}

// Against the simulation on ground without friction, which would make loads indeterminate.
TEST(StaticLoads, AgreeWithTheSimulation) {
  RoverParams params{.mass = {.chassis_com_x_m = -0.03}};
  terrain::SoilParams smooth = terrain::MakeSoil(terrain::SoilPreset::kHardGround);
  smooth.friction_angle_rad = 0.0;
  terrain::GroundParams ground{.soil = smooth};
  const RoverOn rover(terrain::Terrain(terrain::Ground(ground, {}), {}, {}), params);
  RunFor(*rover, kBraked, 3.0);
  const messages::PerWheel<double> load_N = StaticWheelLoads(params);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    EXPECT_NEAR(rover->state().wheel_load_N[i], load_N[i], 0.1) << i;
  }
}

}  // namespace
}  // namespace rockyard::rover
