#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_file.h"
#include "core/json_value.h"
#include "experiments/drive/drive_experiment.h"
#include "experiments/hazard_detection/hazard_detection.h"
#include "experiments/hazard_scenarios.h"
#include "experiments/make_experiment.h"
#include "experiments/scenario_experiment.h"
#include "experiments/stereo_scenarios.h"
#include "experiments/three_rock_run/three_rock_run.h"
#include "math/angles.h"
#include "scenario/load.h"
#include "scenario/shipped.h"
#include "trial/run_trial.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

TEST(MeasurementColumnsTest, EveryBaseIsAColumn) {
  for (const truth::RecordSchema* columns : {&HazardColumns(), &ThreeRockColumns()}) {
    for (const truth::ValueInfo& column : *columns) {
      const bool refers = !IsBase(column.role) && column.role != truth::ColumnRole::kFactor &&
                          column.role != truth::ColumnRole::kValue;
      EXPECT_EQ(column.of.empty(), !refers) << column.name;
      if (refers) {
        EXPECT_NE(truth::FindColumn(*columns, column.of), nullptr) << column.name;
      }
    }
  }
}

truth::RecordSchema WithoutRoles(truth::RecordSchema schema) {
  for (truth::ValueInfo& column : schema) {
    column.role = truth::ColumnRole::kValue;
    column.of.clear();
  }
  return schema;
}

void ExpectRolesBack(const scenario::Scenario& scenario) {
  const auto experiment = MakeExperiment(scenario);
  const truth::RecordSchema& schema = experiment->schema();
  const truth::RecordSchema stored = WithRoles(WithoutRoles(schema));
  ASSERT_EQ(stored.size(), schema.size());
  for (std::size_t i = 0; i < schema.size(); ++i) {
    EXPECT_EQ(stored[i].name, schema[i].name);
    EXPECT_EQ(stored[i].role, schema[i].role) << scenario.name << " " << schema[i].name;
    EXPECT_EQ(stored[i].of, schema[i].of) << scenario.name << " " << schema[i].name;
  }
}

// Drives and measurements both count "scans", which only the latter add up.
TEST(WithRolesTest, GivesAStoredSchemaTheRolesOfItsExperiment) {
  for (const char* name : {"detection", "approach", "false_alarm", "missed", "precision"}) {
    ExpectRolesBack(HazardScenario(name));
  }
  for (const char* name : {"range", "texture", "sun", "baseline"}) {
    ExpectRolesBack(StereoScenario(name));
  }
  for (const truth::ValueInfo& column : WithRoles(DriveSchema())) {
    EXPECT_EQ(column.role, truth::ColumnRole::kValue) << column.name;
  }
}

// A new experiment whose columns were left out would lose its rates when a run is resumed.
TEST(WithRolesTest, KnowsTheColumnsOfEveryExperiment) {
  const ExperimentSet experiments = StandardExperiments();
  for (const std::string_view name : experiments.names()) {
    core::JsonValue document = core::JsonValue::Object();
    core::SetPath(document, "name", core::JsonValue(name));
    core::SetPath(document, "experiment", core::JsonValue(name));
    // What the experiments on stereo cameras ask for beside their name.
    if (name == "stereo_sensing") {
      core::SetPath(document, "sensors.terrain_sensor", core::JsonValue("stereo"));
      core::SetPath(document, "navigation.navigator", core::JsonValue("gestalt"));
    }
    // And what three_rock_run asks of the terrain: three rocks alone.
    if (name == "three_rock_run") {
      core::SetPath(document, "terrain.arena.kind", core::JsonValue("open"));
      core::SetPath(document, "terrain.rocks.kind", core::JsonValue("none"));
    }
    // And a mission, which roams about.
    if (name == "mission") core::SetPath(document, "terrain.arena.kind", core::JsonValue("open"));
    ExpectRolesBack(scenario::ReadScenario(document));
  }
}

TEST(WithRolesTest, KeepsWhatNoExperimentKnows) {
  const truth::RecordSchema stored = WithRoles({{"no_such_column", "m", "meaning"}});
  ASSERT_EQ(stored.size(), 1U);
  EXPECT_EQ(stored[0].unit, "m");
  EXPECT_EQ(stored[0].role, truth::ColumnRole::kValue);
}

scenario::Scenario Pathfinder(const std::string& name, std::vector<std::string> overrides = {}) {
  return scenario::Shipped("pathfinder/" + name, overrides);
}

// Clear zones about start and goal that leave room for all fifteen rocks in some layouts only.
scenario::Scenario CrowdedScenario() {
  return Pathfinder("obstacles_0.85",
                    {"terrain.rocks.clear_radius_m=3.3", "terrain.rocks.mirror_line=keep_off",
                     "referee.time_limit_s=100"});
}

