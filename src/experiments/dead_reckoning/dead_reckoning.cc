#include "experiments/dead_reckoning/dead_reckoning.h"

#include <cmath>
#include <string>

#include "core/check.h"
#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "localization/dead_reckoning.h"
#include "math/angles.h"
#include "math/functions.h"
#include "messages/measurements.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::experiments {
namespace {

WalkingRover RoverOf(const trial::DriveParams& drive) {
  return {
      // Without errors of calibration what the rover believes is the truth.
      .wheels = trial::OnboardDriveCalibration(drive.rover, {}),
      .believed = trial::OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
      .dead_reckoning = drive.perception.dead_reckoning};
}

}  // namespace

const truth::RecordSchema& DeadReckoningColumns() {
  using enum truth::ColumnRole;
  static const truth::RecordSchema kColumns = ColumnsOf<WalkSums>({
      {"distance_m", "m", "length of a walk; it has the nearest number of whole steps", kFactor},
      {"heading_variance_deg2_per_m", "deg2/m", "of the heading, in driving", kFactor},
      {"distance_variance_m2_per_m", "m2/m", "of the distance", kFactor},
      {"scale_deviation", "1", "of a scale error that a walk keeps", kFactor},
      {"rest_s", "s", "time at rest after a step, in which the heading's noise goes on", kFactor},
  });
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
  // Variances a metre times the step. The variance of the heading grows with time, q_t = q v, at
  // rest as in driving.
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
    : CellExperiment(params.Factors(), DeadReckoningColumns()),
      params_(params),
      rover_(RoverOf(drive)) {}

std::vector<double> DeadReckoningExperiment::Measure(std::size_t cell, core::TrialKey key) const {
  const WalkPlan plan = PlanOf(params_, table().Values(cell));
  std::vector<WalkError> errors;
  errors.reserve(static_cast<std::size_t>(params_.walks_per_run));
  WalkSums sums;
  for (std::int64_t walk = 0; walk < params_.walks_per_run; ++walk) {
    const core::TrialKey scene = SceneKey(key, params_.walks_per_run, walk);
    const WalkError& error = errors.emplace_back(WalkStraight(rover_, plan, scene));
    if (math::Hypot(error.along_m, error.across_m) <= params_.reach_m) sums.within_reach += 1.0;
  }
  sums.walks = static_cast<double>(params_.walks_per_run);
  sums.way_m = sums.walks * static_cast<double>(plan.steps) * plan.step_m;
  sums.along_m = SumsOf(errors, &WalkError::along_m);
  sums.across_m = SumsOf(errors, &WalkError::across_m);
  sums.heading_deg = SumsOf(errors, &WalkError::heading_deg);
  sums.distance_m = SumsOf(errors, &WalkError::distance_m);
  return ValuesOf(sums);
}

namespace {

// Returns what wheels and gyro measure of `way_m`: the wheels roll 1 / distance_scale as far, as
// slip on level sand makes them.
messages::MotionMeasurement Measured(const WalkingRover& rover, double way_m, double turn_rad,
                                     double duration_s) {
  messages::MotionMeasurement motion;
  motion.duration_s = duration_s;
  motion.turn_rad = turn_rad;
  const double rolled_m = way_m / rover.dead_reckoning.distance_scale;
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    motion.wheel_turn_rad[wheel] =
        rolled_m / (rover.wheels.wheel_radius_m * rover.wheels.radius_ratio[wheel]);
  }
  return motion;
}

}  // namespace

WalkError WalkStraight(const WalkingRover& rover, const WalkPlan& plan, core::TrialKey key) {
  core::RandomStream noise(key, core::Purpose::kExperiment);
  localization::DeadReckoning reckoning(rover.believed, rover.dead_reckoning, math::Pose2{});
  const double scale = 1.0 + core::SampleNormal(noise, 0.0, plan.scale_deviation);
  for (std::int64_t step = 0; step < plan.steps; ++step) {
    const double way_m =
        plan.step_m * scale + core::SampleNormal(noise, 0.0, plan.noise.distance_deviation_m);
    const double turn_rad = core::SampleNormal(noise, 0.0, plan.noise.turn_deviation_rad);
    reckoning.Integrate(Measured(rover, way_m, turn_rad, plan.step_s));
    if (plan.rest_s > 0.0) {
      const double rest_rad = core::SampleNormal(noise, 0.0, plan.noise.rest_turn_deviation_rad);
      reckoning.Integrate(Measured(rover, 0.0, rest_rad, plan.rest_s));
    }
  }
  const messages::PoseEstimate& end = reckoning.estimate();
  const double true_m = static_cast<double>(plan.steps) * plan.step_m;
  return {end.x_m - true_m, end.y_m, math::RadToDeg(end.heading_rad), end.distance_m - true_m};
}

}  // namespace rockyard::experiments
