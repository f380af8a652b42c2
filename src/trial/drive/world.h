// The true side of a drive: the ground, the rover on it, and its sensors. Drive steps the world and
// hands its measurements to the on-board side; observer, operators and tracer see its truth. Every
// sensor draws by the trial's key, a purpose and a number of its own, so that none shifts another's
// noise; the field alone is drawn by LayoutKey, as trials may share rocks. Records depend on these
// keys and numbers, and on the order in Step: the rover, then the sensors at its new state.
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

// The sensors that feel the motion of the wheels and of the body.
class MotionPart {
 public:
  MotionPart(const DriveParams& drive, core::TrialKey key);

  // Begins with the rover where the drive begins.
  void Begin(const DriveParams& drive, core::TrialKey key, const truth::RoverState& state);
  void OnPlaced(const truth::RoverState& state);

  // Takes one physics step, which ends at `time_s`. Returns whether a scrape begins.
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
  bool feels_;                                    // whether any sensor of vehicle_ is there
  sensing::VehicleSensors vehicle_;
};

// One look of the tracker for what the rover drives to; without a sighting where it sees nothing.
struct GoalLook {
  std::optional<messages::FeatureSighting> sighting = {};
};

// The world of one drive. Must stay: on-board code gets what the functions before state() return,
// and never the world itself. state() and what comes after it is for those who may see the truth:
// the referee, the record, an oracle.
class World {
 public:
  // `drive` outlives it. Without a `given` field it builds the field that LayoutKey names.
  World(const DriveParams& drive, core::TrialKey key, const terrain::Field* given = nullptr);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Puts the rover down where the course starts; called once.
  void Begin();
  // Puts the rover down as operators do, with its sensors switched off meanwhile.
  void Place(const math::Pose2& X_WR);

  double step_s() const { return rover_->step_s(); }
  double ramp_s() const { return rover_->ramp_s(); }
  // Holds the command for one physics step, which ends at `time_s`. Returns whether a scrape of the
  // body begins.
  bool Step(const messages::WheelCommand& command, double time_s);

  // Return what was measured, and felt, since the last call of the same function, over one on-board
  // tick.
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
  // Makes the next look for motion a keyframe.
  void RenewEyes() { parts_.get<VisualEyes>().Renew(); }

  bool tracks_goal() const { return tracker_.has_value(); }
  // Returns the tracker's look for the goal, or for the rock at the goal; nothing before one is
  // due.
  std::optional<GoalLook> LookForGoal(double time_s);

  const truth::RoverState& state() const { return rover_->state(); }
  const rover::Rover& rover() const { return *rover_; }
  const terrain::Field& field() const { return field_; }
  const sensing::ScrapeDetector& scrapes() const { return parts_.get<MotionPart>().scrapes(); }
  double start_z_m() const { return start_z_m_; }  // height of R's origin where the drive began
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
