#include "experiments/dead_reckoning/dead_reckoning.h"

#include <cmath>
#include <string>
#include <string_view>

#include "core/check.h"
#include "experiments/dead_reckoning/columns.h"
#include "experiments/record_of.h"
#include "experiments/scene_key.h"
#include "math/angles.h"
#include "trial/onboard_calibration.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

truth::RecordSchema WalkSchema(const CellTable& table) {
  std::vector<std::string> names;
  for (const std::string_view name : table.columns()) names.emplace_back(name);
  ForEachSum(WalkSums{}, [&](const std::string& name, double) { names.push_back(name); });
  const std::vector<std::string_view> views(names.begin(), names.end());
  return truth::MeasurementSchema(DeadReckoningColumns(), views);
}

WalkingRover RoverOf(const trial::DriveParams& drive) {
  return {
      .wheels = trial::OnboardDriveCalibration(drive.rover, {}),
      .believed = trial::OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
      .dead_reckoning = drive.perception.dead_reckoning};
}

}  // namespace

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
      schema_(WalkSchema(table_)) {}

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
    truth::Record record{index, truth::TrialOutcome::kMeasured, "", {static_cast<double>(number)}};
    for (const double value : factors) record.values.push_back(value);
    const WalkSums sums = Measure(PlanOf(params_, factors), key);
    ForEachSum(sums, [&](const std::string&, double value) { record.values.push_back(value); });
    return record;
  });
}

}  // namespace rockyard::experiments
