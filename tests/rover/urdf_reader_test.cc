// Rovers out of URDF files: those that rockyard writes come back, and one of another style is read
// right.
#include "rover/urdf_reader/urdf_reader.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "core/archive.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "foreign_urdf.h"
#include "rover/urdf.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::rover {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

const fs::path kScenarios = fs::path(ROCKYARD_SOURCE_DIR) / "scenarios";

RoverParams Described(const std::string& file) {
  return scenario::ParseScenario(R"({"rover": {"extends": ")" + file + R"(.json"}})", {},
                                 kScenarios / "rovers")
      .drive.rover;
}

UrdfReading Read(const std::string& text) { return ReadUrdf(text, "a.urdf"); }

std::vector<std::string> Paths(const std::vector<core::ParameterInfo>& parameters) {
  std::vector<std::string> paths;
  for (const core::ParameterInfo& parameter : parameters) paths.push_back(parameter.path);
  return paths;
}

// What no URDF file says of a rover: the cleats of its wheels, how its contacts behave, how its
// motion is computed, where it drives, and how its motors start.
bool IsBeyondUrdf(const std::string& path) {
  return path == "fidelity" || path == "drive.ramp_s" || path.starts_with("geometry.lug_") ||
         path.starts_with("contact.") || path.starts_with("physics.") ||
         path.starts_with("quasi_static.");
}

// The group of a rover file without what no URDF file says.
std::string Sayable(const RoverParams& params) {
  core::JsonValue group = core::WriteParams(params);
  for (const char* key : {"fidelity", "contact", "physics", "quasi_static"}) group.Erase(key);
  group.Find("drive")->Erase("ramp_s");
  for (const char* key : {"lug_height_m", "lug_count"}) group.Find("geometry")->Erase(key);
  return core::DumpJson(group);
}

void ExpectComesBack(const RoverParams& params, const std::string& name) {
  const UrdfReading reading = Read(WriteUrdf(params));
  EXPECT_EQ(core::DumpJson(reading.group), Sayable(params)) << name;  // bit for bit
  EXPECT_THAT(reading.not_taken, IsEmpty()) << name;
  EXPECT_EQ(reading.robot, "rover");
}

TEST(UrdfReader, EveryRoverOfTheScenariosComesBackBitForBit) {
  std::set<std::string> rovers;
  int scenarios = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kScenarios)) {
    if (entry.path().extension() != ".json") continue;
    const core::JsonValue document = core::LoadJsonFile(entry.path());
    if (document.Find("name") == nullptr || scenario::IsSweep(document)) continue;
    const RoverParams rover = scenario::ReadScenarioSealed(document).drive.rover;
    ++scenarios;
    if (rovers.insert(WriteUrdf(rover)).second) ExpectComesBack(rover, entry.path().string());
  }
  EXPECT_GT(scenarios, 40);
  for (const char* file : {"rocky_3_2", "mfex", "athena_sdm", "athena_2012"}) {
    rovers.insert(WriteUrdf(Described(file)));
    ExpectComesBack(Described(file), file);
  }
  EXPECT_GE(rovers.size(), 4U);
}

// A new parameter is either read from the file or named.
TEST(UrdfReader, WhatIsReadAndWhatIsLeftOutAreAllParametersOfARover) {
  const UrdfReading reading = Read(WriteUrdf({}));
  std::vector<std::string> expected;
  const core::FieldTable table = core::ListParams<RoverParams>();
  for (const core::ParameterInfo& parameter : table.parameters()) {
    if (IsBeyondUrdf(parameter.path)) expected.push_back(parameter.path);
    const bool told = reading.places.contains(parameter.path);
    EXPECT_NE(told, IsBeyondUrdf(parameter.path)) << parameter.path;
  }
  EXPECT_EQ(Paths(reading.left_out), expected);
  EXPECT_EQ(reading.places.size() + expected.size(), table.parameters().size());
  EXPECT_EQ(core::Abbreviate(reading.left_out[3].value), "0.1") << "drive.ramp_s, the default";
}

