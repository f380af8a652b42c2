// What is: the ground, the rover on it, and its sensors. Hands out measurements.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "messages/commands.h"
#include "messages/measurements.h"
#include "messages/vehicle_state.h"
#include "rover/rover.h"
#include "sensing/motion_sensors.h"
#include "sensing/tracker.h"
#include "sensing/vehicle_sensors.h"
#include "terrain/field.h"
#include "trial/aids/aid_suite.h"
#include "trial/drive/aid_sensors.h"
#include "trial/drive/part_set.h"
#include "trial/drive_params.h"
#include "trial/eyes/rover_cameras.h"
#include "trial/eyes/terrain_sensor.h"
#include "trial/eyes/visual_eyes.h"
#include "trial/referee/goal_rock.h"

namespace rockyard::trial {

// What feels the motion of the wheels and of the body.
class MotionPart {
 public:
  MotionPart(const DriveParams& drive, core::TrialKey key);

  // The rover stands where the drive begins.
  void Begin(const DriveParams& drive, core::TrialKey key, const truth::RoverState& state);
  void OnPlaced(const truth::RoverState& state);

  // Once a physics step, which ends at `time_s`. Returns whether a scrape begins.
  bool Observe(const truth::RoverState& state, double time_s);

  messages::MotionMeasurement Measure(const truth::RoverState& state, double duration_s,
                                      bool moving) {
    return motion_->Measure(state, duration_s, moving);
  }
  messages::VehicleState Feel(const truth::RoverState& state, const messages::WheelCommand& command,
                              double duration_s);

  const sensing::ScrapeDetector& scrapes() const { return motion_->scrapes(); }

 private:
  std::optional<sensing::MotionSensors> motion_;  // from Begin on
  bool feels_;                                    // by any of:
  sensing::VehicleSensors vehicle_;
};

// One look of the tracker for what the rover drives to.
struct GoalLook {
  std::optional<messages::FeatureSighting> sighting = {};
};

// On-board code gets what these functions return, and never the world itself. What comes after
// `state` is for those who may see the truth: the referee, the record, an oracle.
class World {
 public:
  // `drive` outlives it. Without `given` the field is built that the trial's key names.
  World(const DriveParams& drive, core::TrialKey key, const terrain::Field* given = nullptr);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Puts the rover down where the course starts, once.
  void Begin();
  // Operators put it down there, with its sensors switched off meanwhile.
  void Place(const math::Pose2& X_WR);

  double step_s() const { return rover_->step_s(); }
  double ramp_s() const { return rover_->ramp_s(); }
  // Holds the command for one physics step, which ends at `time_s`. Returns whether a scrape of the
  // body begins.
  bool Step(const messages::WheelCommand& command, double time_s);

  // Each since the last call of its kind, over one on-board tick.
  messages::MotionMeasurement MeasureMotion(double duration_s, bool moving) {
    return parts_.get<MotionPart>().Measure(state(), duration_s, moving);
  }
  messages::VehicleState Feel(const messages::WheelCommand& command, double duration_s) {
    return parts_.get<MotionPart>().Feel(state(), command, duration_s);
  }

  LookData Look(messages::LookDirection direction, std::int64_t number) const {
    return terrain_sensor_->Look(field_.terrain, state().X_WR, direction, number);
  }
  AidAnswer AskAids(const AidRequest& request, double time_s) const {
    return aids_.Answer(request, state().X_WR, time_s);
  }
  MotionData LookForMotion() { return parts_.get<VisualEyes>().Look(state().X_WR); }
  // What was seen before is of no use any more.
  void RenewEyes() { parts_.get<VisualEyes>().Renew(); }

  bool tracks_goal() const { return tracker_.has_value(); }
  // The tracker's next look for the goal, or for the rock at it; nothing before it is due.
  std::optional<GoalLook> LookForGoal(double time_s);

  const truth::RoverState& state() const { return rover_->state(); }
  const rover::Rover& rover() const { return *rover_; }
  const terrain::Field& field() const { return field_; }
  const sensing::ScrapeDetector& scrapes() const { return parts_.get<MotionPart>().scrapes(); }
  double start_z_m() const { return start_z_m_; }  // where the drive began
  const DriveParams& params() const { return params_; }
  core::TrialKey key() const { return key_; }

 private:
  const DriveParams& params_;
  core::TrialKey key_;
  terrain::Field field_;
  std::unique_ptr<rover::Rover> rover_;
  RoverCameras cameras_;
  std::unique_ptr<TerrainSensor> terrain_sensor_;
  AidSensors aids_;
  PartSet<MotionPart, VisualEyes> parts_;
  std::optional<sensing::FeatureTracker> tracker_;
  std::optional<GoalRock> goal_rock_;
  std::int64_t next_sighting_ = 0;  // number of the tracker's next look
  double start_z_m_ = 0.0;
};

}  // namespace rockyard::trial
