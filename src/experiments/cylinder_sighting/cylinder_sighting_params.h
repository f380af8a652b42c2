// Parameters of the experiment "cylinder_sighting", on the coloured cylinder before the lander's
// cameras. A default decides the records of scenarios that leave it out; a bound only refuses
// files.
#pragma once

#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "experiments/cell_factor_params.h"
#include "rendering/cylinder/cylinder_params.h"
#include "trial/drive_params.h"
#include "vision/cylinder/published_finder_params.h"
#include "vision/cylinder/robust_finder_params.h"

namespace rockyard::experiments {

struct CylinderSightingParams {
  std::int64_t views_per_run = 1;
  std::int64_t measurements_per_view = 10;
  std::vector<double> distances_m{0.914, 1.829, 4.572, 10.058, 15.0};
  std::vector<double> orientations_deg;    // empty: drawn from all
  std::vector<double> sun_elevations_deg;  // empty: that of picture.light
  std::vector<double> clutter_levels;      // empty: 1
  std::vector<double> third_colours;       // empty: that of picture.target; 0 orange, 1 green
  bool any_sun_azimuth = false;
  double largest_bearing_rad = 0.0;
  double distance_spread = 0.0;
  bool present = true;
  rendering::CylinderPictureParams picture;
  vision::PublishedFinderParams published;
  vision::RobustFinderParams robust;

  std::vector<CellFactor> Factors() const;
  double Cells() const { return CellsOf(Factors()); }

  void Visit(core::FieldVisitor& v);
};

// Requires that the whole cylinder lies in both images at every distance and bearing. A failure
// names the parameter, what is wrong and a remedy.
void RequireSightable(const CylinderSightingParams& study, const trial::DriveParams& drive,
                      core::FieldVisitor& v);

}  // namespace rockyard::experiments
