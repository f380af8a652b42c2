// One closed-loop drive: terrain, rover, sensors, localizer, navigator, referee.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/random.h"
#include "localization/estimator.h"
#include "math/pose.h"
#include "terrain/field.h"
#include "trial/clock/power.h"
#include "trial/drive_params.h"
#include "trial/watchers.h"
#include "truth/drive_record.h"
#include "truth/record.h"
#include "truth/trace.h"

namespace rockyard::trial {

// The rover stands where the course starts, in truth. What it believes of that, among which rocks
// it stands and what supplies it comes from here. `field` outlives the drive.
struct DriveStart {
  localization::EstimatorMemory memory;
  const terrain::Field& field;
  std::optional<SolarSupply> sun;  // time 0 is the start of the drive; none: batteries alone
};

struct DriveEnd {
  math::Transform X_WR = math::Transform::Identity();  // true
  localization::EstimatorMemory memory;
  std::array<double, kActivityCount> energy_wh{};  // drawn, by activity
  double battery_wh = 0.0;                         // of these, from the batteries
};

struct DriveResult {
  truth::TrialOutcome outcome = truth::TrialOutcome::kSimulatorFault;
  std::string detail;
  truth::DriveRecord record;
  DriveEnd end;
};

// Drives the trial that `key` names: a pure function of (drive, key), bit for bit, on which stores,
// pairs of runs, replays and kept hashes rely. With `trace` the course of the drive is recorded
// too, and `watchers` are shown what is seen and decided; all without any influence on it. Throws
// what the simulation throws: a contract violation, a blow-up of the physics; the experiment turns
// that into a simulator fault.
DriveResult RunTrial(const DriveParams& drive, core::TrialKey key, truth::Trace* trace = nullptr,
                     const Watchers& watchers = {});

// The same of a drive that goes on from an earlier one: a pure function of (drive, key, start).
// drive.course.start is where the rover truly stands, drive.energy.battery_wh what its batteries
// still hold; the field is that of `start`, whatever drive.terrain says.
DriveResult RunTrial(const DriveParams& drive, core::TrialKey key, const DriveStart& start);

}  // namespace rockyard::trial
