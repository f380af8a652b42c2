// The referee sees the truth and says when a trial is over, and as what.
#pragma once

#include <optional>
#include <string>

#include "math/pose.h"
#include "messages/estimates.h"
#include "navigation/navigator.h"
#include "trial/course_params.h"
#include "trial/ledger.h"
#include "trial/referee_params.h"
#include "truth/record.h"
#include "truth/rover_state.h"

namespace rockyard::trial {

struct Verdict {
  truth::TrialOutcome outcome = truth::TrialOutcome::kSimulatorFault;
  std::string detail;
};

// Bounds of the arena along x; the sides of open and virtual arenas have none.
struct ArenaBounds {
  double min_x_m = 0.0;
  double max_x_m = 0.0;
};

// Truth and belief at the end of one control tick.
struct Observation {
  Activity activity = Activity::kDriving;
  double duration_s = 0.0;  // of the tick
  const truth::RoverState& state;
  const messages::PoseEstimate& estimate;
  double true_distance_m = 0.0;      // driven so far
  double turned_in_place_rad = 0.0;  // so far, true
};

class Referee {
 public:
  Referee(const RefereeParams& params, const CourseParams& course,
          std::optional<ArenaBounds> bounds);

  // The verdict after a tick, if the trial is over for another reason than the navigator's own.
  std::optional<Verdict> Observe(const Observation& observation, const Ledger& ledger);

  // The verdict on a navigator that stopped by itself.
  Verdict OnNavigatorStop(navigation::NavigatorStatus status, const truth::RoverState& state) const;

 private:
  std::optional<Verdict> CheckStuck(const Observation& observation);
  std::optional<Verdict> CheckNoPath(const Observation& observation);

  RefereeParams params_;
  CourseParams course_;
  std::optional<ArenaBounds> bounds_;

  // Stuck: the pose at which the running window of motionless driving began.
  bool window_open_ = false;
  math::Pose2 window_pose_;
  messages::PoseEstimate window_estimate_;
  double window_s_ = 0.0;
  double belly_s_ = 0.0;

  // No path: the state at the last progress towards the goal.
  double best_goal_distance_m_;
  double progress_distance_m_ = 0.0;
  double progress_turn_rad_ = 0.0;
};

}  // namespace rockyard::trial
