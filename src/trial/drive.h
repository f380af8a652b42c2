// The closed loop of one trial. See run_trial.h for the entry point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "localization/estimator.h"
#include "navigation/motion_follower.h"
#include "navigation/waypoint_sequence.h"
#include "navigation/wheel_driver.h"
#include "perception/stuck_detector.h"
#include "rover/rover.h"
#include "sensing/feature_tracker.h"
#include "sensing/motion_sensors.h"
#include "terrain/field.h"
#include "trial/drive_monitor.h"
#include "trial/drive_params.h"
#include "trial/error_growth.h"
#include "trial/hazard_counter.h"
#include "trial/hazard_watch.h"
#include "trial/ledger.h"
#include "trial/mirror_arena.h"
#include "trial/move_counter.h"
#include "trial/referee.h"
#include "trial/run_trial.h"
#include "trial/step_watcher.h"
#include "trial/stop_counter.h"
#include "trial/stretch.h"
#include "trial/terrain_sensing.h"
#include "trial/turn_counter.h"
#include "trial/vehicle_guard.h"

namespace rockyard::trial {

// One drive from the start to its end. Every control tick the navigator decides from what is
// measured; the drive applies wheel commands for a few physics steps, hands the measurements to the
// localizer, and shows the truth to the monitor and the referee.
class Drive {
 public:
  Drive(const DriveParams& drive, core::TrialKey key, truth::Trace* trace,
        const ScanWatcher& scan_watcher, StepWatcher step_watcher);

  DriveResult Run();

 private:
  std::optional<Verdict> Tick();
  // Shows the tracked goal to the navigator, where there is one and it is in view.
  void TrackGoal();
  // The navigator has gone on from its goal number `first`, and perhaps from more.
  void OnWaypoints(std::size_t first);
  std::optional<Verdict> Look(messages::LookDirection direction);
  // What the navigator made of the last look.
  void ShowStep();
  // What a move takes beyond the motion of wheels.
  void SpendOverhead();
  void RestBetweenMoves(double duration_s);
  // One tick of the motion that was told. A rover that is told to stop, or whose plan is at its
  // end, waits at rest.
  std::optional<Verdict> Follow(const messages::MotionCommand& told);
  std::optional<Verdict> Move(const messages::MotionCommand& motion, const Stretch& stretch);

  // Holds the command for so many physics steps.
  void ApplyCommand(const messages::WheelCommand& command, std::int64_t steps);
  // The pose that the rover believes takes one stretch of encoders and gyro.
  messages::MotionMeasurement UpdateEstimate(double duration_s, bool moving);
  // Asks whether the rover gets on, where it looks for that.
  void NoticeStuck(const messages::WheelCommand& command,
                   const messages::MotionMeasurement& motion);
  const messages::PoseEstimate& pose() const { return estimator_->estimate().pose; }
  // What the rover believes, against what the monitor saw.
  void ObserveErrors();
  void ReflectAtMirrorLine(int direction);
  Observation Observed(Activity activity, int direction, double duration_s) const;
  std::optional<Verdict> AskReferee(Activity activity, int direction, double duration_s);
  DriveResult Finish(const Verdict& verdict);
  // What a stuck rover would still take, and with referee.stuck_rover run_on takes.
  void Strand();
  void ReportGoals(truth::DriveRecord& record) const;
  void ReportPoses(truth::DriveRecord& record) const;
  void ReportErrors(truth::DriveRecord& record) const;
  void ReportLedger(truth::DriveRecord& record) const;
  void ReportCounts(truth::DriveRecord& record) const;
  void ReportHazards(truth::DriveRecord& record) const;

  void Record(std::string kind, std::string detail);
  void RecordLook(messages::LookDirection direction);
  void RecordWaypoint(std::size_t index);
  void Sample(Activity activity);
  // Spends time at rest.
  void Rest(Activity activity, double duration_s);
  // A moment between control ticks; `activity`: of the rest that ends here.
  void RecordRest(std::optional<Activity> activity, bool set_back = false);
  void RecordRocks();
  truth::TraceSample Now(std::string activity) const;

  const DriveParams& params_;
  core::TrialKey key_;
  std::vector<messages::Goal> designated_goals_;  // waypoints, then the goal
  truth::Trace* trace_;

  terrain::Field field_;
  std::vector<math::Vector3> rock_centers_;  // where a trace knows rocks that can move
  std::unique_ptr<rover::Rover> rover_;
  Stretch tick_;  // of control
  Stretch stop_;  // before a scan
  std::optional<MirrorArena> mirror_;

  TerrainSensing terrain_sensing_;
  std::optional<sensing::MotionSensors> motion_sensors_;
  VehicleGuard guard_;
  std::optional<perception::StuckDetector> stuck_detector_;
  bool notices_stuck_ = false;  // at the last tick

  std::optional<sensing::FeatureTracker> feature_tracker_;
  std::int64_t next_sighting_ = 0;  // number of its next measurement
  bool sees_goal_ = false;          // at the last one

  std::unique_ptr<localization::Estimator> estimator_;
  double start_z_m_ = 0.0;  // of the true pose

  navigation::WaypointSequence navigator_;
  navigation::MotionFollower follower_;
  navigation::WheelDriver wheel_driver_;

  Ledger ledger_;
  Stall stall_;  // of a rover that was found stuck
  DriveMonitor monitor_;
  ErrorGrowth heading_growth_;   // deg
  ErrorGrowth distance_growth_;  // m
  HazardWatch watch_;
  Referee referee_;

  StepWatcher step_watcher_;
  Percept percept_;       // of the last tick, where it was a look
  bool rolling_ = false;  // in the last stretch
  // Since operators turned it: they let a rover drive before they turn it again.
  bool has_rolled_ = true;
  HazardCounter hazards_;
  TurnCounter turns_;
  MoveCounter moves_;
  StopCounter stops_;
  std::optional<double> first_scrape_m_;  // true path length
  std::int64_t reflections_ = 0;
  std::int64_t stuck_noticed_ = 0;
};

}  // namespace rockyard::trial
