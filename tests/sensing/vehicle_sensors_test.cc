// What the rover's own sensors report of its true state: values, places, latency, noise.
#include "sensing/vehicle_sensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/archive.h"
#include "core/refusals.h"
#include "math/angles.h"

namespace rockyard::sensing {
namespace {

using math::DegToRad;
using math::Vector3;
using messages::ContactSwitch;
using truth::BodyPart;

constexpr double kTick_s = 0.1;

// All sensors on, exact and at once.
VehicleSensorParams Exact() {
  return {.articulation = {true, 0.0, 0.0, 0},
          .accelerometers = {true, 0.0, 0.0, 0},
          .motor_current = {true, 0.0, 0.0, 0, 20.0, 0.02},
          .contact = {.enabled = true, .latency_ticks = 0}};
}

messages::WheelCommand Rolling() {
  messages::WheelCommand command;
  command.rate_rad_s.fill(1.0);
  return command;
}

rover::RoverParams OnMars() { return rover::RoverParams{.physics = {.gravity_m_s2 = 3.72}}; }

truth::RoverState Touching(BodyPart part, const Vector3& p_RoC_R, double force_N = 5.0) {
  return {.contacts = {{.part = part, .rock = 0, .normal_force_N = force_N, .p_RoC_R = p_RoC_R}}};
}

TEST(VehicleSensorsTest, WhatIsOffReportsNothing) {
  VehicleSensors sensors({}, {}, {1, 0});
  EXPECT_FALSE(sensors.any());
  const messages::VehicleState state = sensors.Measure({}, Rolling(), kTick_s);
  EXPECT_FALSE(state.articulation || state.specific_force_R || state.motor_current_A ||
               state.contact);
}

TEST(ArticulationSensorTest, ReportsJointAnglesInSteps) {
  VehicleSensorParams params = Exact();
  truth::RoverState state;
  state.left_rocker_rad = DegToRad(3.0);
  state.right_rocker_rad = DegToRad(-3.0);
  state.left_bogie_rad = DegToRad(12.4);
  state.right_bogie_rad = DegToRad(-12.6);
  const auto exact = VehicleSensors(params, {}, {1, 0}).Measure(state, {}, kTick_s).articulation;
  EXPECT_EQ(exact->left_rocker_rad, state.left_rocker_rad);
  EXPECT_EQ(exact->right_bogie_rad, state.right_bogie_rad);
  params.articulation.resolution_rad = DegToRad(1.0);
  const auto rounded = VehicleSensors(params, {}, {1, 0}).Measure(state, {}, kTick_s).articulation;
  EXPECT_NEAR(rounded->left_bogie_rad, DegToRad(12.0), 1e-12);
  EXPECT_NEAR(rounded->right_bogie_rad, DegToRad(-13.0), 1e-12);
}

TEST(AccelerometerTest, ReportsGravityInTheRoversAxes) {
  VehicleSensors sensors(Exact(), OnMars(), {1, 0});
  truth::RoverState state;
  // Nose up by 10 degrees: gravity's reaction has a forward part.
  state.X_WR.linear() = Eigen::AngleAxisd(-DegToRad(10.0), Vector3::UnitY()).matrix();
  const Vector3 force_R = *sensors.Measure(state, {}, kTick_s).specific_force_R;
  EXPECT_NEAR(force_R.x(), 3.72 * std::sin(DegToRad(10.0)), 1e-12);
  EXPECT_NEAR(force_R.y(), 0.0, 1e-12);
  EXPECT_NEAR(force_R.z(), 3.72 * std::cos(DegToRad(10.0)), 1e-12);
}

TEST(AccelerometerTest, ReportsWhatChangesTheVelocity) {
  VehicleSensors sensors(Exact(), OnMars(), {1, 0});
  truth::RoverState state;
  state.v_WR_m_s = Vector3(0.02, 0.0, 0.0);
  EXPECT_NEAR(sensors.Measure(state, {}, kTick_s).specific_force_R->x(), 0.2, 1e-12);
  EXPECT_NEAR(sensors.Measure(state, {}, kTick_s).specific_force_R->x(), 0.0, 1e-12);
  // A rover that was put down elsewhere was not accelerated.
  state.v_WR_m_s = Vector3(0.0, 0.1, 0.0);
  sensors.Restart(state);
  EXPECT_NEAR(sensors.Measure(state, {}, kTick_s).specific_force_R->norm(), 3.72, 1e-12);
}

TEST(MotorCurrentTest, IsMeanTorqueOverTheConstantPlusNoLoad) {
  VehicleSensors sensors(Exact(), {}, {1, 0});
  truth::RoverState state;
  state.motor_torque_Nm = {1.0, -0.4, 0.0, 0.0, 0.0, 2.0};
  sensors.Observe(state);
  state.motor_torque_Nm[0] = 0.0;
  sensors.Observe(state);
  messages::WheelCommand command = Rolling();
  command.rate_rad_s[5] = 0.0;  // braked: its gears hold it
  const auto current_A = *sensors.Measure(state, command, kTick_s).motor_current_A;
  EXPECT_NEAR(current_A[0], 0.5 / 20.0 + 0.02, 1e-15);
  EXPECT_NEAR(current_A[1], 0.4 / 20.0 + 0.02, 1e-15);
  EXPECT_NEAR(current_A[2], 0.02, 1e-15);
  EXPECT_EQ(current_A[5], 0.0);
}

TEST(ContactSwitchTest, PlacesAlongTheOutline) {
  const rover::RoverGeometryParams size;  // 0.65 x 0.48 m, belly 0.40 m long
  const auto pressed = [&](BodyPart part, double x_m, double y_m) {
    return SwitchAt(Touching(part, {x_m, y_m, 0.28}).contacts[0], size, 0.03);
  };
  constexpr auto kPanel = BodyPart::kPanelEdge;
  EXPECT_EQ(pressed(kPanel, 0.32, 0.20), ContactSwitch::kFrontLeft);
  EXPECT_EQ(pressed(kPanel, 0.32, 0.0), ContactSwitch::kFrontCentre);
  EXPECT_EQ(pressed(kPanel, 0.32, -0.09), ContactSwitch::kFrontRight);
  EXPECT_EQ(pressed(kPanel, 0.1, 0.24), ContactSwitch::kLeftEdge);
  EXPECT_EQ(pressed(kPanel, -0.1, -0.22), ContactSwitch::kRightEdge);
  EXPECT_EQ(pressed(kPanel, -0.31, 0.1), ContactSwitch::kRearEdge);
  EXPECT_EQ(pressed(kPanel, 0.2, 0.1), std::nullopt);  // under the panel
  EXPECT_EQ(pressed(BodyPart::kBelly, 0.195, 0.05), ContactSwitch::kUndercarriage);
  EXPECT_EQ(pressed(BodyPart::kBelly, 0.10, 0.0), std::nullopt);  // beneath, behind its edge
  EXPECT_EQ(pressed(BodyPart::kHub, 0.26, 0.2), std::nullopt);
  EXPECT_EQ(pressed(BodyPart::kRocker, 0.32, 0.2), std::nullopt);
}

TEST(ContactSwitchTest, OneStepOfATickIsEnoughAndForceHasToSuffice) {
  VehicleSensors sensors(Exact(), {}, {1, 0});
  const auto front = [&] {
    return (*sensors.Measure({}, Rolling(), kTick_s).contact)[Index(ContactSwitch::kFrontCentre)];
  };
  const Vector3 place_R(0.325, 0.0, 0.28);
  sensors.Observe(Touching(BodyPart::kPanelEdge, place_R));
  sensors.Observe({});
  EXPECT_TRUE(front());
  EXPECT_FALSE(front());  // forgotten with the tick
  sensors.Observe(Touching(BodyPart::kPanelEdge, place_R, 0.99));
  EXPECT_FALSE(front());
  sensors.Observe(Touching(BodyPart::kPanelEdge, place_R, 1.0));
  EXPECT_TRUE(front());
}

TEST(LatencyTest, ValuesComeTicksLater) {
  for (const std::int64_t latency : {0, 1, 3}) {
    VehicleSensorParams params = Exact();
    params.articulation.latency_ticks = latency;
    params.contact.latency_ticks = latency;
    VehicleSensors sensors(params, {}, {1, 0});
    for (std::int64_t tick = 0; tick < 8; ++tick) {
      truth::RoverState state = Touching(BodyPart::kPanelEdge, {0.325, 0.0, 0.28});
      if (tick != 2) state.contacts.clear();
      state.left_bogie_rad = 0.01 * static_cast<double>(tick);
      sensors.Observe(state);
      const messages::VehicleState seen = sensors.Measure(state, Rolling(), kTick_s);
      const auto shown = static_cast<double>(std::max<std::int64_t>(0, tick - latency));
      EXPECT_EQ(seen.articulation->left_bogie_rad, 0.01 * shown);
      EXPECT_EQ((*seen.contact)[Index(ContactSwitch::kFrontCentre)], tick - latency == 2);
    }
  }
}

// Operators move the rover: neither what is on its way nor what was felt since the last tick is
// reported of the place where the rover stood.
TEST(LatencyTest, NothingFromBeforeAHandMoveArrivesAfterIt) {
  for (const std::int64_t latency : {0, 1, 3}) {
    VehicleSensorParams params = Exact();
    params.articulation.latency_ticks = latency;
    params.accelerometers.latency_ticks = latency;
    params.motor_current.latency_ticks = latency;
    params.contact.latency_ticks = latency;
    VehicleSensors sensors(params, OnMars(), {1, 0});
    truth::RoverState before = Touching(BodyPart::kPanelEdge, {0.325, 0.0, 0.28});
    before.left_bogie_rad = 0.3;
    before.motor_torque_Nm.fill(2.0);
    before.X_WR.linear() = Eigen::AngleAxisd(0.5, Vector3::UnitX()).matrix();
    for (int tick = 0; tick < 5; ++tick) {
      sensors.Observe(before);
      sensors.Measure(before, Rolling(), kTick_s);
    }
    sensors.Observe(before);
    const truth::RoverState after;
    sensors.Restart(after);
    for (int tick = 0; tick < 5; ++tick) {
      sensors.Observe(after);
      const messages::VehicleState seen = sensors.Measure(after, Rolling(), kTick_s);
      EXPECT_FALSE((*seen.contact)[Index(ContactSwitch::kFrontCentre)]) << latency;
      EXPECT_EQ(seen.articulation->left_bogie_rad, 0.0) << latency;
      EXPECT_EQ(seen.specific_force_R->y(), 0.0) << latency;
      EXPECT_NEAR((*seen.motor_current_A)[0], 0.02, 1e-15) << latency;
    }
  }
}

// Noise belongs to the tick and the sensor: what else is on, and what was measured before, shifts
// nothing.
TEST(NoiseTest, IsIndexedByTickAndSensor) {
  VehicleSensorParams all;
  all.articulation.enabled = all.accelerometers.enabled = all.motor_current.enabled =
      all.contact.enabled = true;
  all.contact.false_probability = 0.3;
  VehicleSensorParams alone{.motor_current = {.enabled = true}};
  VehicleSensors first(all, {}, {7, 3});
  VehicleSensors second(alone, {}, {7, 3});
  VehicleSensors other(alone, {}, {7, 4});
  bool differs = false;
  for (int tick = 0; tick < 20; ++tick) {
    truth::RoverState state;
    state.motor_torque_Nm.fill(tick == 5 ? 1.0 : 0.3);
    const auto a = first.Measure(state, Rolling(), kTick_s).motor_current_A;
    EXPECT_EQ(a, second.Measure(state, Rolling(), kTick_s).motor_current_A);
    differs = differs || a != other.Measure(state, Rolling(), kTick_s).motor_current_A;
  }
  EXPECT_TRUE(differs);
}

// The problems of a description, by reading it back with one value changed.
std::vector<core::Problem> ProblemsOf(const std::function<void(VehicleSensorParams&)>& change) {
  VehicleSensorParams params;
  change(params);
  const core::JsonValue document = core::WriteParams(params);
  VehicleSensorParams read;
  return core::ProblemsIn([&] { core::ReadParams(document, read); });
}

TEST(VehicleSensorParamsTest, WrongValuesAreNamed) {
  EXPECT_TRUE(ProblemsOf([](VehicleSensorParams&) {}).empty());
  const std::vector<std::pair<std::string, std::function<void(VehicleSensorParams&)>>> wrong{
      {"articulation.noise_deg", [](auto& p) { p.articulation.noise_rad = -0.01; }},
      {"articulation.latency_ticks", [](auto& p) { p.articulation.latency_ticks = -1; }},
      {"accelerometers.resolution_m_s2", [](auto& p) { p.accelerometers.resolution_m_s2 = -1.0; }},
      {"motor_current.noise_A", [](auto& p) { p.motor_current.noise_A = -1e-3; }},
      {"motor_current.torque_per_ampere_Nm_A",
       [](auto& p) { p.motor_current.torque_per_ampere_Nm_A = 0.0; }},
      {"contact.min_force_N", [](auto& p) { p.contact.min_force_N = -1.0; }},
      {"contact.edge_width_m", [](auto& p) { p.contact.edge_width_m = 0.0; }},
      {"contact.false_probability", [](auto& p) { p.contact.false_probability = 1.5; }}};
  for (const auto& [path, change] : wrong) {
    EXPECT_THAT(ProblemsOf(change), core::OneProblem(path));
  }
}

}  // namespace
}  // namespace rockyard::sensing
