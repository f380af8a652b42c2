// Sees the truth and says when a trial is over, and as what; on-board code never hears of it.
#pragma once

#include <optional>

#include "math/pose.h"
#include "messages/estimates.h"
#include "navigation/navigator.h"
#include "trial/clock/ledger.h"
#include "trial/course/course_params.h"
#include "trial/referee/referee_params.h"
#include "truth/end_cause.h"
#include "truth/record.h"
#include "truth/rover_state.h"

namespace rockyard::trial {

struct Verdict {
  truth::EndCause cause = truth::EndCause::kArrived;

  truth::TrialOutcome outcome() const { return truth::Info(cause).outcome; }
};

// Bounds of the arena along x; the sides of open and virtual arenas have none.
struct ArenaBounds {
  double min_x_m = 0.0;
  double max_x_m = 0.0;
};

// Truth and belief at the end of one control tick.
struct Observation {
  Activity activity = Activity::kDriving;
  int direction = 1;        // of the motion that was told: +1 forward or left, -1 backward or right
  double duration_s = 0.0;  // of the tick
  const truth::RoverState& state;
  const messages::PoseEstimate& estimate;
  double true_distance_m = 0.0;      // driven so far
  double turned_in_place_rad = 0.0;  // so far, true
};

class Referee {
 public:
  // Arrival is judged at the true goal of `course`; progress is what brings the rover nearer to the
  // goal or waypoint that it drives to, first of all `told_goal`.
  Referee(const RefereeParams& params, const CourseParams& course, const messages::Goal& told_goal,
          std::optional<ArenaBounds> bounds, double wheel_radius_m);

  // The verdict after a tick, if the trial is over for another reason than the navigator's own.
  std::optional<Verdict> Observe(const Observation& observation, const Ledger& ledger);

  // Operators have turned the rover where it stands and reflected its estimate about the mirror
  // line y = line_m; `state` is the one after. What they did is no motion of the rover's own:
  // headings and the estimate of the open window go with it.
  void OnReflection(const truth::RoverState& state, double line_m);

  // The rover declared that it is at a waypoint and drives to the next goal: patience begins anew.
  void OnNextGoal(const messages::Goal& told_goal, const Observation& observation, double time_s);

  // The goal that it drives to is believed to lie elsewhere: what it gained, it has gained.
  void OnGoalMoved(const messages::Goal& told_goal) { told_goal_ = told_goal; }

  // The verdict on a navigator that stopped by itself, at a simulated time.
  Verdict OnNavigatorStop(navigation::NavigatorStatus status, const truth::RoverState& state,
                          double time_s) const;

  // The most that was driven, and turned in place, since a progress towards the goal and before the
  // next one. Nothing before a verdict depends on the patience, so a trial that had none ends with
  // less of it as no path where one of the two is more, and as it did where neither is.
  double no_progress_distance_m() const { return no_progress_distance_m_; }
  double no_progress_turn_rad() const { return no_progress_turn_rad_; }

 private:
  // A stretch of commanded motion, scans left out.
  struct Window {
    math::Pose2 pose;  // at its beginning, true and believed
    messages::PoseEstimate estimate;
    double duration_s = 0.0;
    double belly_s = 0.0;  // of it with the belly on a rock
    math::Transform last_X_WR = math::Transform::Identity();
    // True motion the way it was told, summed tick by tick: it grows under a rover that is told to
    // go to and fro and does so, and not under one that is rocked to and fro while told one way.
    double obeyed_m = 0.0;
    double obeyed_rad = 0.0;
  };

  // The state at the last progress towards the goal.
  struct Progress {
    double goal_distance_m = 0.0;  // believed
    double x_m = 0.0;              // true
    double y_m = 0.0;
    double time_s = 0.0;
    double distance_m = 0.0;
    double turned_rad = 0.0;
  };

  // Stuck is high-centred where the belly rested on a rock, and jammed otherwise.
  std::optional<Verdict> CheckStuck(const Observation& observation);
  void OpenWindow(const Observation& observation);
  static void AddObeyed(const Observation& observation, Window& window);
  bool MovedSince(const Window& window, const Observation& observation) const;
  std::optional<Verdict> CheckNoPath(const Observation& observation, double time_s);
  bool MadeProgress(const Observation& observation);

  RefereeParams params_;
  CourseParams course_;
  messages::Goal told_goal_;
  std::optional<ArenaBounds> bounds_;
  double wheel_radius_m_;
  double tip_over_cosine_;
  std::optional<Window> window_;
  Progress progress_;
  double no_progress_distance_m_ = 0.0;
  double no_progress_turn_rad_ = 0.0;
};

}  // namespace rockyard::trial
