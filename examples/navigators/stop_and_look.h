/// @file
/// The cycle that the example navigators share: look, plan, move, until the goal is near. An
/// algorithm derives from StopAndLook and says what follows a look (Plan).
///
/// All of it happens in the odometry frame O, in which the rover's path is smooth. Where an outside
/// measurement corrects the estimate, the map keeps its place around the rover and the goal moves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ground_map.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"

namespace examples {

namespace core = rockyard::core;
namespace navigation = rockyard::navigation;

/// A place in the plane of O, and where something there faces.
struct Pose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

/// Returns the angle in [-pi, pi].
inline double Wrapped(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}
/// Returns the length of a way. Not std::hypot: Python's differs from it in last digits.
inline double Length(double dx_m, double dy_m) { return std::sqrt(dx_m * dx_m + dy_m * dy_m); }
/// Returns the pose that lies `x_m` ahead and `y_m` to the left of another one.
inline Pose Beside(const Pose& at, double x_m, double y_m) {
  const double c = std::cos(at.heading_rad), s = std::sin(at.heading_rad);
  return {at.x_m + (c * x_m - s * y_m), at.y_m + (s * x_m + c * y_m), at.heading_rad};
}

/// Parameters of the cycle. Those of an algorithm hold one and visit it first.
struct CycleParams {
  double goal_tolerance_m = 0.3;
  double cell_m = 0.1;
  double back_off_m = 0.3;
  std::int64_t max_fruitless_looks = 60;

  void Visit(core::FieldVisitor& v) {
    v.Real("goal_tolerance_m", goal_tolerance_m,
           core::Setting("believed distance from the goal at which it has arrived", {0.01, 5.0}));
    v.Real("cell_m", cell_m,
           core::Assumed("side of a cell of the map",
                         "the test set-up of ACE has 0.1 m (Otsu 2020)", {0.02, 1.0}, {0.05, 0.2}));
    v.Real("back_off_m", back_off_m,
           core::Assumed("how far it drives back from a hazard that it feels",
                         "half of a small rover's length", {0.01, 2.0}, {0.1, 0.5}));
    v.Integer(
        "max_fruitless_looks", max_fruitless_looks,
        core::Setting("looks without a gain on the goal after which it gives up", {1.0, 100000.0}));
  }

  /// Returns the traits of a navigator that plans on range points. Each decision tells its work, so
  /// that a look costs nothing more.
  navigation::NavigatorTraits Traits() const {
    return {navigation::LookReading::kPoints,
            navigation::CostOfLook{},
            {"goal_tolerance_m", goal_tolerance_m}};
  }
};

/// What an algorithm wants after a look: to turn in place, else to drive an arc, else to give up.
struct Move {
  double turn_rad = 0.0;  ///< positive to the left; not 0: turn, and look again
  double curvature_per_m = 0.0;
  double way_m = 0.0;  ///< of the arc; 0 and no turn: there is no way
  double work_ops = 0.0;
};

/// A navigator that stands, looks and plans, and moves by what it planned alone. A felt hazard is
/// marked in the map and backed away from.
class StopAndLook : public navigation::Navigator {
 public:
  StopAndLook(const CycleParams& params, const navigation::NavigatorSetup& setup)
      : rover_(setup.rover), map_(params.cell_m), cycle_(params), goal_(setup.goal) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& in) final {
    const messages::PoseEstimate& at = in.odometry;
    if (!IsPlaced(in.estimate) || !IsPlaced(at)) {  // nothing to plan by: stand for a second
      return navigation::Move({}, {.period_s = 1.0});
    }
    estimate_ = in.estimate;
    here_ = {at.x_m, at.y_m, at.heading_rad};
    const double goal_m = Length(goal_.x_m - in.estimate.x_m, goal_.y_m - in.estimate.y_m);
    if (goal_m <= cycle_.goal_tolerance_m) {
      return navigation::Finish(navigation::NavigatorStatus::kArrived);
    }
    if (in.cloud != nullptr && in.look != nullptr) {
      map_.Add(*in.cloud, *in.look);
      return Begin(goal_m);
    }
    if (motion_ && FeelsAnew(in)) {
      MarkAhead(in.vehicle_hazard);
      return Drive({.kind = messages::MotionKind::kArc, .direction = -1}, cycle_.back_off_m);
    }
    if (in.events.Has(navigation::Event::kStuck)) {  // the reaction to it has backed off already
      MarkAhead(nullptr);
      motion_.reset();
    }
    const bool backs_into = motion_ && BacksOff() && in.touches_behind;
    // Asked for another reason than the end of the motion: it goes on.
    if (motion_ && !backs_into && Left() > 1e-6) return GoOn();
    motion_.reset();
    return navigation::LookAt(messages::LookDirection::kAhead);
  }

