/// @file
/// The interface of every path selection algorithm. A navigator sees measurements and estimates
/// only. Wrappers (waypoints, the reaction to being stuck) are navigators around another one: what
/// is added to the interface has to be passed on by each of them.
#pragma once

#include <cstdint>
#include <optional>

#include "messages/commands.h"
#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "messages/vehicle_state.h"

namespace rockyard::navigation {

/// What a navigator says of the drive.
enum class NavigatorStatus {
  kDriving,  ///< goes on
  kArrived,  ///< believes to be at the goal
  kGaveUp,   ///< found no way
  kStuck,    ///< noticed that the rover does not get on
};

/// Why the goal of a navigator is another one than before.
enum class GoalChange {
  kNext,   ///< the rover was at the goal: another one follows, and progress is counted anew
  kMoved,  ///< the same goal, seen elsewhere than it was believed to be: progress counts on
};

/// What the navigator knows when it decides.
struct NavigatorInput {
  double time_s = 0.0;                       ///< on-board clock since the start
  messages::PoseEstimate estimate = {};      ///< in the frame in which goals are told
  messages::AttitudeEstimate attitude = {};  ///< of its stance
  /// The pose in the frame of odometry, as those of `look`.
  messages::PoseEstimate odometry = {};
  /// These answer a request for a look, the oldest that has no answer yet, when its data are ready;
  /// null at every other tick. A behaviour controller reads the hazard report, a map-based
  /// navigator the points; both were taken at the moment of the look.
  const messages::HazardReport* report = nullptr;
  const messages::PointCloud* cloud = nullptr;
  const messages::LookMoment* look = nullptr;
  /// What the rover feels at this tick and has to get away from, never a touch behind; null where
  /// it feels no such hazard.
  const messages::VehicleHazard* vehicle_hazard = nullptr;
  bool touches_behind = false;  ///< at this tick, whatever else it feels
  bool notices_stuck = false;   ///< at this tick, by what it measures; never where it looks
};

/// What the navigator asks for until its next decision.
struct NavigatorDecision {
  NavigatorStatus status = NavigatorStatus::kDriving;
  /// Where set, the rover stops and looks: the next input carries what was seen. The motion is
  /// ignored.
  std::optional<messages::LookDirection> look = {};
  messages::MotionCommand motion = {};  ///< until the next decision
  /// With a look: the rover looks and follows the motion meanwhile, as far as it can do both
  /// (clock.overlap); a later input carries what was seen, unless something came between
  /// (operators, a reaction to being stuck). No look is taken while the cameras are at work on one:
  /// a navigator goes on asking.
  bool looks_on_the_move = false;

  /// Returns whether it asks for a look; whether it stops for it.
  bool looks() const { return look.has_value(); }
  bool stops_to_look() const { return looks() && !looks_on_the_move; }
};

/// Returns the decision to drive that motion.
inline NavigatorDecision Move(const messages::MotionCommand& motion) {
  return {NavigatorStatus::kDriving, {}, motion};
}

/// Returns the decision to end the drive with that status.
inline NavigatorDecision Finish(NavigatorStatus status) { return {status, {}, {}}; }

/// What became of plans that were made on the move.
struct PlanCounts {
  std::int64_t plans = 0;    ///< looks on the move that were answered
  std::int64_t unsafe = 0;   ///< of these, without a safe plan
  std::int64_t late = 0;     ///< motions that ended before the next plan was ready
  std::int64_t started = 0;  ///< plans that replaced the motion under way
  /// Of these: where the plan was to begin less where the rover believed to be when it did.
  double start_error_squared_m2 = 0.0;  ///< sum
};

/// A path selection algorithm. One object drives one trial, from one thread. It reads no clock and
/// draws no random numbers but such as are seeded by its parameters: a trial must repeat bit for
/// bit. What it throws makes the trial a simulator fault.
class Navigator {
 public:
  virtual ~Navigator() = default;

  /// Is called at every control tick, in order of time. Every manoeuvre ends by what `input` says
  /// was measured on board.
  virtual NavigatorDecision Decide(const NavigatorInput& input) = 0;

  /// Is called when operators have moved the rover and its estimate by hand (arena reflection):
  /// anchors of running manoeuvres have to follow.
  virtual void OnPoseUpdate(const messages::PoseEstimate& before,
                            const messages::PoseEstimate& after) = 0;

  /// Is called when an outside measurement has corrected the estimate of a rover that nobody moved
  /// (lander update): what it has seen of the ground keeps its place around it, and the goal moves.
  /// A navigator without a map takes it as it takes any other jump of the estimate.
  virtual void OnCorrection(const messages::PoseEstimate& before,
                            const messages::PoseEstimate& after) {
    OnPoseUpdate(before, after);
  }

  /// Is called between two decisions. The manoeuvre under way ends as it would have, and what is
  /// known of hazards stays; the next manoeuvre is chosen for `goal`.
  virtual void SetGoal(const messages::Goal& goal, GoalChange change) = 0;

  /// Returns what the last answered look led to; null where a navigator keeps no map, and before
  /// the first.
  virtual const messages::NavigationView* view() const { return nullptr; }

  /// Returns what became of plans on the move so far.
  virtual PlanCounts plan_counts() const { return {}; }
};

}  // namespace rockyard::navigation
