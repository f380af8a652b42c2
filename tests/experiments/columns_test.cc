#include <gtest/gtest.h>

#include <cstddef>
#include <string_view>

#include "core/json_file.h"
#include "core/json_value.h"
#include "experiments/drive/drive_experiment.h"
#include "experiments/hazard_detection/hazard_detection.h"
#include "experiments/hazard_scenarios.h"
#include "experiments/make_experiment.h"
#include "experiments/stereo_scenarios.h"
#include "experiments/three_rock_run/three_rock_run.h"
#include "scenario/load.h"
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
  for (const std::string_view name : core::EnumNames<ExperimentKind>::kNames) {
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

}  // namespace
}  // namespace rockyard::experiments
