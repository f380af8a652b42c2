/// @file
/// The interface of every path selection algorithm. The on-board side of a drive asks a navigator
/// at each control tick, and the experiment on stereo takes the map of its first look. A navigator
/// sees measurements and estimates only.
///
/// Wrappers (waypoints, the reaction to being stuck) are navigators around another one: each of
/// them must pass on what is added to the interface.
///
/// Records depend on every decision, to the last bit of a motion, and on the tick at which it is
/// made.
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
  messages::AttitudeEstimate attitude = {};  ///< of the rover as it stands
  /// The pose in the frame of odometry, in which LookMoment::odometry of `look` is told too.
  messages::PoseEstimate odometry = {};
  /// `report`, `cloud` and `look` answer a request for a look, the oldest that has no answer yet,
  /// when its data are ready; they are null at every other tick. A behaviour controller reads the
  /// hazard report, a map-based navigator the points; both were taken at the moment of the look.
  const messages::HazardReport* report = nullptr;
  const messages::PointCloud* cloud = nullptr;
  const messages::LookMoment* look = nullptr;
  /// The hazard that the rover feels at this tick and has to get away from, or an alarm of the slip
  /// check that counts as one (navigation.on_slip). It is never a touch behind; null where there is
  /// no such hazard.
  const messages::VehicleHazard* vehicle_hazard = nullptr;
  bool touches_behind = false;  ///< at this tick, whatever else the rover feels
  /// At this tick, by the stuck detector, or by an alarm of the slip check that counts as stuck.
  bool notices_stuck = false;
};

/// What the navigator asks for until its next decision.
struct NavigatorDecision {
  NavigatorStatus status = NavigatorStatus::kDriving;
  /// Where set, the rover stops and looks, and the motion is ignored: the next input carries what
  /// was seen.
  std::optional<messages::LookDirection> look = {};
  messages::MotionCommand motion = {};  ///< until the next decision
  /// Has a meaning with a look only: the rover looks and follows the motion meanwhile, as far as it
  /// can do both (clock.overlap). A later input carries what was seen, unless something came
  /// between (operators, a reaction to being stuck). No look is taken while the cameras are at work
  /// on one: a navigator goes on asking.
  bool looks_on_the_move = false;

  /// Returns whether the navigator asks for a look, and whether the rover stops for it.
  bool looks() const { return look.has_value(); }
  bool stops_to_look() const { return looks() && !looks_on_the_move; }
};

/// Returns the decision to drive `motion`.
inline NavigatorDecision Move(const messages::MotionCommand& motion) {
  return {NavigatorStatus::kDriving, {}, motion};
}

/// Returns the decision to end the drive with `status`.
inline NavigatorDecision Finish(NavigatorStatus status) { return {status, {}, {}}; }

/// What became of plans that were made on the move; the drive's record holds them.
struct PlanCounts {
  std::int64_t plans = 0;    ///< looks on the move that were answered
  std::int64_t unsafe = 0;   ///< of `plans`, without a safe plan
  std::int64_t late = 0;     ///< motions that ended before the next plan was ready
  std::int64_t started = 0;  ///< plans that replaced the motion under way
  /// Sum, over the plans that started, of the squared distance from where a plan was to begin to
  /// where the rover believed to be when it started.
  double start_error_squared_m2 = 0.0;
};

/// A path selection algorithm. One object drives one trial, from one thread. A trial must repeat
/// bit for bit: a navigator reads no clock, and draws no random numbers but such as are seeded by
/// its parameters. What it throws makes the trial a simulator fault.
class Navigator {
 public:
  virtual ~Navigator() = default;

  /// Is called at every control tick, in order of time. Must end every manoeuvre by what `input`
  /// says was measured on board.
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

  /// Is called between two decisions. Must leave the manoeuvre under way to end as it would have,
  /// and keep what is known of hazards; the next manoeuvre is chosen for `goal`.
  virtual void SetGoal(const messages::Goal& goal, GoalChange change) = 0;

  /// Returns what the last answered look led to, for traces and pages; null where a navigator keeps
  /// no map, and before the first look. Drives record height_error_m only where it is not null.
  virtual const messages::NavigationView* view() const { return nullptr; }

  /// Returns what became of plans on the move so far.
  virtual PlanCounts plan_counts() const { return {}; }
};

}  // namespace rockyard::navigation
