// The entry of this folder: RunTrial runs one closed-loop drive of terrain, rover, sensors,
// estimator, navigator and referee. The experiments that drive, and the sols of a mission, call it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "localization/estimator.h"
#include "math/pose.h"
#include "terrain/field.h"
#include "trial/clock/power.h"
#include "trial/drive_params.h"
#include "trial/onboard_end.h"
#include "trial/watchers.h"
#include "truth/drive_record.h"
#include "truth/record.h"
#include "truth/trace.h"

namespace rockyard::trial {

// How a drive begins that goes on from an earlier one, beside the course, which says where the
// rover truly stands.
struct DriveStart {
  localization::EstimatorMemory memory;  // what the rover believes of where it stands
  const terrain::Field& field;           // the rocks among which it stands; outlives the drive
  std::optional<SolarSupply> sun;        // time 0 is the start of the drive; none: batteries alone
};

// What a drive leaves to the next one.
struct DriveEnd {
  math::Transform X_WR = math::Transform::Identity();  // true
  localization::EstimatorMemory memory;
  std::array<double, kActivityCount> energy_wh{};  // drawn, by activity
  double battery_wh = 0.0;                         // drawn from the batteries
};

// What came of one drive.
struct DriveResult {
  truth::TrialOutcome outcome = truth::TrialOutcome::kSimulatorFault;
  std::string detail;  // the sentence of the cause (truth/end_cause.h)
  OwnValues own_values;
  truth::DriveRecord record;
  DriveEnd end;
};

// Returns the drive with what all of its trials can share, made once: tables that each of them
// makes for itself otherwise. No result depends on it.
DriveParams ShareTables(DriveParams drive);

// Drives the trial that `key` names. Must stay: the result is a pure function of (drive, key), bit
// for bit; stores, pairs of runs, replays and kept hashes rely on it. `trace` records the course of
// the drive, and `watchers` are shown what is seen and decided, without any influence on the drive.
// Throws what the simulation throws (a contract violation, a blow-up of the physics); the
// experiment turns that into a simulator fault.
DriveResult RunTrial(const DriveParams& drive, core::TrialKey key, truth::Trace* trace = nullptr,
                     const Watchers& watchers = {});

// Drives a trial that goes on from an earlier one: a pure function of (drive, key, start). The
// start of drive.course is where the rover truly stands, drive.energy.battery_wh what its batteries
// still hold; the field is that of `start`, whatever drive.terrain says.
DriveResult RunTrial(const DriveParams& drive, core::TrialKey key, const DriveStart& start);

}  // namespace rockyard::trial
