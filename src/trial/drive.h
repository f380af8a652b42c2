// The closed loop of one trial. See run_trial.h for the entry point.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/random.h"
#include "navigation/navigator.h"
#include "navigation/wheel_driver.h"
#include "perception/dead_reckoning.h"
#include "perception/hazard_detector.h"
#include "perception/triangulation.h"
#include "rover/rover.h"
#include "scenario/scenario.h"
#include "sensing/motion_sensors.h"
#include "terrain/field.h"
#include "trial/drive_monitor.h"
#include "trial/hazard_scanner.h"
#include "trial/hazard_watch.h"
#include "trial/ledger.h"
#include "trial/mirror_arena.h"
#include "trial/referee.h"
#include "trial/run_trial.h"
#include "trial/stretch.h"
#include "trial/turn_counter.h"
#include "trial/vehicle_guard.h"

namespace rockyard::trial {

// One drive from the start to its end. Every control tick the navigator decides from what is
// measured; the drive applies wheel commands for a few physics steps, hands the measurements to the
// estimator, and shows the truth to the monitor and the referee.
class Drive {
 public:
  Drive(const scenario::Scenario& scenario, core::TrialKey key, truth::Trace* trace,
        const ScanWatcher& watcher);

  DriveResult Run();

 private:
  std::optional<Verdict> Tick();
  std::optional<Verdict> Scan();
  std::optional<Verdict> Move(const messages::MotionCommand& motion, const Stretch& stretch);

  // Holds the command for so many physics steps.
  void ApplyCommand(const messages::WheelCommand& command, std::int64_t steps);
  void UpdateEstimate(double duration_s, bool moving);
  void ReflectAtMirrorLine(int direction);
  std::optional<Verdict> AskReferee(Activity activity, int direction, double duration_s);
  DriveResult Finish(const Verdict& verdict);
  void ReportPoses(truth::DriveRecord& record) const;
  void ReportErrors(truth::DriveRecord& record) const;
  void ReportLedger(truth::DriveRecord& record) const;
  void ReportCounts(truth::DriveRecord& record) const;
  void ReportHazards(truth::DriveRecord& record) const;

  void Record(std::string kind, std::string detail);
  void Sample(Activity activity);

  const scenario::Scenario& scenario_;
  core::TrialKey key_;
  truth::Trace* trace_;

  terrain::Field field_;
  std::unique_ptr<rover::Rover> rover_;
  Stretch tick_;  // of control
  Stretch stop_;  // before a scan
  double scan_time_s_;
  std::optional<MirrorArena> mirror_;

  HazardScanner scanner_;
  std::optional<sensing::MotionSensors> motion_sensors_;
  VehicleGuard guard_;

  perception::Triangulator triangulator_;
  perception::HazardDetector hazard_detector_;
  perception::DeadReckoning dead_reckoning_;

  std::unique_ptr<navigation::Navigator> navigator_;
  navigation::WheelDriver wheel_driver_;

  Ledger ledger_;
  DriveMonitor monitor_;
  HazardWatch watch_;
  Referee referee_;

  std::optional<messages::HazardReport> report_;
  std::int64_t scans_ = 0;
  std::int64_t rescans_ = 0;
  std::int64_t hazards_ = 0;
  TurnCounter turns_;
  std::int64_t reflections_ = 0;
};

}  // namespace rockyard::trial
