// The rover's own sensors: gyro, encoders, scrapes, tracker and oracle where noise plays no part,
// and what the others report of its true state.
#include "sensing/vehicle_sensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/archive.h"
#include "core/error.h"
#include "core/refusals.h"
#include "math/angles.h"
#include "sensing/motion_sensors.h"
#include "sensing/tracker.h"

namespace rockyard::sensing {
namespace {

using math::DegToRad;
using math::Vector3;
using messages::ContactSwitch;
using truth::BodyPart;

// What the rover's own sensors report of its true state: values, places, latency, noise.

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
  for (const auto& [path, change] : wrong) EXPECT_THAT(ProblemsOf(change), core::OneProblem(path));
}

// Gyro, encoders, scrapes, tracker and oracle where noise plays no part.

GyroParams QuietGyro() { return GyroParams{.heading_variance_deg2_per_m = 0.0}; }

EncoderParams QuietEncoders() { return {.distance_variance_m2_per_m = 0.0}; }

math::Transform Turned(double heading_rad, double pitch_rad = 0.0) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.rotate(Eigen::AngleAxisd(pitch_rad, Vector3::UnitY()));
  X_WR.rotate(Eigen::AngleAxisd(heading_rad, Vector3::UnitZ()));
  return X_WR;
}

TEST(GyroTest, TurnsAreUnderestimatedBySixPercent) {
  const Gyro gyro(QuietGyro(), {1, 0});
  EXPECT_DOUBLE_EQ(gyro.Measure(DegToRad(50.0), 1.0, true, 0), DegToRad(47.0));
  EXPECT_DOUBLE_EQ(gyro.Measure(DegToRad(-50.0), 1.0, true, 1), DegToRad(-47.0));
}

TEST(GyroTest, NoiseStopsAtRestUnlessToldOtherwise) {
  GyroParams params;
  EXPECT_EQ(Gyro(params, {1, 0}).Measure(0.0, 1.0, false, 3), 0.0);
  EXPECT_NE(Gyro(params, {1, 0}).Measure(0.0, 1.0, true, 3), 0.0);
  params.accumulates_at_rest = true;
  EXPECT_EQ(Gyro(params, {1, 0}).Measure(0.0, 1.0, false, 3),
            Gyro(params, {1, 0}).Measure(0.0, 1.0, true, 3));
}

TEST(GyroTest, DriftPerMetreGrowsInverselyWithSpeed) {
  // Section 5: 0.70 deg2/m at 15 cm/s is about 16 deg2/m at the 0.67 cm/s of MFEX.
  const double deg2_per_s = GyroParams{}.heading_variance_rad2_per_s() * std::pow(180.0 / M_PI, 2);
  EXPECT_NEAR(deg2_per_s, 0.105, 1e-12);
  EXPECT_NEAR(deg2_per_s / 0.0067, 15.67, 0.005);
}

// Level sand shows the published variance where the noise has that much less of it.
TEST(GyroTest, TheGainOfLevelSandTakesItFromTheNoise) {
  GyroParams params;
  const double without = params.heading_variance_rad2_per_s();
  params.level_sand_gain = 1.25;
  EXPECT_DOUBLE_EQ(params.heading_variance_rad2_per_s(), 0.8 * without);
  params.level_sand_gain = 4.0;
  EXPECT_DOUBLE_EQ(Gyro(params, {1, 0}).Measure(0.0, 1.0, true, 3),
                   0.5 * Gyro({}, {1, 0}).Measure(0.0, 1.0, true, 3));
}

TEST(GyroTest, MeasuresTurnsAboutTheRoversOwnAxis) {
  EXPECT_NEAR(TurnAboutOwnAxis(Turned(3.1), Turned(-3.1)), 2.0 * M_PI - 6.2, 1e-12);
  EXPECT_NEAR(TurnAboutOwnAxis(Turned(0.2), Turned(0.1)), -0.1, 1e-12);
  // On a slope it is the turn within the slope's plane, not the change of map heading.
  EXPECT_NEAR(TurnAboutOwnAxis(Turned(0.0, 0.4), Turned(0.3, 0.4)), 0.3, 1e-12);
  // Pure pitching is no turn.
  EXPECT_NEAR(TurnAboutOwnAxis(Turned(0.0, 0.1), Turned(0.0, 0.2)), 0.0, 1e-12);
}

TEST(EncodersTest, WithoutNoiseTheyAreExact) {
  Encoders encoders(QuietEncoders(), 0.065, {1, 0});
  const messages::PerWheel<double> turn{1.0, 2.0, 3.0, -1.0, 0.5, 0.25};
  EXPECT_EQ(encoders.Measure(turn), turn);
}

