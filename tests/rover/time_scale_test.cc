// A slow rover simulated faster than real against the same rover in real time.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "rover_drive.h"

namespace rockyard::rover {
namespace {

constexpr double kMfexSpeed_m_s = 0.0067;

RoverParams SlowRover(double time_scale) {
  RoverParams params;
  params.drive.speed_m_s = kMfexSpeed_m_s;
  params.physics.time_scale = time_scale;
  return params;
}

// Rocks that lift one side at a time, by up to 9 cm.
terrain::Terrain RockyCourse() {
  return FlatTerrain(
      {MakeRock(0.7, 0.2, 0.0, 0.12, 0.12, 0.05), MakeRock(1.1, -0.2, -0.02, 0.2, 0.15, 0.11),
       MakeRock(1.6, 0.18, -0.03, 0.15, 0.2, 0.10), MakeRock(2.1, 0.0, -0.05, 0.3, 0.5, 0.09)});
}

struct Sample {
  math::Vector3 p_WR;
  double pitch_rad, roll_rad;
};

std::vector<Sample> DriveFor(double time_s, double time_scale, const terrain::Terrain& terrain) {
  const RoverParams params = SlowRover(time_scale);
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = Drive(params, kMfexSpeed_m_s, 0.0);
  // Sampled at the steps of scale 22.
  const int every = static_cast<int>(std::lround(22.0 / time_scale));
  std::vector<Sample> samples;
  for (int i = 1; static_cast<double>(i) * rover->step_s() <= time_s; ++i) {
    rover->Step(command);
    if (i % every != 0) continue;
    const math::Transform& X_WR = rover->state().X_WR;
    samples.push_back({X_WR.translation(), Pitch(X_WR), std::asin(X_WR.linear()(2, 1))});
  }
  return samples;
}

TEST(TimeScale, SameCourseAtTwentyTwoTimesTheSpeed) {
  const terrain::Terrain terrain = RockyCourse();
  const std::vector<Sample> real = DriveFor(400.0, 1.0, terrain);
  const std::vector<Sample> scaled = DriveFor(400.0, 22.0, terrain);
  ASSERT_EQ(real.size(), scaled.size());
  EXPECT_GT(real.back().p_WR.x(), 1.5);
  double pitch2 = 0.0, roll2 = 0.0, most_pitch = 0.0, apart_m = 0.0;
  for (std::size_t i = 0; i < real.size(); ++i) {
    pitch2 += std::pow(real[i].pitch_rad - scaled[i].pitch_rad, 2.0);
    roll2 += std::pow(real[i].roll_rad - scaled[i].roll_rad, 2.0);
    most_pitch = std::max(most_pitch, std::abs(real[i].pitch_rad));
    apart_m = std::max(apart_m, (real[i].p_WR - scaled[i].p_WR).norm());
  }
  const double count = static_cast<double>(real.size());
  const double pitch_deg = math::RadToDeg(std::sqrt(pitch2 / count));
  const double roll_deg = math::RadToDeg(std::sqrt(roll2 / count));
  RecordProperty("pitch_rms_deg", std::to_string(pitch_deg));
  RecordProperty("roll_rms_deg", std::to_string(roll_deg));
  RecordProperty("apart_m", std::to_string(apart_m));
  EXPECT_GT(most_pitch, math::DegToRad(3.0));  // there is something to compare
  EXPECT_LT(pitch_deg, 0.3);
  EXPECT_LT(roll_deg, 0.3);
  EXPECT_LT(apart_m, 0.03);
}

// Times, speeds and rates are real ones; loads do not know.
TEST(TimeScale, ReportsRealTimesAndVelocities) {
  const terrain::Terrain terrain = FlatTerrain();
  truth::RoverState state[2];
  const double scales[] = {1.0, 22.0};
  for (int i = 0; i < 2; ++i) {
    const RoverParams params = SlowRover(scales[i]);
    const auto rover = MakeRover(params, terrain);
    rover->Place({});
    EXPECT_DOUBLE_EQ(rover->step_s(), scales[i] / 60.0);
    RunFor(*rover, Drive(params, kMfexSpeed_m_s, 0.0), 44.0);
    state[i] = rover->state();
  }
  EXPECT_NEAR(state[1].v_WR_m_s.x(), state[0].v_WR_m_s.x(), 0.01 * kMfexSpeed_m_s);
  // Getting under way takes a part of one step.
  EXPECT_NEAR(state[1].X_WR.translation().x(), state[0].X_WR.translation().x(),
              22.0 / 60.0 * kMfexSpeed_m_s);
  EXPECT_NEAR(state[1].wheel_angle_rad[0], state[0].wheel_angle_rad[0], 0.02);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    EXPECT_NEAR(state[1].wheel_load_N[i], state[0].wheel_load_N[i], 0.2);
  }
}

TEST(TimeScale, SteersAtTheRealRate) {
  const RoverParams params = SlowRover(22.0);
  const terrain::Terrain terrain = FlatTerrain();
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  messages::WheelCommand command;
  command.steer_rad.fill(1.0);
  rover->Step(command);
  EXPECT_NEAR(rover->state().steer_rad[0], params.drive.steer_rate_rad_s * 22.0 / 60.0, 1e-12);
}

// What is wrong with a rover of that speed and scale; empty where nothing is.
std::string Problems(double speed_m_s, double time_scale) {
  RoverParams params;
  try {
    core::ReadParams(
        core::ParseJson("{\"drive\": {\"speed_m_s\": " + std::to_string(speed_m_s) +
                            "}, \"physics\": {\"time_scale\": " + std::to_string(time_scale) + "}}",
                        "test"),
        params);
  } catch (const core::UserError& error) {
    return error.what();
  }
  return "";
}

TEST(TimeScale, IsRefusedWhereInertiaWouldTell) {
  EXPECT_EQ(Problems(kMfexSpeed_m_s, 22.0), "");
  EXPECT_EQ(Problems(0.05, 4.0), "");
  EXPECT_EQ(Problems(0.15, 1.0), "");
  EXPECT_EQ(Problems(0.5, 1.0), "");  // fast, and in real time
  const std::string problem = Problems(0.15, 2.0);
  EXPECT_NE(problem.find("physics.time_scale"), std::string::npos) << problem;
  EXPECT_NE(problem.find("0.2 m/s"), std::string::npos) << problem;
  EXPECT_NE(Problems(kMfexSpeed_m_s, 40.0), "");
  EXPECT_NE(Problems(kMfexSpeed_m_s, 0.5), "");
}

}  // namespace
}  // namespace rockyard::rover
