#include "experiments/dead_reckoning/dead_reckoning_walk_params.h"

#include <algorithm>

namespace rockyard::experiments {
namespace {

using core::Origin;

void VisitFactors(DeadReckoningWalkParams& p, core::FieldVisitor& v) {
  v.Reals("distances_m", p.distances_m,
          {.doc = "lengths of the walks, each the nearest number of whole steps",
           .min = 0.0,
           .max = 1000.0,
           .origin = Origin::kSetting});
  v.Reals("heading_variances_deg2_per_m", p.heading_variances_deg2_per_m,
          {.doc = "growth of the heading's variance a metre while the rover drives at speed_m_s",
           .min = 0.0,
           .max = 1e4,
           .origin = Origin::kSetting});
  v.Reals("distance_variances_m2_per_m", p.distance_variances_m2_per_m,
          {.doc = "growth of the distance's variance a metre",
           .min = 0.0,
           .max = 1.0,
           .origin = Origin::kSetting});
  v.Reals("scale_deviations", p.scale_deviations,
          {.doc = "standard deviations of an error of the odometer's scale that a walk keeps",
           .min = 0.0,
           .max = 1.0,
           .origin = Origin::kSetting});
  v.Reals("rests_s", p.rests_s,
          {.doc = "times at rest after every step, in which the heading's noise goes on as in "
                  "driving; 0 where it does not",
           .min = 0.0,
           .max = 1e4,
           .origin = Origin::kSetting});
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
            {.doc = "walks of one cell in one run, over which standard deviations are taken; run i "
                    "belongs to cell i modulo their number",
             .min = 2,
             .max = 100000,
             .origin = Origin::kSetting});
  v.Real("step_m", step_m,
         {.doc = "straight way after which the rover turns in place by the error of its heading",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5: steps of 6.7 cm"});
  v.Real("speed_m_s", speed_m_s,
         {.doc = "at which a step is driven: what time at rest counts for against a metre",
          .min = 1e-4,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5: Rocky 3.2 at 15 cm/s; MFEX at 0.67 cm/s"});
  v.Real("reach_m", reach_m,
         {.doc = "walks that end no farther than this from where the rover believes to be count as "
                 "within reach",
          .min = 0.0,
          .max = 1e3,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 4, 5: half the rover's width"});
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

void RequireDeadReckoning(const trial::DriveParams& drive, core::FieldVisitor& v) {
  v.Require(
      "localization.estimator", drive.localization.estimators.chosen().name() == "dead_reckoning",
      "is not dead_reckoning, which the experiment dead_reckoning measures", "use dead_reckoning");
}

}  // namespace rockyard::experiments
