// The interface of every path selection algorithm. A navigator sees measurements and estimates
// only.
#pragma once

#include "messages/commands.h"
#include "messages/estimates.h"
#include "messages/vehicle_state.h"

namespace rockyard::navigation {

enum class NavigatorStatus {
  kDriving,
  kArrived,  // believes to be at the goal
  kGaveUp,   // found no way
};

// What the navigator knows when it decides.
struct NavigatorInput {
  double time_s = 0.0;  // on-board clock since the start
  messages::PoseEstimate estimate;
  // The report that answers the last request for a scan; null at every other tick.
  const messages::HazardReport* report = nullptr;
  // What the rover feels at this tick and has to get away from, never a touch behind; null where it
  // feels no such hazard.
  const messages::VehicleHazard* vehicle_hazard = nullptr;
  bool touches_behind = false;  // at this tick, whatever else it feels
};

struct NavigatorDecision {
  NavigatorStatus status = NavigatorStatus::kDriving;
  // Stop and look: the next input carries a report. The motion is ignored.
  bool scan = false;
  messages::MotionCommand motion;
};

class Navigator {
 public:
  virtual ~Navigator() = default;

  // Called at every control tick, in order of time. Every manoeuvre ends by what `input` says was
  // measured on board.
  virtual NavigatorDecision Decide(const NavigatorInput& input) = 0;

  // Operators moved the estimate (lander update, arena reflection): anchors of running manoeuvres
  // have to follow.
  virtual void OnPoseUpdate(const messages::PoseEstimate& before,
                            const messages::PoseEstimate& after) = 0;
};

}  // namespace rockyard::navigation