// The rover of foreign_urdf.h, by hand.
TEST(UrdfReader, ReadsARoverOfAnotherStyle) {
  const UrdfReading reading = Read(ForeignUrdf());
  const RoverGeometryParams& g = reading.params.geometry;
  constexpr double kNear = 1e-9;
  EXPECT_NEAR(g.length_m, 1.3, kNear);
  EXPECT_NEAR(g.width_m, 0.9, kNear);
  EXPECT_NEAR(g.height_m, 0.575, kNear);
  EXPECT_NEAR(g.belly_clearance_m, 0.35, kNear);
  EXPECT_NEAR(g.wheel_radius_m, 0.12, kNear);
  EXPECT_NEAR(g.wheel_width_m, 0.1, kNear);
  EXPECT_NEAR(g.wheelbase_m, 1.0, kNear);
  EXPECT_NEAR(g.middle_wheel_x_m, -0.05, kNear);
  EXPECT_EQ(g.steered_wheels, SteeredWheels::kCorners);
  EXPECT_EQ(g.bogie_end, BogieEnd::kRear);
  EXPECT_NEAR(g.rocker_pivot_x_m, 0.1, kNear);
  EXPECT_NEAR(g.rocker_pivot_z_m, 0.45, kNear);
  EXPECT_NEAR(g.bogie_pivot_z_m, 0.3, kNear);
  EXPECT_NEAR(g.knee_z_m, 0.38, kNear);
  EXPECT_NEAR(g.belly_length_m, 0.7, kNear);
  EXPECT_NEAR(g.belly_width_m, 0.4, kNear);
  EXPECT_NEAR(g.arm_y_m, 0.28, kNear);
  EXPECT_NEAR(g.arm_radius_m, 0.02, kNear);
  EXPECT_NEAR(g.hub_radius_m, 0.05, kNear);
  EXPECT_NEAR(g.rocker_limit_rad, 0.4, kNear);
  EXPECT_NEAR(g.bogie_limit_rad, 0.8, kNear);
  const RoverMassParams& mass = reading.params.mass;
  // Chassis 30, mast 2 and tool 1; arms 3.5 and 2; tyres 1.5, forks 0.4 at the corners.
  EXPECT_NEAR(mass.total_kg, 33.0 + 2.0 * (3.5 + 2.0) + 6.0 * 1.5 + 4.0 * 0.4, kNear);
  EXPECT_NEAR(mass.wheel_kg, (6.0 * 1.5 + 4.0 * 0.4) / 6.0, kNear);
  EXPECT_NEAR(mass.rocker_kg, 3.5, kNear);
  EXPECT_NEAR(mass.bogie_kg, 2.0, kNear);
  EXPECT_NEAR(mass.chassis_com_x_m, (30.0 * 0.0 + 2.0 * 0.4 + 1.0 * 0.5) / 33.0, kNear);
  EXPECT_NEAR(mass.chassis_com_z_m, (30.0 * 0.45 + 2.0 * 1.0 + 1.0 * 0.35) / 33.0, kNear);
  const RoverDriveParams& drive = reading.params.drive;
  EXPECT_NEAR(drive.speed_m_s, 1.5 * 0.12, kNear);
  EXPECT_NEAR(drive.stall_torque_Nm, 35.0, kNear);
  EXPECT_NEAR(drive.steer_rate_rad_s, 0.6, kNear);
  EXPECT_NEAR(drive.max_steer_rad, 1.2, kNear);
  // It is a rover of rockyard's.
  core::JsonValue document = core::JsonValue::Object();
  document.Set("rover", reading.group);
  EXPECT_NO_THROW(scenario::ReadScenario(document));
}

// What the file says counts before the bounds, and the refusal tells where it stands.
TEST(UrdfReader, ProblemsOfParametersGetTheirPlaces) {
  const UrdfReading reading =
      Read(Replaced(ForeignUrdf(), "size=\"0.7 0.4 0.2\"", "size=\"0.7 40 0.2\""));
  core::JsonValue document = core::JsonValue::Object();
  document.Set("rover", reading.group);
  const auto problems =
      reading.WithPlaces(core::ProblemsIn([&] { scenario::ReadScenario(document); }));
  EXPECT_THAT(problems, core::OneProblem("rover.geometry.belly_width_m",
                                         "(from line 14: collision of link \"base_link\")", "use"));
}

}  // namespace
}  // namespace rockyard::rover
