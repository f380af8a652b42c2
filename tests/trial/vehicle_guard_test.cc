// What the closed loop makes of what the rover feels: counts, and what a move by hand forgets.
#include "trial/drive/vehicle_guard.h"

#include <gtest/gtest.h>

#include "math/angles.h"
#include "sensing/vehicle_sensors.h"

namespace rockyard::trial {
namespace {

using messages::VehicleHazardKind;

constexpr double kTick_s = 0.05;

DriveParams Feeling(std::int64_t latency_ticks) {
  DriveParams drive;
  auto& sensors = drive.sensors.vehicle;
  sensors.contact.enabled = sensors.accelerometers.enabled = true;
  sensors.contact.latency_ticks = sensors.accelerometers.latency_ticks = latency_ticks;
  sensors.accelerometers.noise_m_s2 = 0.0;
  drive.perception.vehicle_hazard.contact_ticks = 1;
  drive.perception.vehicle_hazard.tilt_ticks = 3;
  return drive;
}

truth::RoverState Leaning(double roll_rad) {
  truth::RoverState state;
  state.X_WR.linear() = Eigen::AngleAxisd(roll_rad, math::Vector3::UnitX()).matrix();
  return state;
}

truth::RoverState Touching(const rover::RoverGeometryParams& size, double end) {
  truth::RoverState state;
  state.contacts = {{.part = truth::BodyPart::kPanelEdge,
                     .rock = 0,
                     .normal_force_N = 20.0,
                     .p_RoC_R = {end * 0.5 * size.length_m, 0.0, 0.28}}};
  return state;
}

// Sensors and what the rover makes of them.
struct Feeler {
  explicit Feeler(const DriveParams& drive)
      : sensors(drive.sensors.vehicle, drive.rover, {1, 0}), guard(drive) {}

  // One control tick at a state. True where something has appeared.
  bool Feel(const truth::RoverState& state) {
    sensors.Observe(state);
    const messages::VehicleState felt = sensors.Measure(state, {}, kTick_s);
    return !guard.Feel(felt, {}, {.duration_s = kTick_s}).empty();
  }
  void Place(const truth::RoverState& state) {
    sensors.Restart(state);
    guard.OnPlaced();
  }

  sensing::VehicleSensors sensors;
  VehicleGuard guard;
};

TEST(VehicleGuardTest, TouchesFromBeforeAHandMoveAreForgotten) {
  for (const std::int64_t latency : {0, 1, 3}) {
    const DriveParams drive = Feeling(latency);
    Feeler feeler(drive);
    const VehicleGuard& guard = feeler.guard;
    const truth::RoverState touching = Touching(drive.rover.geometry, +1.0);
    EXPECT_TRUE(feeler.Feel(touching));
    for (int tick = 0; tick < 4; ++tick) EXPECT_FALSE(feeler.Feel(touching));
    ASSERT_NE(guard.hazard(), nullptr);
    feeler.Place({});
    EXPECT_EQ(guard.hazard(), nullptr);
    for (int tick = 0; tick < 6; ++tick) {
      EXPECT_FALSE(feeler.Feel({})) << latency;
      EXPECT_EQ(guard.hazard(), nullptr) << latency;
    }
    EXPECT_EQ(guard.count(VehicleHazardKind::kContact), 1);
  }
}

// Every kind is counted when it appears, also one that appears beside another.
TEST(VehicleGuardTest, CountsEachKindWhenItAppears) {
  const DriveParams drive = Feeling(0);
  for (const double end : {+1.0, -1.0}) {  // touches ahead, behind
    Feeler feeler(drive);
    const VehicleGuard& guard = feeler.guard;
    truth::RoverState state = Touching(drive.rover.geometry, end);
    state.X_WR.linear() = Leaning(math::DegToRad(35.0)).X_WR.linear();
    for (int tick = 0; tick < 5; ++tick) feeler.Feel(state);
    EXPECT_EQ(guard.count(VehicleHazardKind::kContact), 1);
    EXPECT_EQ(guard.count(VehicleHazardKind::kTilt), 1);
    EXPECT_EQ(guard.touches_behind(), end < 0.0);
    ASSERT_NE(guard.hazard(), nullptr);
    EXPECT_EQ(guard.hazard()->kind,
              end < 0.0 ? VehicleHazardKind::kTilt : VehicleHazardKind::kContact);
    // Nothing appears where the touch ends and the tilt lasts.
    EXPECT_FALSE(feeler.Feel(Leaning(math::DegToRad(35.0))));
    EXPECT_EQ(guard.count(VehicleHazardKind::kTilt), 1);
  }
}

TEST(VehicleGuardTest, TicksFromBeforeAHandMoveDoNotCount) {
  Feeler feeler(Feeling(0));
  const truth::RoverState steep = Leaning(math::DegToRad(35.0));
  EXPECT_FALSE(feeler.Feel(steep));
  EXPECT_FALSE(feeler.Feel(steep));
  feeler.Place(steep);
  EXPECT_FALSE(feeler.Feel(steep));
  EXPECT_FALSE(feeler.Feel(steep));
  EXPECT_TRUE(feeler.Feel(steep));  // the third in a row, as tilt_ticks asks
}

}  // namespace
}  // namespace rockyard::trial
