// A rover that has gone through a URDF file drives as the one that it was, bit for bit.
#include <gmock/gmock.h>

#include <algorithm>

#include "core/archive.h"
#include "core/json_file.h"
#include "rover/urdf.h"
#include "rover/urdf_reader/urdf_reader.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using testing::IsEmpty;
using testing::Not;

// The drive with its rover as the URDF file has it; what the file does not say stays.
DriveParams Imported(DriveParams drive) {
  const rover::UrdfReading reading = rover::ReadUrdf(rover::WriteUrdf(drive.rover), "a.urdf");
  core::JsonValue group = core::JsonValue::Object();
  const core::FieldTable table = core::ListParams(drive.rover);
  for (const core::ParameterInfo& parameter : table.parameters()) {
    if (!reading.places.contains(parameter.path)) {
      core::SetPath(group, parameter.path, parameter.value);
    }
  }
  group.Merge(reading.group);
  drive.rover = {};
  core::ReadParams(group, drive.rover);
  return drive;
}

class ImportedRover : public testing::TestWithParam<const char*> {};

TEST_P(ImportedRover, HasTheSameRecord) {
  const DriveParams drive = scenario::Shipped(GetParam(), {"referee.time_limit_s=60"}).drive;
  const DriveResult imported = RunTrial(Imported(drive), {1, 0});
  EXPECT_THAT(Differences(imported, RunTrial(drive, {1, 0})), IsEmpty());
  EXPECT_GT(imported.record.true_distance_m, 0.0);
  // The drive depends on what comes from the file.
  DriveParams other = drive;
  other.rover.geometry.wheel_radius_m *= 1.0 + 1e-9;
  EXPECT_THAT(Differences(imported, RunTrial(other, {1, 0})), Not(IsEmpty()));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ImportedRover,
                         testing::Values("pathfinder/nominal", "mars/mfex_nominal",
                                         "gestalt/abundance"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

}  // namespace
}  // namespace rockyard::trial
