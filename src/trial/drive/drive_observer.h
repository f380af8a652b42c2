// What the record of a drive tells: Drive lets the observer gather it while the drive goes on and
// report it at the end. The report of the columns stands in drive_observer_report.cc.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "math/pose.h"
#include "messages/commands.h"
#include "trial/aids/visual_aid.h"
#include "trial/counters/drive_counters.h"
#include "trial/counters/drive_monitor.h"
#include "trial/counters/hazard_watch.h"
#include "trial/drive/onboard.h"
#include "trial/drive/world.h"
#include "trial/referee/referee.h"
#include "trial/referee/slip_onset.h"
#include "trial/run_trial.h"
#include "trial/watchers.h"
#include "truth/drive_record.h"

namespace rockyard::trial {

// Returns watchers for the on-board side, which show `watchers` what the rover makes of a look,
// with the truth of that moment beside it. `world` outlives them.
SightWatchers WithTruth(const Watchers& watchers, const World& world);

// Holds what the rover believes against what is true, for the referee and for the record. Must
// stay: it changes nothing in the drive.
class DriveObserver {
 public:
  // All references outlive it. `told`: the waypoints, then the goal, as the rover is told.
  DriveObserver(const World& world, const Onboard& onboard, const Ledger& ledger,
                std::vector<messages::Goal> told);

  // The rover stands at the start, or where operators have put it.
  void OnPlaced();
  void OnReflection() { ++reflections_; }
  // The navigator told a motion. Returns whether a new move begins with it.
  bool OnMotion(const messages::MotionCommand& motion);
  // The rover stops for a look.
  void OnLook() { moves_.OnLook(); }
  // The look of that number is taken where the rover is now.
  void OnSeen(std::int64_t look) { looked_from_X_WR_[look] = world_.state().X_WR; }
  // Returns where the rover truly was when it took the look. Forgets the looks before it.
  math::Transform LookedFrom(std::int64_t look);
  // The report of a look is there; `hazard`: whether it names one.
  void OnReport(bool hazard, std::int64_t look);
  void OnWheels(bool moving) { stops_.Observe(moving); }
  void OnScrape();
  void OnStuckNoticed() { ++stuck_noticed_; }
  void OnRecognized() { recognized_ = true; }
  // A pair of images for visual odometry is taken.
  void OnMotionSeen(const VisualStep& step);
  void OnSlip(const SlipReading& slip);
  // Visual odometry corrected the estimate.
  void OnSeenMotion();
  // A control tick has ended, and the estimator has taken it.
  void OnTick(bool turning_in_place);

  // Returns truth and belief of now, for the referee.
  Observation Observed(Activity activity, int direction, double duration_s) const;
  // Looks and returns whether the rover has found the rock at its goal, where there is one.
  bool FoundRock();

  // Returns all columns of the record. `stall`: of a rover that was found stuck.
  truth::DriveRecord Report(bool declared_success, const Stall& stall,
                            const Referee& referee) const;
  // Returns what the drive leaves to the next one, without what the estimator keeps.
  DriveEnd End() const;

 private:
  // Holds believed heading and distance against the true ones.
  void ObserveErrors();

  void ReportGoals(truth::DriveRecord& record) const;
  void ReportPoses(truth::DriveRecord& record) const;
  void ReportErrors(truth::DriveRecord& record) const;
  void ReportBelief(truth::DriveRecord& record) const;
  void ReportVision(truth::DriveRecord& record) const;
  void ReportLedger(truth::DriveRecord& record, const Stall& stall) const;
  void ReportCounts(truth::DriveRecord& record, const Referee& referee) const;
  void ReportHazards(truth::DriveRecord& record) const;
  void ReportGoalRock(truth::DriveRecord& record) const;
  void ReportPlans(truth::DriveRecord& record) const;

  const World& world_;
  const Onboard& onboard_;
  const Ledger& ledger_;
  const DriveParams& params_;
  std::vector<messages::Goal> told_places_;
  std::optional<GoalRock> goal_rock_;
  std::map<std::int64_t, math::Transform> looked_from_X_WR_;
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
  std::optional<double> largest_slip_;     // that visual odometry saw
  std::optional<double> first_slip_m_;     // true path length at the first alarm
  bool recognized_ = false;                // the goal rock
  messages::PoseEstimate seen_at_;         // the last place of visual odometry, or the start
  std::optional<double> seen_distance_m_;  // way between the places of visual odometry
};

}  // namespace rockyard::trial
