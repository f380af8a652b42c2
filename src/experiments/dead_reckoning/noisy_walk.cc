#include "experiments/dead_reckoning/noisy_walk.h"

#include "core/random.h"
#include "localization/dead_reckoning.h"
#include "math/angles.h"
#include "messages/measurements.h"

namespace rockyard::experiments {
namespace {

// What wheels and gyro measure of `way_m`: the wheels roll 1 / distance_scale as far, as slip on
// level sand makes them.
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
