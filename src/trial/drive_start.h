// How a drive begins that goes on from an earlier one, and what it leaves to the next.
#pragma once

#include <array>
#include <optional>

#include "localization/estimator.h"
#include "math/pose.h"
#include "terrain/field.h"
#include "trial/power_budget.h"
#include "trial/solar_supply.h"

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

}  // namespace rockyard::trial
