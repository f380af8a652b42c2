// The closed loop of one trial, which RunTrial (run_trial.h) steps until it ends.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <vector>

#include "core/random.h"
#include "navigation/navigator_fault.h"
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

// A time in whole steps of the rover. What is asked for in seconds happens in whole steps: a
// control tick of 1/25 s takes two steps of 1/60 s. Must stay: all that steers, measures or keeps
// books goes by duration_s, never by the time asked for.
struct Stretch {
  std::int64_t steps = 1;
  double duration_s = 0.0;  // of these steps
};

// Returns the stretch of the nearest whole number of steps, one at least.
Stretch WholeSteps(double asked_s, double step_s);

// One drive from the start to its end. Every control tick what runs on board decides from what the
// world measures; the world holds the wheel commands for a few physics steps; observer and referee,
// who see both sides, say when the drive is over. Looks may be under way meanwhile (timeline.h).
// Records depend on the order of the calls in Step and Move: aids measure, operators act and
// the referee judges after the estimator has taken the tick. world_ stands before what is made of
// it.
// Must stay: the drive hands measurements, commands and verdicts from one to another, and knows
// neither where the rover is nor where the rover believes to be.
class Drive {
 public:
  Drive(const DriveParams& drive, core::TrialKey key, truth::Trace* trace, const Watchers& watchers,
        const DriveStart* start = nullptr);

  // Makes one decision, and what follows from it. Returns the verdict once the drive is over.
  std::optional<Verdict> Step();
  // Ends the drive by its verdict, or because its navigator or estimator failed; one of them is
  // called once. What AtEnd returns is left to the caller.
  DriveResult Finish(const Verdict& verdict);
  DriveResult Finish(const navigation::NavigatorFault& fault);

  double time_s() const { return ledger_.time_s(); }
  double tick_s() const { return tick_.duration_s; }
  // Returns what the rover's own side leaves. May throw navigation::NavigatorFault, as Step.
  OnboardEnd AtEnd() const { return onboard_.AtEnd(); }

 private:
  // Shows the navigator where the tracker sees the goal, or the rock at it.
  void TrackGoal();
  // Takes note that the navigator has done with `passed` goals and drives to the next one.
  void OnWaypoints(std::size_t passed);
  // Returns whether the rover goes on while the look of this decision is taken and computed.
  bool LooksOnTheMove(const navigation::NavigatorDecision& decision) const;
  // Stops and looks.
  std::optional<Verdict> Look(messages::LookDirection direction);
  // Looks and goes on: a later tick delivers what was seen. Nothing happens where the cameras are
  // not free.
  std::optional<Verdict> LookOnTheMove(messages::LookDirection direction);
  std::unique_ptr<SeenLook> See(messages::LookDirection direction);
  // Takes images for visual odometry: the rover stops for them, and for the computer, where imaging
  // and computing may not overlap with the drive.
  std::optional<Verdict> SeeMotion();
  // Spends the time of imaging or computing, beside the drive where `beside`. Returns for how much
  // of it the rover rests.
  double SpendOnVision(Activity activity, double duration_s, bool beside);
  // Shows watcher and tracer what the navigator made of the last look.
  void ShowStep();
  // Spends what the navigator says that its decision took: at rest, or beside the drive where
  // computing overlaps.
  std::optional<Verdict> SpendOnDecision(double work_ops);
  // Spends what a move takes beyond the motion of wheels (clock.compute.move_overhead_s).
  void SpendOverhead();
  void RestBetweenMoves(double duration_s);
  // Makes one tick of the motion that was told. A rover that is told to stop, or whose plan is at
  // its end, waits at rest.
  std::optional<Verdict> Follow(const messages::MotionCommand& told);
  // Stops for what cannot go on while the rover drives.
  std::optional<Verdict> RestFor(const Timeline::Rest& rest);
  // Moves the rover for a stretch, and lets sensors, estimator, aids and operators act at its end.
  std::optional<Verdict> Move(const messages::MotionCommand& motion, const Stretch& stretch);

  // Holds the command for so many physics steps.
  void ApplyCommand(const messages::WheelCommand& command, std::int64_t steps);
  // Lets the estimator take one stretch of encoders and gyro.
  messages::MotionMeasurement Propagate(double duration_s, bool moving);
  // Lets aids measure, and hands the estimator what is ready of earlier measurements.
  void UseAids();
  // Lets the estimator take a stretch at rest, where the gyro drifts in it.
  void PropagateAtRest(double duration_s);
  void ReflectAtMirrorLine(int direction);
  std::optional<Verdict> AskReferee(Activity activity, int direction, double duration_s);
  // Notes what a stuck rover would still take; with referee.stuck_rover run_on spends it.
  void Strand();
  // Spends time at rest.
  void Rest(Activity activity, double duration_s);

  const DriveParams& params_;
  World world_;
  Stretch tick_;                             // one control tick
  Stretch stop_;                             // until the rover has come to rest
  std::vector<messages::Goal> told_places_;  // waypoints, then the goal, as the rover is told
  Onboard onboard_;

  Ledger ledger_;
  Timeline timeline_;

  Operators operators_;
  Referee referee_;
  DriveObserver observer_;
  DriveTracer tracer_;
  StepWatcher step_watcher_;

  std::unique_ptr<SeenLook> seen_;   // to be told at the next tick
  bool rolling_ = false;             // whether the wheels rolled in the last stretch
  bool sees_goal_ = false;           // at the tracker's last look; of a goal rock: at any look
  Stall stall_;                      // of a rover that was found stuck
  std::exception_ptr failed_start_;  // of the estimator; null: it began
};

}  // namespace rockyard::trial
