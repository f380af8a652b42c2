// Spread of what the vehicle sensors report, against what their parameters say.
#include <gtest/gtest.h>

#include <vector>

#include "noise_laws.h"
#include "sensing/vehicle_sensors.h"

namespace rockyard::sensing {
namespace {

constexpr int kTicks = 20000;

TEST(VehicleNoiseTest, DeviationsAreThoseOfTheParameters) {
  VehicleSensorParams params{.articulation = {true, 0.004, 0.0, 0},
                             .accelerometers = {true, 0.03, 0.0, 0},
                             .motor_current = {true, 0.001, 0.0, 0, 20.0, 0.02}};
  rover::RoverParams rover{.physics = {.gravity_m_s2 = 3.72}};
  VehicleSensors sensors(params, rover, {20261121, 0});
  messages::WheelCommand command;
  command.rate_rad_s.fill(1.0);
  std::vector<double> bogie_rad, force_m_s2, current_A;
  for (int tick = 0; tick < kTicks; ++tick) {
    const messages::VehicleState state = sensors.Measure({}, command, 0.1);
    bogie_rad.push_back(state.articulation->right_bogie_rad);
    force_m_s2.push_back(state.specific_force_R->z());
    current_A.push_back((*state.motor_current_A)[4]);
  }
  EXPECT_GT(VarianceP(bogie_rad, 0.0, 0.004), kAlpha);
  EXPECT_GT(VarianceP(force_m_s2, 3.72, 0.03), kAlpha);
  EXPECT_GT(VarianceP(current_A, 0.02, 0.001), kAlpha);
  // Negative control: five per cent more.
  EXPECT_LT(VarianceP(bogie_rad, 0.0, 1.05 * 0.004), kAlpha);
  EXPECT_LT(VarianceP(force_m_s2, 3.72, 1.05 * 0.03), kAlpha);
  EXPECT_LT(VarianceP(current_A, 0.02, 1.05 * 0.001), kAlpha);
}

TEST(VehicleNoiseTest, FalseTouchesComeAsOftenAsTheyShould) {
  VehicleSensorParams params;
  params.contact = {.enabled = true, .false_probability = 0.01, .latency_ticks = 0};
  VehicleSensors sensors(params, {}, {20261122, 0});
  double touches = 0.0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const messages::VehicleState state = sensors.Measure({}, {}, 0.1);
    for (const bool closed : *state.contact) touches += closed;
  }
  const double chances = kTicks * static_cast<double>(messages::kContactSwitchCount);
  EXPECT_GT(CountP(touches, chances, 0.01), kAlpha);
  EXPECT_LT(CountP(touches, chances, 0.0115), kAlpha);  // negative control
}

}  // namespace
}  // namespace rockyard::sensing
