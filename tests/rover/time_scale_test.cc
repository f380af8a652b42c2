// A slow rover simulated faster than real against the same rover in real time.

#include "core/archive.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "rover_drive.h"

namespace rockyard::rover {
namespace {

constexpr double kMfexSpeed_m_s = 0.0067;

RoverParams SlowRover(double time_scale) {
  return RoverParams{.drive = {.speed_m_s = kMfexSpeed_m_s}, .physics = {.time_scale = time_scale}};
}

// scenarios/rovers/mfex.json where it differs from the defaults, on Mars.
RoverParams MfexOnMars(double time_scale) {
  RoverParams params = SlowRover(time_scale);
  params.mass = {.total_kg = 11.5,
                 .wheel_kg = 0.3,
                 .rocker_kg = 0.5,
                 .bogie_kg = 0.35,
                 .chassis_com_x_m = 0.0,
                 .chassis_com_z_m = 0.17};
  params.drive.stall_torque_Nm = 2.3;
  params.drive.steer_rate_rad_s = math::DegToRad(6.0);
  params.contact.stiffness_N_m = 30000.0;
  params.contact.damping_Ns_m = 480.0;
  params.physics.gravity_m_s2 = 3.72;
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

// Sampled at the steps of scale `sampled_at`.
std::vector<Sample> DriveFor(double time_s, const RoverParams& params, double sampled_at,
                             const terrain::Terrain& terrain) {
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand command = Drive(params, kMfexSpeed_m_s, 0.0);
  const int every = static_cast<int>(std::lround(sampled_at / params.physics.time_scale));
  std::vector<Sample> samples;
  for (int i = 1; static_cast<double>(i) * rover->step_s() <= time_s; ++i) {
    rover->Step(command);
    if (i % every != 0) continue;
    const math::Transform& X_WR = rover->state().X_WR;
    samples.push_back({X_WR.translation(), Pitch(X_WR), std::asin(X_WR.linear()(2, 1))});
  }
  return samples;
}

// The course in 400 s, faster than real against real. One set of bounds for all, since inertia
// against weight goes as v^2 / (g r): 0.034 on Earth at scale 22, 0.019 on Mars at scale 10. A
// pitch of 0.3 deg is 2.7 mm from the front to the rear wheels.
void ExpectSameCourse(const RoverParams& at_real_time, const RoverParams& faster) {
  const terrain::Terrain terrain = RockyCourse();
  const double scale = faster.physics.time_scale;
  const std::vector<Sample> real = DriveFor(400.0, at_real_time, scale, terrain);
  const std::vector<Sample> scaled = DriveFor(400.0, faster, scale, terrain);
  ASSERT_EQ(real.size(), scaled.size());
  EXPECT_GT(real.back().p_WR.x(), 1.5);
  double pitch2 = 0.0, largest_rad = 0.0, roll2 = 0.0, max_pitch = 0.0, apart_m = 0.0;
  for (std::size_t i = 0; i < real.size(); ++i) {
    largest_rad = std::max(largest_rad, std::abs(real[i].pitch_rad - scaled[i].pitch_rad));
    pitch2 += std::pow(real[i].pitch_rad - scaled[i].pitch_rad, 2.0);
    roll2 += std::pow(real[i].roll_rad - scaled[i].roll_rad, 2.0);
    max_pitch = std::max(max_pitch, std::abs(real[i].pitch_rad));
    apart_m = std::max(apart_m, (real[i].p_WR - scaled[i].p_WR).norm());
  }
  const double count = static_cast<double>(real.size());
  const double pitch_deg = math::RadToDeg(std::sqrt(pitch2 / count));
  const double roll_deg = math::RadToDeg(std::sqrt(roll2 / count));
  testing::Test::RecordProperty("pitch_rms_deg", std::to_string(pitch_deg));
  testing::Test::RecordProperty("pitch_largest_deg", std::to_string(math::RadToDeg(largest_rad)));
  testing::Test::RecordProperty("roll_rms_deg", std::to_string(roll_deg));
  testing::Test::RecordProperty("apart_m", std::to_string(apart_m));
  EXPECT_GT(max_pitch, math::DegToRad(3.0));  // there is something to compare
  EXPECT_LT(pitch_deg, 0.3);
  EXPECT_LT(roll_deg, 0.3);
  EXPECT_LT(apart_m, 0.03);
}

TEST(TimeScale, SameCourseAtTwentyTwoTimesTheSpeed) {
  ExpectSameCourse(SlowRover(1.0), SlowRover(22.0));
}

TEST(TimeScale, SameCourseOfTheFlightRoverOnMarsAtTenTimesTheSpeed) {
  ExpectSameCourse(MfexOnMars(1.0), MfexOnMars(10.0));
}

// Times, speeds and rates are real ones; loads do not know.
TEST(TimeScale, ReportsRealTimesAndVelocities) {
  const terrain::Terrain terrain = FlatTerrain();
  truth::RoverState state[2];
  double ramp_s[2] = {};
  const double scales[] = {1.0, 22.0};
  for (int i = 0; i < 2; ++i) {
    const RoverParams params = SlowRover(scales[i]);
    const auto rover = PlacedRover(params, terrain);
    EXPECT_DOUBLE_EQ(rover->step_s(), scales[i] / 60.0);
    EXPECT_DOUBLE_EQ(rover->ramp_s(), scales[i] * params.drive.ramp_s);
    ramp_s[i] = rover->ramp_s();
    RunFor(*rover, Drive(params, kMfexSpeed_m_s, 0.0), 44.0);
    state[i] = rover->state();
  }
  EXPECT_NEAR(state[1].v_WR_m_s.x(), state[0].v_WR_m_s.x(), 0.01 * kMfexSpeed_m_s);
  // A ramp that is so many times longer costs half of that time of the way; beyond it, getting
  // under way takes a part of one step.
  const double late_m = 0.5 * (ramp_s[1] - ramp_s[0]) * kMfexSpeed_m_s;
  EXPECT_NEAR(state[1].X_WR.translation().x(), state[0].X_WR.translation().x() - late_m,
              22.0 / 60.0 * kMfexSpeed_m_s);
  EXPECT_NEAR(state[1].wheel_angle_rad[0],
              state[0].wheel_angle_rad[0] - late_m / SlowRover(1.0).geometry.wheel_radius_m, 0.02);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    EXPECT_NEAR(state[1].wheel_load_N[i], state[0].wheel_load_N[i], 0.2);
  }
}

TEST(TimeScale, SteersAtTheRealRate) {
  const RoverParams params = SlowRover(22.0);
  const RoverOn rover(FlatTerrain(), params);
  messages::WheelCommand command;
  command.steer_rad.fill(1.0);
  rover->Step(command);
  EXPECT_NEAR(rover->state().steer_rad[0], params.drive.steer_rate_rad_s * 22.0 / 60.0, 1e-12);
}

// What is wrong with a rover of that speed and scale; empty where nothing is.
std::string Problems(double speed_m_s, double time_scale, double gravity_m_s2 = 9.81) {
  RoverParams params;
  return core::RefusalOf([&] {
    core::ReadParams(
        core::ParseJson("{\"drive\": {\"speed_m_s\": " + std::to_string(speed_m_s) +
                            "}, \"physics\": {\"time_scale\": " + std::to_string(time_scale) +
                            ", \"gravity_m_s2\": " + std::to_string(gravity_m_s2) + "}}",
                        "test"),
        params);
  });
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
  // On Mars the speed of the same Froude number is lower: 0.2 sqrt(3.72 / 9.81) = 0.123 m/s, which
  // is 18.38 times 0.67 cm/s.
  EXPECT_EQ(Problems(kMfexSpeed_m_s, 18.0, 3.72), "");
  const std::string on_mars = Problems(kMfexSpeed_m_s, 19.0, 3.72);
  EXPECT_NE(on_mars.find("0.123 m/s"), std::string::npos) << on_mars;
  EXPECT_NE(on_mars.find("18.38"), std::string::npos) << on_mars;
}

}  // namespace
}  // namespace rockyard::rover
