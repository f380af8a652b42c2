// Rough ground, blow-up, geometry for the on-board copy.
#include <gtest/gtest.h>

#include <stdexcept>

#include "rover_drive.h"

namespace rockyard::rover {
namespace {

TEST(RoughGround, CarriesTheRoverWithoutSnagging) {
  const RoverParams params;
  terrain::GroundParams ground;
  ground.roughness_rms_m = 0.02;
  const terrain::Terrain terrain(terrain::Ground(ground, {}), {}, {});
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  for (int i = 0; i < 1200; ++i) {
    rover->Step(command);
    const math::Vector3 p_W = rover->state().X_WR.translation();
    ASSERT_NEAR(p_W.z(), terrain.Height(p_W.x(), p_W.y()), 0.06);
  }
  EXPECT_GT(rover->state().X_WR.translation().norm(), 2.7);
}

TEST(Fault, AFallIsReported) {
  const RoverParams params;
  const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(60.0), 0.0, RigidGround(0.0));
  const auto rover = PlacedRover(params, terrain);
  EXPECT_THROW(RunFor(*rover, kBraked, 3.0), std::runtime_error);
}

TEST(Geometry, CalibrationIsTheTrueGeometry) {
  const RoverParams params;
  const messages::DriveCalibration c = MakeDriveCalibration(params);
  EXPECT_EQ(c.wheel_radius_m, 0.065);
  EXPECT_NEAR(c.wheel_x_m[messages::Index(messages::Wheel::kLeftFront)], 0.26, 1e-12);
  EXPECT_NEAR(c.wheel_y_m[messages::Index(messages::Wheel::kRightRear)], -0.20, 1e-12);
  EXPECT_TRUE(c.steered[messages::Index(messages::Wheel::kRightFront)]);
  EXPECT_FALSE(c.steered[messages::Index(messages::Wheel::kRightMiddle)]);
  const Outline body = BodyOutline(params.geometry);
  EXPECT_EQ(body[2], std::make_pair(0.325, 0.24));
}

TEST(Geometry, BogiesInFrontMirrorBogiesBehind) {
  RoverGeometryParams params;
  params.bogie_end = BogieEnd::kRear;
  const RoverGeometry rear = MakeRoverGeometry(params);
  params.bogie_end = BogieEnd::kFront;
  const RoverGeometry front = MakeRoverGeometry(params);
  EXPECT_EQ(front.bogie_pivot_R[0].x(), -rear.bogie_pivot_R[0].x());
  EXPECT_TRUE(front.on_bogie[0] && front.on_bogie[1] && !front.on_bogie[2]);
  EXPECT_TRUE(!rear.on_bogie[0] && rear.on_bogie[1] && rear.on_bogie[2]);
}

}  // namespace
}  // namespace rockyard::rover
