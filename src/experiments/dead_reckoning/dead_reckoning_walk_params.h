// Parameters of the experiment "dead_reckoning", which measures dead reckoning along a straight
// line. A default decides the records of scenarios that leave it out; a bound only refuses files.
#pragma once

#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "experiments/cell_factor_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

struct DeadReckoningWalkParams {
  std::int64_t walks_per_run = 1000;
  double step_m = 0.067;
  double speed_m_s = 0.15;
  double reach_m = 0.24;

  // Every list names cells: none may be empty.
  std::vector<double> distances_m{10.0, 20.0};
  std::vector<double> heading_variances_deg2_per_m{0.70};
  std::vector<double> distance_variances_m2_per_m{0.0039};
  std::vector<double> scale_deviations{0.0};
  std::vector<double> rests_s{0.0};

  // Returns the factors in the order of their columns (PlanOf reads them so), the last one changing
  // fastest.
  std::vector<CellFactor> Factors() const;
  double Cells() const { return CellsOf(Factors()); }

  void Visit(core::FieldVisitor& v);
};

// Requires that the drive's estimator is the dead reckoning that is measured. A failure names the
// parameter, what is wrong and a remedy.
void RequireDeadReckoning(const DeadReckoningWalkParams& study, const trial::DriveParams& drive,
                          core::FieldVisitor& v);

}  // namespace rockyard::experiments
