// Every rover of scenarios/rovers stands, drives, turns and climbs in the multibody simulation.
#include <gtest/gtest.h>

#include "rover_drive.h"
#include "scenario/load.h"

namespace rockyard::rover {
namespace {

struct Described {
  const char* file;
  double gravity_m_s2;
};

class RoverDescription : public testing::TestWithParam<Described> {
 protected:
  void StartOn(const terrain::Terrain& terrain) {
    rover_ = MakeRover(params_, terrain);
    rover_->Place({});
  }
  const truth::RoverState& state() const { return rover_->state(); }
  double x() const { return state().X_WR.translation().x(); }

  const RoverParams params_ =
      scenario::ParseScenario(R"({"rover": {"extends": ")" + std::string(GetParam().file) +
                                  R"(.json", "physics": {"gravity_m_s2": )" +
                                  std::to_string(GetParam().gravity_m_s2) + "}}}",
                              {}, std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/rovers")
          .drive.rover;
  const double speed_m_s_ = params_.drive.speed_m_s;
  const terrain::Terrain flat_ = FlatTerrain();
  std::unique_ptr<Rover> rover_;
};

// The bogie wheels carry half of what their pivot does, so that loads differ, but not by much.
TEST_P(RoverDescription, StandsOnLevelGround) {
  StartOn(flat_);
  RunFor(*rover_, kBraked, 2.0);
  const double weight_N = params_.mass.total_kg * params_.physics.gravity_m_s2;
  double sum_N = 0.0;
  for (const double load_N : state().wheel_load_N) {
    EXPECT_GT(load_N, 0.6 * weight_N / 6.0);
    EXPECT_LT(load_N, 1.4 * weight_N / 6.0);
    sum_N += load_N;
  }
  EXPECT_NEAR(sum_N, weight_N, 0.005 * weight_N);
  EXPECT_LT(math::Tilt(state().X_WR), math::DegToRad(0.3));
  EXPECT_NEAR(state().X_WR.translation().z(), 0.0, 0.1 * params_.geometry.wheel_radius_m);
  EXPECT_TRUE(state().contacts.empty());
}

// On level sand Rocky 3.2 slips by 8 %, all rovers by less than a tenth.
TEST_P(RoverDescription, DrivesStraight) {
  StartOn(flat_);
  const double time_s = 0.3 / speed_m_s_;
  // Coming to speed takes half the ramp's time of the way.
  RunFor(*rover_, Drive(params_, speed_m_s_, 0.0), time_s + 0.5 * rover_->ramp_s());
  EXPECT_GT(x(), 0.9 * 0.3);
  EXPECT_LT(x(), 1.005 * 0.3);
  EXPECT_NEAR(state().X_WR.translation().y(), 0.0, 2e-3);
  EXPECT_NEAR(math::Heading(state().X_WR), 0.0, 5e-3);
}

TEST_P(RoverDescription, TurnsInPlace) {
  StartOn(flat_);
  const RoverGeometry geometry = MakeRoverGeometry(params_.geometry);
  const double rate_rad_s = speed_m_s_ / geometry.wheel_R[0].head<2>().norm();
  const messages::WheelCommand command = Drive(params_, 0.0, rate_rad_s);
  for (const double steer_rad : command.steer_rad) {
    ASSERT_LE(std::abs(steer_rad), params_.drive.max_steer_rad);
  }
  RunFor(*rover_, SteerOnly(command),
         1.1 * params_.drive.max_steer_rad / params_.drive.steer_rate_rad_s);
  const double turn_rad = math::DegToRad(20.0);
  RunFor(*rover_, command, turn_rad / rate_rad_s + 0.5 * rover_->ramp_s());
  EXPECT_LT(math::Heading(state().X_WR), 1.005 * turn_rad);
  EXPECT_GT(math::Heading(state().X_WR), 0.9 * turn_rad);
  EXPECT_LT(state().X_WR.translation().head<2>().norm(), 0.02);
}

// Onto a vertical step of a wheel radius with all axles; of half of it where the rockers come first
// (rover_geometry_params.cc).
TEST_P(RoverDescription, ClimbsAStep) {
  const RoverGeometryParams& geometry = params_.geometry;
  const double share = geometry.bogie_end == BogieEnd::kFront ? 1.0 : 0.5;
  const double height_m = share * geometry.wheel_radius_m;
  const terrain::Terrain step =
      StepTerrain(height_m, BekkerSoil(), 0.01, std::max(1.2, 1.6 * geometry.wheelbase_m));
  StartOn(step);
  // The step begins at x = 0.6.
  const double ahead_m = 0.5 * geometry.wheelbase_m + geometry.wheel_radius_m;
  const double start_m = std::min(0.0, 0.55 - ahead_m);
  rover_->Place({start_m, 0.0, 0.0});
  const double all_on_it_m = 0.6 + 0.5 * geometry.wheelbase_m + geometry.wheel_radius_m;
  const messages::WheelCommand command = Drive(params_, speed_m_s_, 0.0);
  const auto steps =
      static_cast<int>(2.0 * (all_on_it_m - start_m) / speed_m_s_ / rover_->step_s());
  for (int i = 0; i < steps && x() < all_on_it_m; ++i) rover_->Step(command);
  EXPECT_GE(x(), all_on_it_m);
  EXPECT_NEAR(state().X_WR.translation().z(), height_m, 0.1 * geometry.wheel_radius_m);
}

INSTANTIATE_TEST_SUITE_P(Rovers, RoverDescription,
                         testing::Values(Described{"rocky_3_2", 9.81}, Described{"mfex", 9.81},
                                         Described{"mfex", 3.72}, Described{"athena_sdm", 9.81},
                                         Described{"athena_2012", 9.81},
                                         Described{"perseverance_like", 3.72}),
                         [](const auto& tested) {
                           return std::string(tested.param.file) +
                                  (tested.param.gravity_m_s2 < 5.0 ? "_mars" : "_earth");
                         });

}  // namespace
}  // namespace rockyard::rover
