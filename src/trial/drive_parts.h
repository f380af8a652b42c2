// Everything that takes part in a drive, as it is set up from the parameters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/random.h"
#include "localization/estimator.h"
#include "messages/estimates.h"
#include "navigation/motion_follower.h"
#include "navigation/waypoint_sequence.h"
#include "navigation/wheel_driver.h"
#include "perception/stuck_detector.h"
#include "rover/rover.h"
#include "sensing/feature_tracker.h"
#include "sensing/motion_sensors.h"
#include "terrain/field.h"
#include "trial/aid_suite.h"
#include "trial/drive_params.h"
#include "trial/goal_rock.h"
#include "trial/ledger.h"
#include "trial/mirror_arena.h"
#include "trial/referee.h"
#include "trial/run_trial.h"
#include "trial/terrain_sensing.h"
#include "trial/timeline.h"
#include "trial/vehicle_guard.h"
#include "trial/visual_aid.h"
#include "trial/watchers.h"

namespace rockyard::trial {

// What is asked for in seconds happens in whole steps of the rover: a control tick of 1/25 s takes
// two steps of 1/60 s. duration_s is the time of these steps, and all that steers, measures or
// keeps books goes by it, never by the time asked for.
struct Stretch {
  std::int64_t steps = 1;
  double duration_s = 0.0;
};

// The nearest whole number of steps, one at least.
inline Stretch WholeSteps(double asked_s, double step_s) {
  const std::int64_t steps = std::max<std::int64_t>(1, std::llround(asked_s / step_s));
  return {steps, static_cast<double>(steps) * step_s};
}

// The loop (drive.h) moves them; who watches it (drive_observer.h, drive_tracer.h) reads them.
// `drive` outlives it, and so does `from`, which may be null.
struct DriveParts {
  DriveParts(const DriveParams& drive, core::TrialKey trial_key, const Watchers& watchers,
             const DriveStart* from = nullptr);
  DriveParts(const DriveParts&) = delete;
  DriveParts& operator=(const DriveParts&) = delete;

  // Puts the rover down at the start, where its sensors and its estimator begin.
  void Begin();

  const truth::RoverState& state() const { return rover->state(); }
  const messages::LocalizationEstimate& estimate() const { return estimator->estimate(); }

  const DriveParams& params;
  core::TrialKey key;
  const DriveStart* start;  // of a drive that goes on from an earlier one

  terrain::Field field;
  std::vector<messages::Goal> told_places;  // waypoints, then the goal, as the rover is told
  std::unique_ptr<rover::Rover> rover;
  Stretch tick;  // of control
  Stretch stop;  // before a scan
  std::optional<MirrorArena> mirror;

  TerrainSensing terrain_sensing;
  std::optional<sensing::MotionSensors> motion_sensors;  // from Begin on
  VehicleGuard guard;
  std::optional<perception::StuckDetector> stuck_detector;
  std::optional<sensing::FeatureTracker> feature_tracker;
  std::optional<GoalRock> goal_rock;

  std::unique_ptr<localization::Estimator> estimator;  // from Begin on
  CaptureCounter captures;
  AidSuite aids;
  VisualAid vision;
  double start_z_m = 0.0;  // true height where the drive began

  navigation::WaypointSequence navigator;
  navigation::MotionFollower follower;
  navigation::WheelDriver wheel_driver;

  Ledger ledger;
  Timeline timeline;
  Referee referee;
};

}  // namespace rockyard::trial
