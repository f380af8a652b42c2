#include "experiments/hazard_detection/columns.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "experiments/drive/drive_experiment.h"
#include "experiments/experiment.h"
#include "experiments/hazard_scenarios.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

TEST(HazardColumnsTest, EveryBaseIsAColumn) {
  for (const truth::ValueInfo& column : HazardColumns()) {
    const bool refers = !IsBase(column.role) && column.role != truth::ColumnRole::kFactor;
    EXPECT_EQ(column.of.empty(), !refers) << column.name;
    if (refers) {
      EXPECT_NE(truth::FindColumn(HazardColumns(), column.of), nullptr) << column.name;
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

// Drives and measurements both count "scans", which only the latter add up.
TEST(WithRolesTest, GivesAStoredSchemaTheRolesOfItsExperiment) {
  for (const char* name : {"detection", "approach", "false_alarm", "missed", "precision"}) {
    const auto experiment = MakeExperiment(HazardScenario(name));
    const truth::RecordSchema& schema = experiment->schema();
    const truth::RecordSchema stored = WithRoles(WithoutRoles(schema));
    ASSERT_EQ(stored.size(), schema.size());
    for (std::size_t i = 0; i < schema.size(); ++i) {
      EXPECT_EQ(stored[i].name, schema[i].name);
      EXPECT_EQ(stored[i].role, schema[i].role) << name << " " << schema[i].name;
      EXPECT_EQ(stored[i].of, schema[i].of) << name << " " << schema[i].name;
    }
  }
  for (const truth::ValueInfo& column : WithRoles(DriveSchema())) {
    EXPECT_EQ(column.role, truth::ColumnRole::kValue) << column.name;
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
