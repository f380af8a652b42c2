// Parameters of the experiment "arc_planning": whether a planner over arcs finds a path among rocks
// (Ghosh, Otsu and Ono 2018, section IV-B). A default decides the records of scenarios that leave
// it out; a bound only refuses files.
#pragma once

#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "experiments/cell_factor_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

struct ArcPlanningParams {
  std::int64_t maps_per_run = 1;
  std::vector<double> covers{0.01, 0.03, 0.05, 0.07, 0.10, 0.12, 0.15};
  std::vector<double> risks{0.0, 1e-8, 1e-6, 1e-4, 1e-3};

  double map_side_m = 15.0;
  double map_cell_m = 0.05;
  std::int64_t poses_per_map = 200;

  std::vector<double> curvatures_per_m{-0.56, -0.28, 0.0, 0.28, 0.56};
  double arc_m = 1.45;
  double check_spacing_m = 0.18;
  double goal_tolerance_m = 0.75;
  double place_bin_m = 0.25;
  std::int64_t heading_bins = 24;
  std::int64_t max_nodes = 100000;

  std::vector<CellFactor> Factors() const;
  double Cells() const { return CellsOf(Factors()); }

  void Visit(core::FieldVisitor& v);
};

// Requires rocks whose cover the cells can name, and a map that holds start and goal. A failure
// names the parameter, what is wrong and a remedy.
void RequireArcPlanning(const ArcPlanningParams& study, const trial::DriveParams& drive,
                        core::FieldVisitor& v);

}  // namespace rockyard::experiments
