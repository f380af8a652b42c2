// The closed loop of one trial. See run_trial.h for the entry point.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/random.h"
#include "trial/clock/ledger.h"
#include "trial/drive/drive_observer.h"
#include "trial/drive/drive_tracer.h"
#include "trial/drive/onboard.h"
#include "trial/drive/operators.h"
#include "trial/drive/timeline.h"
#include "trial/drive/world.h"
#include "trial/drive_params.h"
#include "trial/referee/referee.h"
#include "trial/run_trial.h"
#include "trial/watchers.h"

namespace rockyard::trial {

// What is asked for in seconds happens in whole steps of the rover: a control tick of 1/25 s takes
// two steps of 1/60 s. duration_s is the time of these steps, and all that steers, measures or
// keeps books goes by it, never by the time asked for.
struct Stretch {
  std::int64_t steps = 1;
  double duration_s = 0.0;
};

// The nearest whole number of steps, one at least.
Stretch WholeSteps(double asked_s, double step_s);

// One drive from the start to its end. Every control tick what runs on board decides from what the
// world measures; the world holds its wheel commands for a few physics steps; observer and referee,
// who see both, say when the drive is over. What the drive itself hands from one to another are
// measurements, commands and verdicts: it knows neither where the rover is nor where it believes to
// be. Looks may be under way meanwhile (timeline.h).
class Drive {
 public:
  Drive(const DriveParams& drive, core::TrialKey key, truth::Trace* trace, const Watchers& watchers,
        const DriveStart* start = nullptr);

  // One decision, and what follows from it. The verdict, once the drive is over.
  std::optional<Verdict> Step();
  // Ends a drive by its verdict, once.
  DriveResult Finish(const Verdict& verdict);

  double time_s() const { return ledger_.time_s(); }
  double tick_s() const { return tick_.duration_s; }

 private:
  // Shows the navigator where the tracker sees the goal, or the rock at it.
  void TrackGoal();
  // The navigator has done with so many goals.
  void OnWaypoints(std::size_t passed);
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
  // The estimator takes one stretch of encoders and gyro.
  messages::MotionMeasurement Propagate(double duration_s, bool moving);
  // Aids measure, and what they measured before reaches the estimator.
  void UseAids();
  // A stretch in which the wheels stood; a gyro may drift in it.
  void PropagateAtRest(double duration_s);
  void ReflectAtMirrorLine(int direction);
  std::optional<Verdict> AskReferee(Activity activity, int direction, double duration_s);
  // What a stuck rover would still take, and with referee.stuck_rover run_on takes.
  void Strand();
  // Spends time at rest.
  void Rest(Activity activity, double duration_s);

  const DriveParams& params_;
  World world_;
  std::vector<messages::Goal> told_places_;  // waypoints, then the goal, as the rover is told
  Onboard onboard_;

  Stretch tick_;  // of control
  Stretch stop_;  // before a scan
  Ledger ledger_;
  Timeline timeline_;

  Operators operators_;
  Referee referee_;
  DriveObserver observer_;
  DriveTracer tracer_;
  StepWatcher step_watcher_;

  std::unique_ptr<SeenLook> seen_;  // to be told at the next tick
  bool rolling_ = false;            // in the last stretch
  bool sees_goal_ = false;          // at the tracker's last look; of a goal rock: ever
  Stall stall_;                     // of a rover that was found stuck
};

}  // namespace rockyard::trial