TEST(EncodersTest, NoiseIsSharedByAllWheelsAndAbsentInTurnsInPlace) {
  Encoders encoders({}, 0.065, {1, 0});
  const messages::PerWheel<double> straight{1, 1, 1, 1, 1, 1};
  const auto measured = encoders.Measure(straight);
  EXPECT_NE(measured[0], 1.0);
  for (const double turn : measured) EXPECT_DOUBLE_EQ(turn, measured[0]);
  const messages::PerWheel<double> in_place{-1, -1, -1, 1, 1, 1};
  EXPECT_EQ(encoders.Measure(in_place), in_place);
}

TEST(EncodersTest, TickLengthDoesNotChangeTheNoise) {
  const auto travel_in = [](int ticks) {
    Encoders encoders({}, 0.065, {1, 0});
    messages::PerWheel<double> turn;
    turn.fill(20.0 / ticks);
    double sum = 0.0;
    for (int i = 0; i < ticks; ++i) sum += encoders.Measure(turn)[0];
    return sum;
  };
  EXPECT_NE(travel_in(1), 20.0);
  EXPECT_NEAR(travel_in(1), travel_in(7), 1e-9);
  EXPECT_NEAR(travel_in(1), travel_in(1000), 1e-9);
}

TEST(EncodersTest, BackwardTravelIsScaledAsForwardTravel) {
  const auto measured = [](double turn_rad) {
    Encoders encoders({}, 0.065, {1, 0});
    messages::PerWheel<double> turn;
    turn.fill(turn_rad);
    return encoders.Measure(turn)[3];
  };
  EXPECT_DOUBLE_EQ(measured(-5.0), -measured(5.0));
}

TEST(EncodersTest, PhysicsTakesItsShareOfTheVariance) {
  EncoderParams params{.physics_variance_m2_per_m = 0.0009};
  EXPECT_NEAR(params.noise_variance_m2_per_m(), 0.0030, 1e-15);
  core::JsonValue json = core::WriteParams(params);
  json.Set("physics_variance_m2_per_m", core::JsonValue(0.005));
  EXPECT_THROW(core::ReadParams(json, params), core::UserError);
}

// An odometer of scale s, on a rover that gets 1 m on for 1 / s rolled: of noise v / s a metre
// rolled it shows s^2 (v / s) / s = v a metre driven.
TEST(EncodersTest, TheGainOfLevelSandIsTheScaleOfTheOdometer) {
  const EncoderParams params{.physics_variance_m2_per_m = 0.0009, .level_sand_gain = 0.92};
  const double scale = 0.92;
  EXPECT_NEAR(scale * scale * params.noise_variance_m2_per_m() / scale, 0.0030, 1e-15);
}

truth::RoverState Scraping(int rock, double x_m, truth::BodyPart part = truth::BodyPart::kHub,
                           double force_N = 5.0, double speed_m_s = 0.1) {
  truth::RoverState state;
  state.X_WR.translation() = Vector3(x_m, 0, 0);
  state.contacts = {
      {.part = part, .rock = rock, .normal_force_N = force_N, .sliding_speed_m_s = speed_m_s}};
  return state;
}

TEST(ScrapeDetectorTest, OneJumpOfFiveDegreesPerEpisode) {
  ScrapeDetector detector({}, {1, 0});
  EXPECT_NEAR(std::abs(detector.Observe(Scraping(4, 0.0), 0.0)), DegToRad(5.0), 1e-12);
  for (int i = 1; i <= 20; ++i) EXPECT_EQ(detector.Observe(Scraping(4, 0.01 * i), 0.1 * i), 0.0);
  EXPECT_EQ(detector.episodes(), 1);
  // Another rock at once; the first again only after a gap in time and in travel.
  EXPECT_NE(detector.Observe(Scraping(5, 0.2), 2.0), 0.0);
  EXPECT_EQ(detector.Observe(Scraping(4, 0.4), 2.9), 0.0) << "0.9 s since the last scrape";
  EXPECT_EQ(detector.Observe(Scraping(4, 0.42), 4.0), 0.0) << "2 cm since the last scrape";
  EXPECT_NE(detector.Observe(Scraping(4, 0.48), 5.1), 0.0);
  EXPECT_EQ(detector.episodes(), 3);
}

TEST(ScrapeDetectorTest, OnlySlidingBodyContactsWithRocksCount) {
  ScrapeDetector detector({}, {1, 0});
  EXPECT_EQ(detector.Observe(Scraping(-1, 0), 0), 0.0) << "the ground";
  EXPECT_EQ(detector.Observe(Scraping(1, 0, truth::BodyPart::kWheel), 0), 0.0);
  EXPECT_EQ(detector.Observe(Scraping(1, 0, truth::BodyPart::kHub, 0.5), 0), 0.0);
  EXPECT_EQ(detector.Observe(Scraping(1, 0, truth::BodyPart::kHub, 5.0, 0.005), 0), 0.0);
  int rock = 1;
  for (const auto part : {truth::BodyPart::kBelly, truth::BodyPart::kRocker, truth::BodyPart::kHub,
                          truth::BodyPart::kPanelEdge}) {
    EXPECT_NE(detector.Observe(Scraping(rock++, 0, part), 0), 0.0);
  }
}

