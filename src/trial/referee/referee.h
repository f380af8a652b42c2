// The referee sees the truth and says when a drive is over, and why; Drive asks it after every
// tick. On-board code never hears of it.
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

// Why a drive is over.
struct Verdict {
  truth::EndCause cause = truth::EndCause::kArrived;

  truth::TrialOutcome outcome() const { return truth::Info(cause).outcome; }
};

// The bounds of the arena along x, beyond which a rover has left it.
struct ArenaBounds {
  double min_x_m = 0.0;
  double max_x_m = 0.0;
};

// Truth and belief at the end of one control tick.
struct Observation {
  Activity activity = Activity::kDriving;
  int direction = 1;        // of the told motion: +1 forward or left, -1 backward or right
  double duration_s = 0.0;  // of the tick
  const truth::RoverState& state;
  const messages::PoseEstimate& estimate;
  double true_distance_m = 0.0;      // driven so far
  double turned_in_place_rad = 0.0;  // so far, true
};

// The referee of one drive.
class Referee {
 public:
  // Arrival is judged at the true goal of `course`. Progress brings the rover nearer to the goal or
  // waypoint that it was told and drives to, at first `told_goal`.
  Referee(const RefereeParams& params, const CourseParams& course, const messages::Goal& told_goal,
          std::optional<ArenaBounds> bounds, double wheel_radius_m);

  // Returns the verdict after a tick, if the drive is over for another reason than that its
  // navigator stopped. Records depend on the order of the rules: where several hold after one tick,
  // the first one in referee.cc is the cause.
  std::optional<Verdict> Observe(const Observation& observation, const Ledger& ledger);

  // Takes that operators have turned the rover where it stands and reflected its estimate about the
  // mirror line y = line_m; `state` is the state after that. What they did is no motion of the
  // rover's own: headings and estimate at the beginning of the open window are reflected, too.
  void OnReflection(const truth::RoverState& state, double line_m);

  // Takes that the rover declared to be at a waypoint and drives to the next goal: patience begins
  // anew.
  void OnNextGoal(const messages::Goal& told_goal, const Observation& observation, double time_s);

  // Takes that the goal which the rover drives to is believed to lie elsewhere. That is no
  // progress: patience goes on.
  void OnGoalMoved(const messages::Goal& told_goal) { told_goal_ = told_goal; }

  // Returns the verdict on a navigator that stopped by itself, at a simulated time.
  Verdict OnNavigatorStop(navigation::NavigatorStatus status, const truth::RoverState& state,
                          double time_s) const;

  // Return the most that was driven, and turned in place, between two progresses towards the goal,
  // or since the last one. Must stay: nothing before a verdict depends on the operator's patience,
  // so that a trial without patience tells what it would have been with some: no path where one of
  // the two exceeds the patience, else what it was.
  double no_progress_distance_m() const { return no_progress_distance_m_; }
  double no_progress_turn_rad() const { return no_progress_turn_rad_; }

 private:
  // A window of commanded motion, in which scans do not count.
  struct Window {
    math::Pose2 pose;                 // true, at the beginning
    messages::PoseEstimate estimate;  // believed, at the beginning
    double duration_s = 0.0;
    double belly_s = 0.0;  // time with the belly on a rock
    math::Transform last_X_WR = math::Transform::Identity();
    // True motion in the told direction, summed tick by tick: it grows for a rover that is told to
    // go to and fro and does so, and not for a rover that is rocked to and fro while told one
    // direction.
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

  // Returns the verdict of being stuck, at the end of a window without motion: high-centred where
  // the belly rested on a rock, else jammed.
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
