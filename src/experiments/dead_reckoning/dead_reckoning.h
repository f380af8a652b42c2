// The experiment "dead_reckoning" (make_experiment.cc): how the error of dead reckoning grows along
// a straight line. A scene is a walk.
//
// A walk follows Matthies 1995, section 5: x += dr cos(h), y += dr sin(h), h += dh, with dr = 6.7
// cm and dh = 0, each corrupted in every step by independent normal noise. The rover truly drives
// along x. What it measures goes through the dead reckoning that flies, so that the end of the walk
// is the error.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/check.h"
#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/dead_reckoning/dead_reckoning_walk_params.h"
#include "experiments/experiment.h"
#include "localization/dead_reckoning_params.h"
#include "messages/calibration.h"
#include "trial/drive_params.h"
#include "truth/record.h"

namespace rockyard::experiments {

// How a walk ended: what is believed less what is true.
struct WalkError {
  double along_m = 0.0;   // in the direction of the start
  double across_m = 0.0;  // to its left
  double heading_deg = 0.0;
  double distance_m = 0.0;  // of the odometer
};

// Sum, sum of squares and standard deviation of one error over the walks of a run.
struct WalkErrorSums : ErrorSums {
  double deviation = 0.0;  // n times the sample's, so that runs add up to a mean per walk
};

// Returns the sums over the walks of one member of their errors, of which there must be two or
// more.
inline WalkErrorSums SumsOf(const std::vector<WalkError>& errors, double WalkError::*error) {
  EXPECT(errors.size() >= 2);
  const auto n = static_cast<double>(errors.size());
  WalkErrorSums sums;
  for (const WalkError& walk : errors) sums.Add(walk.*error);
  const double mean = sums.sum / n;
  double about_mean = 0.0;
  for (const WalkError& walk : errors) about_mean += (walk.*error - mean) * (walk.*error - mean);
  sums.deviation = n * std::sqrt(about_mean / (n - 1.0));
  return sums;
}

struct WalkSums {
  double walks = 0.0;
  double way_m = 0.0;         // of all walks together
  double within_reach = 0.0;  // walks that end near enough to where they should
  WalkErrorSums along_m;
  WalkErrorSums across_m;
  WalkErrorSums heading_deg;
  WalkErrorSums distance_m;
};

template <typename Visitor>
void ForEachColumn(const WalkSums& s, const Visitor& visit) {
  using enum truth::ColumnRole;
  const auto error = [&](const std::string& name, const std::string& unit,
                         const std::string& meaning, const WalkErrorSums& sums) {
    const truth::ValueInfo like{"", unit, meaning, kSum, "walks"};
    VisitError(name, "_" + unit, like, sums, visit);
    visit({name + "_deviation_" + unit, unit,
           "standard deviation within the run, times its walks: " + meaning, kSum, "walks"},
          sums.deviation);
  };
  visit({"walks", "1", "walks, independent of one another", kTrials}, s.walks);
  visit({"way_m", "m", "true way of all walks", kBase}, s.way_m);
  visit({"within_reach", "1", "walks that end within reach_m of where the rover believes to be",
         kMainCount, "walks"},
        s.within_reach);
  error("along", "m", "believed less true place, in the direction of the start", s.along_m);
  error("across", "m", "believed less true place, to the left of it", s.across_m);
  error("heading", "deg", "believed less true heading, within half a turn", s.heading_deg);
  error("distance", "m", "odometer less true distance", s.distance_m);
}

// Standard deviations of the noise of one step, all independent.
struct StepNoise {
  double distance_deviation_m = 0.0;
  double turn_deviation_rad = 0.0;       // in driving
  double rest_turn_deviation_rad = 0.0;  // while standing after it
};

// What all walks of a cell have in common.
struct WalkPlan {
  double step_m = 0.0;
  std::int64_t steps = 0;
  double step_s = 0.0;  // of driving
  double rest_s = 0.0;  // of standing after every step
  StepNoise noise;
  double scale_deviation = 0.0;  // of the scale error that a walk keeps
};

// The rover that walks: its wheels as they are, and what it believes of them.
struct WalkingRover {
  messages::DriveCalibration wheels;
  messages::DriveCalibration believed;
  localization::DeadReckoningParams dead_reckoning;
};

// Returns the error at the end of a walk. The noise comes from stream kExperiment of `key`. Records
// depend on the order of the draws: the scale, then of each step the distance, the turn and, where
// the rover rests, the turn at rest. Cost: 0.15 us a step.
WalkError WalkStraight(const WalkingRover& rover, const WalkPlan& plan, core::TrialKey key);

// Returns every column but the number of the cell: first the factors that name a cell, then those
// of WalkSums.
const truth::RecordSchema& DeadReckoningColumns();

class DeadReckoningExperiment final : public CellExperiment {
 public:
  // Cost of a run: 0.15 us a step of every walk.
  DeadReckoningExperiment(const DeadReckoningWalkParams& params, const trial::DriveParams& drive);

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override;

  DeadReckoningWalkParams params_;
  WalkingRover rover_;
};

// Returns what the walks of one cell have in common. `values` are those of params.Factors(), in
// their order.
WalkPlan PlanOf(const DeadReckoningWalkParams& params, const std::vector<double>& values);

}  // namespace rockyard::experiments