// Own values of navigators follow.
constexpr std::size_t kOwnValues = 4;

TEST(DriveExperimentTest, SchemaListsTheColumnsInOrder) {
  const auto experiment = MakeExperiment(Pathfinder("level_sand"));
  const truth::RecordSchema& schema = experiment->schema();
  ASSERT_EQ(schema.size(), truth::kDriveColumns.size() + kOwnValues);
  EXPECT_EQ(schema[truth::kDriveColumns.size()].name, "enav.cycles");
  for (std::size_t i = 0; i < truth::kDriveColumns.size(); ++i) {
    EXPECT_EQ(schema[i].name, truth::kDriveColumns[i].name);
    EXPECT_EQ(schema[i].unit, truth::kDriveColumns[i].unit);
    EXPECT_EQ(schema[i].meaning, truth::kDriveColumns[i].meaning);
  }
}

TEST(DriveExperimentTest, RecordHoldsTheDriveBitForBit) {
  const scenario::Scenario scenario = Pathfinder("level_sand");
  const truth::Record record = MakeExperiment(scenario)->Run(5, 3);
  const trial::DriveResult drive = trial::RunTrial(scenario.drive, {5, 3});
  EXPECT_EQ(record.trial, 3u);
  EXPECT_EQ(record.outcome, drive.outcome);
  EXPECT_EQ(record.detail, drive.detail);
  ASSERT_EQ(record.values.size(), truth::kDriveColumns.size() + kOwnValues);
  for (std::size_t i = 0; i < truth::kDriveColumns.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(record.values[i]),
              std::bit_cast<std::uint64_t>(drive.record.*truth::kDriveColumns[i].member))
        << truth::kDriveColumns[i].name;
  }
}

TEST(DriveExperimentTest, FaultsAreRecordsThatNameSeedAndIndex) {
  const auto experiment = MakeExperiment(CrowdedScenario());
  int faults = 0;
  int drives = 0;
  for (std::uint64_t index = 0; index < 8; ++index) {
    const truth::Record record = experiment->Run(1, index);
    EXPECT_EQ(record.trial, index);
    if (record.outcome != truth::TrialOutcome::kSimulatorFault) {
      EXPECT_EQ(record.values.size(), truth::kDriveColumns.size() + kOwnValues);
      ++drives;
      continue;
    }
    EXPECT_TRUE(record.values.empty());
    EXPECT_EQ(record.detail,
              "no place without overlap for every rock of an exact count (seed 1, trial " +
                  std::to_string(index) + ")");
    ++faults;
  }
  EXPECT_GE(faults, 1);
  EXPECT_GE(drives, 1);
}

TEST(DriveExperimentTest, BlowUpsOfThePhysicsAreFaults) {
  // Beyond the angle of friction the rover slides until its speed leaves the model's range.
  // Scenarios refuse such a slope.
  auto scenario = Pathfinder("level_sand", {"terrain.ground.slope_direction_deg=90",
                                            "terrain.ground.soil.friction_angle_deg=5"});
  scenario.drive.terrain.ground.slope_rad = math::DegToRad(40.0);
  const auto experiment = MakeExperiment(scenario);
  const truth::Record record = experiment->Run(1, 0);
  EXPECT_EQ(record.outcome, truth::TrialOutcome::kSimulatorFault);
  EXPECT_NE(record.detail.find("(seed 1, trial 0)"), std::string::npos) << record.detail;
}

// All but the path ratio of a rover that did not arrive, which there is none of.
TEST(DriveExperimentTest, EveryValueIsFinite) {
  for (const char* name : {"level_sand", "nominal", "obstacles_0.85", "vl2"}) {
    const auto experiment = MakeExperiment(Pathfinder(name, {"referee.time_limit_s=2000"}));
    for (std::uint64_t index = 0; index < 2; ++index) {
      const truth::Record record = experiment->Run(7, index);
      ASSERT_NE(record.outcome, truth::TrialOutcome::kSimulatorFault) << record.detail;
      for (std::size_t i = 0; i < truth::kDriveColumns.size(); ++i) {
        // Of the columns that may lack a value these drives have a path ratio at most: no filter
        // and no rock at the goal.
        const truth::DriveColumn& column = truth::kDriveColumns[i];
        const bool lacks = column.may_lack &&
                           (column.name != "path_ratio" || !truth::DeclaredSuccess(record.outcome));
        EXPECT_EQ(std::isfinite(record.values[i]), !lacks)
            << name << " " << index << " " << truth::kDriveColumns[i].name;
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::experiments
