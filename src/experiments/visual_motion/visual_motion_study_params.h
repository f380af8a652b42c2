// Parameters of the experiment "visual_motion", on how well visual odometry measures one motion. A
// default decides the records of scenarios that leave it out; a bound only refuses files.
#pragma once

#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "experiments/cell_factor_params.h"
#include "math/angles.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

struct VisualMotionStudyParams {
  std::int64_t steps_per_run = 4;
  std::vector<double> steps_m{0.0, 0.25, 0.5, 0.75, 1.0};
  std::vector<double> turns_deg{0.0, 6.0, 12.0, 18.0};
  // Values of parameters of the drive; an empty list leaves the scenario's own.
  std::vector<double> soil_graininess;
  std::vector<double> sun_elevations_deg;
  std::vector<double> baselines_m;

  double hazard_height_m = 0.2;
  double tilt_sd_rad = math::DegToRad(3.0);
  double prediction_error = 0.1;

  // Returns the factors in the order of their columns, the last one changing fastest. Way and turn
  // come first, as Measure reads them so.
  std::vector<CellFactor> Factors() const;
  double Cells() const { return CellsOf(Factors()); }

  void Visit(core::FieldVisitor& v);
};

// Requires level ground, on which the experiment stands the rover. A failure names the parameter,
// what is wrong and a remedy.
void RequireVisualMotion(const VisualMotionStudyParams& study, const trial::DriveParams& drive,
                         core::FieldVisitor& v);

}  // namespace rockyard::experiments
