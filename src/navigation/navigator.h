/// @file
/// The interface of every path selection algorithm, rockyard's own, plugins and processes alike.
/// The on-board side of a drive asks a navigator at events (Event) and at ticks that the navigator
/// names (Until); the experiment on stereo takes the map of its first look. A navigator sees
/// measurements and estimates only.
///
/// Wrappers (the gate of events, waypoints, the reaction to being stuck) are navigators around
/// another one: each of them must pass on what is added to the interface.
///
/// Records depend on every decision, to the last bit of a motion, and on the tick at which it is
/// made.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "messages/calibration.h"
#include "messages/commands.h"
#include "messages/estimates.h"
#include "messages/look_images.h"
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

/// Why a navigator is asked; several can come together. Values are bits, which the interfaces of
/// plugins and processes pass on: append only.
enum class Event : std::uint32_t {
  kTick = 1u << 0,          ///< no other than that the navigator asked for this tick
  kStart = 1u << 1,         ///< the first question of a drive
  kLook = 1u << 2,          ///< the answer to a look is here
  kManoeuvre = 1u << 3,     ///< Until::distance_m or turn_rad is reached
  kPeriod = 1u << 4,        ///< Until::period_s is over
  kNearGoal = 1u << 5,      ///< the goal came within Until::near_goal_m
  kEndOfPlan = 1u << 6,     ///< the rover has come to rest at MotionCommand::end_m
  kPoseUpdate = 1u << 7,    ///< operators moved the rover since the last question
  kCorrection = 1u << 8,    ///< an outside measurement has corrected the estimate since
  kGoal = 1u << 9,          ///< the goal is another one since
  kHazard = 1u << 10,       ///< a felt hazard appeared, changed or went
  kTouchBehind = 1u << 11,  ///< what touches behind appeared or went
  kStuck = 1u << 12,        ///< the rover notices that it is stuck
};

/// A set of events.
class Events {
 public:
  constexpr Events() = default;
  /// Takes the bits of a set.
  constexpr explicit Events(std::uint32_t bits) : bits_(bits) {}

  constexpr void Add(Event event) { bits_ |= static_cast<std::uint32_t>(event); }
  constexpr bool Has(Event event) const { return (bits_ & static_cast<std::uint32_t>(event)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr std::uint32_t bits() const { return bits_; }

 private:
  std::uint32_t bits_ = 0;
};

/// When a navigator is asked again although nothing happens: by default at the next tick. All is
/// measured on board, since the decision.
struct Until {
  double period_s = 0.0;  ///< at the first tick at which so much time has passed; 0: the next one
  double distance_m = std::numeric_limits<double>::infinity();  ///< odometer, whatever direction
  double turn_rad = std::numeric_limits<double>::infinity();    ///< heading, either way
  /// Believed distance to the goal: at the first tick at which it is no larger.
  double near_goal_m = 0.0;
};

/// Returns the rule of a navigator that is asked at events alone. Distances, turns and periods are
/// added to it.
constexpr Until AtEvents() { return {.period_s = std::numeric_limits<double>::infinity()}; }

/// What the navigator knows when it decides.
struct NavigatorInput {
  double time_s = 0.0;                       ///< on-board clock since the start
  Events events = {};                        ///< why it is asked
  messages::PoseEstimate estimate = {};      ///< in the frame in which goals are told
  messages::AttitudeEstimate attitude = {};  ///< of the rover as it stands
  /// The pose in the frame of odometry, in which LookMoment::odometry of `look` is told too.
  messages::PoseEstimate odometry = {};
  /// `report`, `cloud`, `look` and `images` answer a request for a look, the oldest that has no
  /// answer yet, when its data are ready; they are null at every other tick. A behaviour controller
  /// reads the hazard report, a map-based navigator the points; all were taken at the moment of the
  /// look.
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
  /// Covariance of `estimate` and `attitude`; null where the rover keeps no account of its error.
  const messages::PoseCovariance* covariance = nullptr;
  /// What vehicle sensors measured over the last tick, joint angles among it; null before the
  /// first. Sensors that the rover lacks are empty.
  const messages::VehicleState* felt = nullptr;
  /// What the cameras took, where NavigatorTraits::images asks for it. Valid during the call.
  const messages::LookImages* images = nullptr;
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
  /// When it is asked again; the next tick unless it says otherwise.
  Until until = {};
  /// What the decision cost on the rover's computer beyond the traits' cost, in operations:
  /// clock.compute.operations_per_s makes seconds of them, which the rover spends at rest.
  double work_ops = 0.0;

  /// Returns whether the navigator asks for a look, and whether the rover stops for it.
  bool looks() const { return look.has_value(); }
  bool stops_to_look() const { return looks() && !looks_on_the_move; }
};

/// Returns the decision to drive `motion`, and to ask again at the next tick, or by `until`.
inline NavigatorDecision Move(const messages::MotionCommand& motion, const Until& until = {}) {
  return {.status = NavigatorStatus::kDriving, .motion = motion, .until = until};
}

/// Returns the decision to stop and look.
inline NavigatorDecision LookAt(messages::LookDirection direction) {
  return {.status = NavigatorStatus::kDriving, .look = direction};
}

/// Returns the decision to end the drive with `status`.
inline NavigatorDecision Finish(NavigatorStatus status) { return {.status = status}; }

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
/// its setup. What it throws ends the drive: navigator_fault of a plugin, else simulator_fault.
class Navigator {
 public:
  virtual ~Navigator() = default;

  /// Is called at every event and as the last decision says by `until`, in order of time; between
  /// two calls the motion of the last decision goes on. Must end every manoeuvre by what `input`
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

  /// Returns what the navigator shows on the map of a replay since its last decision; null or empty
  /// where it shows nothing, also of what it showed before. Is asked after a decision, for traces
  /// and pages alone: no decision may depend on the call. Where it throws, the drive goes on, the
  /// replay tells of it, and it is asked no more.
  virtual const messages::Overlay* overlay() const { return nullptr; }

  /// Returns its own values so far, as many and in the order as NavigatorDescription declares them.
  /// Valid until the next call of the navigator.
  virtual std::span<const double> own_values() const { return {}; }
};

}  // namespace rockyard::navigation
