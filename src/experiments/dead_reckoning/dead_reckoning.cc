#include "experiments/dead_reckoning/dead_reckoning.h"

#include <cmath>
#include <string>

#include "core/check.h"
#include "experiments/record_of.h"
#include "math/angles.h"
#include "trial/eyes/onboard_calibration.h"

namespace rockyard::experiments {
namespace {

using enum truth::ColumnRole;

void AddError(const std::string& name, const std::string& unit, const std::string& meaning,
              truth::RecordSchema& columns) {
  columns.push_back({name + "_bias_" + unit, unit, meaning, kSum, "walks"});
  columns.push_back({name + "_error_" + unit, unit, meaning, kSquares, "walks"});
  columns.push_back({name + "_deviation_" + unit, unit,
                     "standard deviation within the run, times its walks: " + meaning, kSum,
                     "walks"});
}

truth::RecordSchema MakeWalkColumns() {
  truth::RecordSchema columns{
      {"distance_m", "m", "length of a walk; it has the nearest number of whole steps", kFactor},
      {"heading_variance_deg2_per_m", "deg2/m", "of the heading, in driving", kFactor},
      {"distance_variance_m2_per_m", "m2/m", "of the distance", kFactor},
      {"scale_deviation", "1", "of a scale error that a walk keeps", kFactor},
      {"rest_s", "s", "time at rest after a step, in which the heading's noise goes on", kFactor},
      {"walks", "1", "walks, independent of one another", kTrials},
      {"way_m", "m", "true way of all walks", kBase},
      {"within_reach", "1", "walks that end within reach_m of where the rover believes to be",
       kMainCount, "walks"},
  };
  AddError("along", "m", "believed less true place, in the direction of the start", columns);
  AddError("across", "m", "believed less true place, to the left of it", columns);
  AddError("heading", "deg", "believed less true heading, within half a turn", columns);
  AddError("distance", "m", "odometer less true distance", columns);
  return columns;
}

WalkingRover RoverOf(const trial::DriveParams& drive) {
  return {
      .wheels = trial::OnboardDriveCalibration(drive.rover, {}),
      .believed = trial::OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
      .dead_reckoning = drive.perception.dead_reckoning};
}

}  // namespace

const truth::RecordSchema& DeadReckoningColumns() {
  static const truth::RecordSchema kColumns = MakeWalkColumns();
  return kColumns;
}

WalkPlan PlanOf(const DeadReckoningWalkParams& params, const std::vector<double>& values) {
  EXPECT(values.size() == 5);
  WalkPlan plan;
  plan.step_m = params.step_m;
  plan.steps = std::llround(values[0] / params.step_m);
  plan.step_s = params.step_m / params.speed_m_s;
  plan.scale_deviation = values[3];
  plan.rest_s = values[4];
  // Variances a metre times the step. The heading's runs in time: q_t = q v, and at rest as in
  // driving.
  const double rad_per_deg = math::DegToRad(1.0);
  const double turn_variance_rad2_per_m = values[1] * rad_per_deg * rad_per_deg;
  plan.noise.turn_deviation_rad = std::sqrt(turn_variance_rad2_per_m * params.step_m);
  plan.noise.rest_turn_deviation_rad =
      std::sqrt(turn_variance_rad2_per_m * params.speed_m_s * plan.rest_s);
  plan.noise.distance_deviation_m = std::sqrt(values[2] * params.step_m);
  return plan;
}

DeadReckoningExperiment::DeadReckoningExperiment(const DeadReckoningWalkParams& params,
                                                 const trial::DriveParams& drive)
    : params_(params),
      table_(params.Factors()),
      rover_(RoverOf(drive)),
      schema_(CellSchema<WalkSums>(DeadReckoningColumns(), table_)) {}

WalkSums DeadReckoningExperiment::Measure(const WalkPlan& plan, core::TrialKey key) const {
  std::vector<WalkError> errors;
  errors.reserve(static_cast<std::size_t>(params_.walks_per_run));
  WalkSums sums;
  for (std::int64_t walk = 0; walk < params_.walks_per_run; ++walk) {
    const core::TrialKey scene = SceneKey(key, params_.walks_per_run, walk);
    const WalkError& error = errors.emplace_back(WalkStraight(rover_, plan, scene));
    if (std::hypot(error.along_m, error.across_m) <= params_.reach_m) sums.within_reach += 1.0;
  }
  sums.walks = static_cast<double>(params_.walks_per_run);
  sums.way_m = sums.walks * static_cast<double>(plan.steps) * plan.step_m;
  sums.along_m = SumsOf(errors, &WalkError::along_m);
  sums.across_m = SumsOf(errors, &WalkError::across_m);
  sums.heading_deg = SumsOf(errors, &WalkError::heading_deg);
  sums.distance_m = SumsOf(errors, &WalkError::distance_m);
  return sums;
}

truth::Record DeadReckoningExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  return RecordOf(seed, index, [&](const core::TrialKey& key) {
    const std::size_t number = index % table_.size();
    const std::vector<double> factors = table_.Values(number);
    return CellRecord(index, number, factors, Measure(PlanOf(params_, factors), key));
  });
}

}  // namespace rockyard::experiments
