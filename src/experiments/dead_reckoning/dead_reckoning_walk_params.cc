#include "experiments/dead_reckoning/dead_reckoning_walk_params.h"

#include <algorithm>

namespace rockyard::experiments {
namespace {

using core::Published;
using core::Setting;

void VisitFactors(DeadReckoningWalkParams& p, core::FieldVisitor& v) {
  v.Reals("distances_m", p.distances_m,
          Setting("lengths of the walks, each the nearest number of whole steps", {0.0, 1000.0}));
  v.Reals("heading_variances_deg2_per_m", p.heading_variances_deg2_per_m,
          Setting("growth of the heading's variance a metre while the rover drives at speed_m_s",
                  {0.0, 1e4}));
  v.Reals("distance_variances_m2_per_m", p.distance_variances_m2_per_m,
          Setting("growth of the distance's variance a metre", {0.0, 1.0}));
  v.Reals("scale_deviations", p.scale_deviations,
          Setting("standard deviations of an error of the odometer's scale that a walk keeps",
                  {0.0, 1.0}));
  v.Reals("rests_s", p.rests_s,
          Setting("times at rest after every step, in which the heading's noise goes on as in "
                  "driving; 0 where it does not",
                  {0.0, 1e4}));
}

}  // namespace

std::vector<CellFactor> DeadReckoningWalkParams::Factors() const {
  return {{"distance_m", distances_m},
          {"heading_variance_deg2_per_m", heading_variances_deg2_per_m},
          {"distance_variance_m2_per_m", distance_variances_m2_per_m},
          {"scale_deviation", scale_deviations},
          {"rest_s", rests_s}};
}

void DeadReckoningWalkParams::Visit(core::FieldVisitor& v) {
  v.Integer("walks_per_run", walks_per_run,
            Setting("walks of one cell in one run, over which standard deviations are taken; run i "
                    "belongs to cell i modulo their number",
                    {2, 100000}));
  v.Real("step_m", step_m,
         Published("straight way after which the rover turns in place by the error of its heading",
                   "Matthies 1995 sec. 5: steps of 6.7 cm", {0.001, 10.0}));
  v.Real("speed_m_s", speed_m_s,
         Published("at which a step is driven: what time at rest counts for against a metre",
                   "Matthies 1995 sec. 5: Rocky 3.2 at 15 cm/s; MFEX at 0.67 cm/s", {1e-4, 10.0}));
  v.Real("reach_m", reach_m,
         Published("walks that end no farther than this from where the rover believes to be count "
                   "as within reach",
                   "Matthies 1995 sec. 4, 5: half the rover's width", {0.0, 1e3}));
  VisitFactors(*this, v);
  for (const CellFactor& factor : Factors()) {
    v.Require("distances_m", !factor.values.empty(), "or another list of cells is empty",
              "give every list at least one value, 0 for an error that is not there");
  }
  v.Require("distances_m",
            std::all_of(distances_m.begin(), distances_m.end(),
                        [&](double distance_m) { return distance_m >= step_m; }),
            "has a distance shorter than step_m", "walk at least one step");
  v.Require("distances_m", Cells() <= kMaxCells, "and the other lists span more than 2000 cells",
            "shorten the lists");
}

void RequireDeadReckoning(const DeadReckoningWalkParams& /*study*/, const trial::DriveParams& drive,
                          core::FieldVisitor& v) {
  v.Require(
      "localization.estimator", drive.localization.estimators.chosen().name() == "dead_reckoning",
      "is not dead_reckoning, which the experiment dead_reckoning measures", "use dead_reckoning");
}

}  // namespace rockyard::experiments