  /// Operators have moved the rover: it stands on other ground, and looks anew.
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) final {
    map_.Clear();
    motion_.reset();
    OnOtherWay();
  }
  /// O has not changed, and the goal is placed in it at each plan.
  void OnCorrection(const messages::PoseEstimate&, const messages::PoseEstimate&) final {}
  void SetGoal(const messages::Goal& goal, navigation::GoalChange change) final {
    goal_ = goal;
    if (change == navigation::GoalChange::kMoved) return;
    best_m_ = std::numeric_limits<double>::infinity();
    OnOtherWay();
  }
  const messages::Overlay* overlay() const final {
    overlay_ = {};
    Show(overlay_);
    return &overlay_;
  }
  std::span<const double> own_values() const final { return own_; }

 protected:
  /// Returns what follows a look, from the map, where the rover is and where the goal is, in O.
  virtual Move Plan(const Pose& here, const Pose& goal) = 0;
  /// Is called where the goal or the ground is another one: what was begun ends.
  virtual void OnOtherWay() {}
  /// Adds what a replay shows.
  virtual void Show(messages::Overlay& overlay) const = 0;

  /// Returns a way straight ahead on a heading: a turn, and a look, before it where that is another
  /// one than the rover's.
  static Move Towards(const Pose& here, double heading_rad, double way_m) {
    constexpr double kAligned_rad = 0.1;  // what is left of a turn; the drive takes it
    const double bearing_rad = Wrapped(heading_rad - here.heading_rad);
    if (std::abs(bearing_rad) > kAligned_rad) return {.turn_rad = bearing_rad};
    return {.curvature_per_m = bearing_rad / way_m, .way_m = way_m};
  }
  /// Returns a place of O in the frame in which goals are told, for overlays.
  messages::Goal Told(const Pose& place) const {
    const double dx_m = place.x_m - here_.x_m, dy_m = place.y_m - here_.y_m;
    const Pose told = Beside({estimate_.x_m, estimate_.y_m, Turned_rad()}, dx_m, dy_m);
    return {told.x_m, told.y_m};
  }
  /// Shows the steps of the map within 4 m of the rover, as shares of `limit_m`.
  void ShowSteps(double limit_m, messages::Overlay& overlay) const {
    const double cell_m = map_.cell_m();
    const int side = std::min(80, static_cast<int>(GroundMap::kSide));
    messages::OverlayGrid grid;
    grid.name = "steps";
    grid.x0_m = estimate_.x_m - 0.5 * side * cell_m;
    grid.y0_m = estimate_.y_m - 0.5 * side * cell_m;
    grid.step_m = cell_m;
    grid.nx = grid.ny = side;
    // This grid lies along the axes of goals, the map along those of O.
    const Pose middle{here_.x_m, here_.y_m, -Turned_rad()};
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const Pose at =
            Beside(middle, (i + 0.5 - 0.5 * side) * cell_m, (j + 0.5 - 0.5 * side) * cell_m);
        const std::int64_t ix = map_.Index(at.x_m), iy = map_.Index(at.y_m);
        const bool known = map_.Find(ix, iy) != nullptr;
        grid.values.push_back(known ? std::min(1.0, map_.Step_m(ix, iy) / limit_m)
                                    : std::numeric_limits<double>::quiet_NaN());
      }
    }
    overlay.grids.push_back(std::move(grid));
  }

  const messages::RoverBelief rover_;
  GroundMap map_;
  std::vector<double> own_;  ///< own values, as the description declares them

 private:
  /// A motion that was begun, and what ends it.
  struct Motion {
    messages::MotionCommand command;
    double begun = 0.0;   // odometer, m, or heading, rad
    double amount = 0.0;  // m or rad
  };

  static bool IsPlaced(const messages::PoseEstimate& pose) {
    return AreSane(pose.x_m, pose.y_m, pose.heading_rad) && AreSane(pose.distance_m, 0.0, 0.0);
  }
  bool BacksOff() const { return motion_->command.direction < 0 && DrivesArc(); }
  bool DrivesArc() const { return motion_->command.kind == messages::MotionKind::kArc; }
  bool FeelsAnew(const navigation::NavigatorInput& in) const {
    return !BacksOff() && in.vehicle_hazard != nullptr && in.events.Has(navigation::Event::kHazard);
  }
  // By how much the frame of goals is turned against O.
  double Turned_rad() const { return estimate_.heading_rad - here_.heading_rad; }
  double Left() const {
    if (DrivesArc()) return motion_->amount - (estimate_.distance_m - motion_->begun);
    return motion_->amount -
           motion_->command.direction * Wrapped(here_.heading_rad - motion_->begun);
  }

  navigation::NavigatorDecision Begin(double goal_m) {
    constexpr double kGain_m = 0.2;
    if (goal_m < best_m_ - kGain_m) {
      best_m_ = goal_m;
      fruitless_ = 0;
    } else if (++fruitless_ > cycle_.max_fruitless_looks) {
      return navigation::Finish(navigation::NavigatorStatus::kGaveUp);
    }
    const Pose goal = Beside({here_.x_m, here_.y_m, -Turned_rad()}, goal_.x_m - estimate_.x_m,
                             goal_.y_m - estimate_.y_m);
    const Move move = Plan(here_, goal);
    navigation::NavigatorDecision decision;
    if (move.turn_rad != 0.0) {
      decision = Turn(move.turn_rad);
    } else if (move.way_m > 0.0) {
      decision =
          Drive({.kind = messages::MotionKind::kArc, .curvature_per_m = move.curvature_per_m},
                move.way_m);
    } else {
      decision = navigation::Finish(navigation::NavigatorStatus::kGaveUp);
    }
    decision.work_ops = move.work_ops;
    return decision;
  }
  navigation::NavigatorDecision Drive(const messages::MotionCommand& command, double way_m) {
    motion_ = Motion{command, estimate_.distance_m, way_m};
    return GoOn();
  }
  // At most 150 degrees, so that left and right stay apart; the next plan asks for the rest.
  navigation::NavigatorDecision Turn(double turn_rad) {
    const double most_rad = 5.0 * std::numbers::pi / 6.0;
    motion_ =
        Motion{{.kind = messages::MotionKind::kTurnInPlace, .direction = turn_rad > 0.0 ? 1 : -1},
               here_.heading_rad,
               std::min(std::abs(turn_rad), most_rad)};
    return GoOn();
  }
  navigation::NavigatorDecision GoOn() const {
    navigation::Until until = navigation::AtEvents();
    (DrivesArc() ? until.distance_m : until.turn_rad) = Left();
    until.near_goal_m = cycle_.goal_tolerance_m;
    return navigation::Move(motion_->command, until);
  }
  // Nobody knows where a felt hazard is. It is taken to be before the front, on the side that the
  // sensor names.
  void MarkAhead(const messages::VehicleHazard* hazard) {
    double y_m = 0.0;
    if (hazard != nullptr && hazard->side == messages::HazardSide::kLeft) y_m = rover_.width_m;
    if (hazard != nullptr && hazard->side == messages::HazardSide::kRight) y_m = -rover_.width_m;
    const Pose at = Beside(here_, 0.5 * rover_.length_m, 0.5 * y_m);
    map_.MarkFelt(at.x_m, at.y_m);
  }

  const CycleParams cycle_;
  messages::Goal goal_;              // in the frame in which goals are told
  messages::PoseEstimate estimate_;  // at the last decision, in the same frame
  Pose here_;                        // the same in O
  std::optional<Motion> motion_;
  double best_m_ = std::numeric_limits<double>::infinity();  // nearest to the goal so far
  std::int64_t fruitless_ = 0;
  mutable messages::Overlay overlay_;
};

}  // namespace examples
