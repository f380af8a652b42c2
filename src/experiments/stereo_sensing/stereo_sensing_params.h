// Parameters of the experiment "stereo_sensing", on what stereo cameras measure and miss. A default
// decides the records of scenarios that leave it out; a bound only refuses files.
#pragma once

#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "experiments/cell_factor_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

struct StereoSensingParams {
  std::int64_t looks_per_run = 1;
  // Values of parameters of the drive; an empty list leaves the scenario's own.
  std::vector<double> soil_graininess;
  std::vector<double> sun_elevations_deg;
  std::vector<double> baselines_m;
  std::vector<double> distances_m{0.5, 1.0, 1.5, 2.0, 3.0};

  double hazard_height_m = 0.20;
  double hazard_goodness = 42.0;
  std::int64_t min_rock_pixels = 4;

  // Returns the factors in the order of their columns, the last one, the nearest distance of a bin,
  // changing fastest.
  std::vector<CellFactor> Factors() const;
  double Cells() const { return CellsOf(Factors()); }
  // Returns the edge that ends the bin of distances that begins at `nearest_m`, one of the list but
  // the last.
  double FarthestOf(double nearest_m) const;

  void Visit(core::FieldVisitor& v);
};

// Requires that stereo is the sensor in use, with both its eyes and all that they see, on level
// ground with round rocks; that the navigator reads points; and that the cells are something that
// the cameras can measure. Each failure names the parameter, what is wrong and a remedy.
void RequireStereoMeasurable(const StereoSensingParams& study, const trial::DriveParams& drive,
                             core::FieldVisitor& v);

}  // namespace rockyard::experiments
