// The closed loop of one trial. See run_trial.h for the entry point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/random.h"
#include "trial/drive_observer.h"
#include "trial/drive_params.h"
#include "trial/drive_parts.h"
#include "trial/drive_tracer.h"
#include "trial/referee.h"
#include "trial/run_trial.h"
#include "trial/slip_alarms.h"
#include "trial/timeline.h"
#include "trial/watchers.h"

namespace rockyard::trial {

// One drive from the start to its end. Every control tick the navigator decides from what is
// measured; the drive applies wheel commands for a few physics steps, hands the measurements to the
// localizer, and shows the truth to the monitor and the referee. Looks may be under way meanwhile
// (timeline.h).
class Drive {
 public:
  Drive(const DriveParams& drive, core::TrialKey key, truth::Trace* trace, const Watchers& watchers,
        const DriveStart* start = nullptr);

  DriveResult Run();

 private:
  std::optional<Verdict> Tick();
  // Shows the tracked goal to the navigator, where there is one and it is in view.
  void TrackGoal();
  // Whether the tracker looks now: where it is time for its next measurement, whose number it is.
  std::optional<std::int64_t> NextSighting();
  // Shows the goal rock to the navigator, where it is near and in view.
  void RecognizeRock();
  // The verdict on a rover that has found the rock at its goal.
  std::optional<Verdict> FindRock();
  // The navigator has gone on from its goal number `first`, and perhaps from more.
  void OnWaypoints(std::size_t first);
  // Whether the rover goes on meanwhile.
  bool LooksOnTheMove(const navigation::NavigatorDecision& decision) const;
  // Stops and looks.
  std::optional<Verdict> Look(messages::LookDirection direction);
  // Looks and goes on: a later tick delivers what was seen. Nothing happens where the cameras are
  // not free.
  std::optional<Verdict> LookOnTheMove(messages::LookDirection direction);
  std::unique_ptr<SeenLook> See(messages::LookDirection direction);
  // Takes images for visual odometry: stops for them, and for the computer, where these may not
  // overlap with the drive.
  std::optional<Verdict> SeeMotion();
  // Returns for how much of it the rover rests.
  double SpendOnVision(Activity activity, double duration_s, bool beside);
  // What the navigator made of the last look.
  void ShowStep();
  // What a move takes beyond the motion of wheels.
  void SpendOverhead();
  void RestBetweenMoves(double duration_s);
  // One tick of the motion that was told. A rover that is told to stop, or whose plan is at its
  // end, waits at rest.
  std::optional<Verdict> Follow(const messages::MotionCommand& told);
  // What cannot go on while the rover drives, it stops for.
  std::optional<Verdict> RestFor(const Timeline::Rest& rest);
  std::optional<Verdict> Move(const messages::MotionCommand& motion, const Stretch& stretch);

  // Holds the command for so many physics steps.
  void ApplyCommand(const messages::WheelCommand& command, std::int64_t steps);
  // The pose that the rover believes takes one stretch of encoders and gyro.
  messages::MotionMeasurement UpdateEstimate(double duration_s, bool moving);
  // Aids measure, and what they measured before reaches the estimator.
  void UseAids();
  // A stretch in which the wheels stood; a gyro may drift in it.
  void UpdateEstimateAtRest(double duration_s);
  // Asks whether the rover gets on, where it looks for that.
  void NoticeStuck(const messages::WheelCommand& command,
                   const messages::MotionMeasurement& motion);
  void ReflectAtMirrorLine(int direction);
  Observation Observed(Activity activity, int direction, double duration_s) const;
  std::optional<Verdict> AskReferee(Activity activity, int direction, double duration_s);
  DriveResult Finish(const Verdict& verdict);
  DriveEnd End() const;
  // What a stuck rover would still take, and with referee.stuck_rover run_on takes.
  void Strand();
  // Spends time at rest.
  void Rest(Activity activity, double duration_s);

  DriveParts parts_;
  DriveObserver observer_;
  DriveTracer tracer_;
  StepWatcher step_watcher_;

  std::unique_ptr<SeenLook> seen_;  // to be told at the next tick
  bool notices_stuck_ = false;      // at the last tick
  SlipAlarms slip_alarms_;
  bool rolling_ = false;  // in the last stretch
  // Since operators turned it: they let a rover drive before they turn it again.
  bool has_rolled_ = true;
  std::int64_t next_sighting_ = 0;  // of the tracked goal: number of its next measurement
  bool sees_goal_ = false;          // at the last one
  bool recognized_rock_ = false;    // ever
  Stall stall_;                     // of a rover that was found stuck
};

}  // namespace rockyard::trial
