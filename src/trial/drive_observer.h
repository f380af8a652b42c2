// What a drive's record tells: gathered while it goes on, reported at its end.
#pragma once

#include <cstdint>
#include <optional>

#include "math/pose.h"
#include "messages/commands.h"
#include "trial/drive_counters.h"
#include "trial/drive_monitor.h"
#include "trial/drive_parts.h"
#include "trial/hazard_watch.h"
#include "trial/referee.h"
#include "trial/slip_onset.h"
#include "trial/visual_aid.h"
#include "truth/drive_record.h"

namespace rockyard::trial {

// Sees the truth and changes nothing.
class DriveObserver {
 public:
  // `parts` outlives it.
  explicit DriveObserver(const DriveParts& parts);

  // The rover stands at the start, or where operators have put it.
  void OnPlaced() {
    monitor_.Restart(parts_.state());
    steering_.Restart(parts_.state().steer_rad);
    slip_onset_.Restart();
    seen_at_ = parts_.estimate().pose;
  }
  void OnReflection() { ++reflections_; }
  // The navigator told a motion. Returns whether a new move begins with it.
  bool OnMotion(const messages::MotionCommand& motion);
  // The rover stops for a look; what it believed of it.
  void OnLook() { moves_.OnLook(); }
  // `X_WR`: where the rover was when it looked.
  void OnReport(bool hazard, const math::Transform& X_WR);
  void OnWheels(bool moving) { stops_.Observe(moving); }
  void OnScrape();
  void OnStuckNoticed() { ++stuck_noticed_; }
  void OnRecognized() { recognized_ = true; }
  void OnSlip(const SlipReading& slip);
  // Visual odometry corrected the estimate.
  void OnSeenMotion();
  // Once a control tick, after the estimate.
  void OnTick(bool turning_in_place);

  // For the referee.
  double distance_m() const { return monitor_.distance_m(); }
  double turned_in_place_rad() const { return monitor_.turned_in_place_rad(); }

  // All columns that a drive has. `stall`: of a rover that was found stuck.
  truth::DriveRecord Report(bool declared_success, const Stall& stall) const;

 private:
  // What the rover believes, against what the monitor saw.
  void ObserveErrors();

  void ReportGoals(truth::DriveRecord& record) const;
  void ReportPoses(truth::DriveRecord& record) const;
  void ReportErrors(truth::DriveRecord& record) const;
  void ReportBelief(truth::DriveRecord& record) const;
  void ReportVision(truth::DriveRecord& record) const;
  void ReportLedger(truth::DriveRecord& record, const Stall& stall) const;
  void ReportCounts(truth::DriveRecord& record) const;
  void ReportHazards(truth::DriveRecord& record) const;
  void ReportGoalRock(truth::DriveRecord& record) const;
  void ReportPlans(truth::DriveRecord& record) const;

  const DriveParts& parts_;
  DriveMonitor monitor_;
  ErrorGrowth heading_growth_;   // deg
  ErrorGrowth distance_growth_;  // m
  HazardWatch watch_;
  HazardCounter hazards_;
  TurnCounter turns_;
  MoveCounter moves_;
  StopCounter stops_;
  SteerCounter steering_;
  std::optional<double> first_scrape_m_;  // true path length
  std::int64_t reflections_ = 0;
  std::int64_t stuck_noticed_ = 0;
  SlipOnset slip_onset_;
  std::int64_t slip_alarms_ = 0;
  std::int64_t false_slip_alarms_ = 0;
  std::optional<double> largest_slip_;     // as seen
  std::optional<double> first_slip_m_;     // true path length at the first alarm
  bool recognized_ = false;                // the goal rock
  messages::PoseEstimate seen_at_;         // the last place of visual odometry, or the start
  std::optional<double> seen_distance_m_;  // way between them
};

}  // namespace rockyard::trial