TEST(ScrapeDetectorTest, SignsAndSwitch) {
  ScrapeParams params{.sign = ScrapeSign::kLeft};
  EXPECT_DOUBLE_EQ(ScrapeDetector(params, {1, 0}).Observe(Scraping(1, 0), 0), DegToRad(5.0));
  params.sign = ScrapeSign::kRight;
  EXPECT_DOUBLE_EQ(ScrapeDetector(params, {1, 0}).Observe(Scraping(1, 0), 0), -DegToRad(5.0));
  params.enabled = false;
  ScrapeDetector off(params, {1, 0});
  EXPECT_EQ(off.Observe(Scraping(1, 0), 0), 0.0);
  EXPECT_EQ(off.episodes(), 1);
  EXPECT_EQ(off.total_jump_rad(), 0.0);
}

TEST(MotionSensorsTest, MeasuresBetweenTicks) {
  GyroParams gyro = QuietGyro();
  gyro.scrape.sign = ScrapeSign::kLeft;
  truth::RoverState state;
  state.wheel_angle_rad.fill(100.0);
  MotionSensors sensors(gyro, QuietEncoders(), 0.065, {1, 0}, state);
  state.wheel_angle_rad.fill(100.5);
  state.X_WR = Turned(0.1);
  auto motion = sensors.Measure(state, 0.25, true);
  EXPECT_DOUBLE_EQ(motion.duration_s, 0.25);
  for (const double turn : motion.wheel_turn_rad) EXPECT_DOUBLE_EQ(turn, 0.5);
  EXPECT_NEAR(motion.turn_rad, 0.094, 1e-12);

  // A scrape between two ticks shows in the next one, once.
  sensors.Observe(Scraping(3, 0.0), 0.3);
  motion = sensors.Measure(state, 0.25, true);
  EXPECT_NEAR(motion.turn_rad, DegToRad(5.0), 1e-12);
  EXPECT_EQ(sensors.Measure(state, 0.25, true).turn_rad, 0.0);

  // Turned by hand: not measured.
  state.X_WR = Turned(1.0);
  sensors.Restart(state);
  EXPECT_EQ(sensors.Measure(state, 0.25, true).turn_rad, 0.0);
}

TEST(MotionSensorsTest, NoiseOfATickDoesNotDependOnWhatWentBefore) {
  const auto third_tick = [](double first_turn_rad) {
    truth::RoverState state;
    MotionSensors sensors({}, {}, 0.065, {1, 0}, state);
    state.X_WR = Turned(first_turn_rad);
    sensors.Measure(state, 0.1, true);
    sensors.Measure(state, 0.1, true);
    state.wheel_angle_rad.fill(1.0);
    return sensors.Measure(state, 0.1, true);
  };
  EXPECT_EQ(third_tick(0.0).turn_rad, third_tick(0.5).turn_rad);
  EXPECT_EQ(third_tick(0.0).wheel_turn_rad, third_tick(0.5).wheel_turn_rad);
}

TEST(TrackerTest, SystematicErrorsKeepTheirBounds) {
  const TrackerParams params{.random_position_m = 0.0, .random_heading_rad = 0.0};
  double largest_m = 0.0;
  for (std::uint32_t trial = 0; trial < 1000; ++trial) {
    const Tracker tracker(params, {1, trial});
    const math::Pose2 seen = tracker.Observe({1.0, 2.0, 0.5}, 0);
    const double error_m = std::hypot(seen.x_m - 1.0, seen.y_m - 2.0);
    EXPECT_LE(error_m, 0.02);
    EXPECT_LE(std::abs(seen.heading_rad - 0.5), DegToRad(0.4) + 1e-15);
    largest_m = std::max(largest_m, error_m);
    // The same throughout a trial.
    EXPECT_EQ(tracker.Observe({1.0, 2.0, 0.5}, 99).x_m, seen.x_m);
  }
  EXPECT_GT(largest_m, 0.0195);
}

TEST(OracleTest, GivesTheTruePose) {
  truth::RoverState state;
  state.X_WR = Turned(0.7);
  state.X_WR.translation() = Vector3(1.5, -2.0, 0.3);
  const messages::PoseUpdate pose = TruePose(state);
  EXPECT_DOUBLE_EQ(pose.x_m, 1.5);
  EXPECT_DOUBLE_EQ(pose.y_m, -2.0);
  EXPECT_NEAR(pose.heading_rad, 0.7, 1e-15);
}

}  // namespace
}  // namespace rockyard::sensing
