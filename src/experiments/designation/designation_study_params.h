// Parameters of the experiment "designation", on goals designated in the lander's stereo images. A
// default decides the records of scenarios that leave it out; a bound only refuses files.
#pragma once

#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "experiments/cell_factor_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// The cameras' pixels and baseline, and the errors of operators, correlation and pan axis, are
// those of course.designation.
struct DesignationStudyParams {
  std::int64_t designations_per_run = 1000;
  std::vector<double> ranges_m{1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0};
  std::int64_t image_side_px = 256;
  double mast_height_m = 1.5;
  double goal_height_m = 0.0;
  double near_enough_m = 0.24;

  std::vector<CellFactor> Factors() const { return {{"range_m", ranges_m}}; }
  double Cells() const { return CellsOf(Factors()); }

  void Visit(core::FieldVisitor& v);
};

// Requires that both cameras image the goal at every range, wide of the image's edges. Each failure
// names the parameter, what is wrong and a remedy.
void RequireDesignable(const DesignationStudyParams& study, const trial::DriveParams& drive,
                       core::FieldVisitor& v);

}  // namespace rockyard::experiments
