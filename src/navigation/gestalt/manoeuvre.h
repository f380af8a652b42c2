// The motion that GESTALT drives or turns: an arc, a spline or a turn in place. The cycle begins,
// follows and ends it. Records depend on the tick at which a motion ends: the first at which it has
// gone as far as it was told, or longer than it may.
#pragma once

#include <optional>

#include "messages/navigation_view.h"
#include "navigation/gestalt/curvature_law.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/navigator.h"

namespace rockyard::navigation {

// Where a plan begins: a pose in O, and the curvature that the rover steers there.
struct PlanOrigin {
  messages::PoseEstimate pose;
  double curvature_per_m = 0.0;
};

// Returns whether something presses on the end of the vehicle that leads in the direction (+1
// forward, -1 backward). StuckReaction ends its back-off by the same rule.
bool Touches(const NavigatorInput& input, int direction);

// One motion and what was measured of it. Invariant: measured() is what the odometer (drives) or
// the gyro (turns) has counted since Begin, so that a jump of the estimate neither ends nor
// prolongs a motion.
class Manoeuvre {
 public:
  explicit Manoeuvre(const GestaltParams& params);

  // Begins a motion of the length `leg`, m, or the angle `leg`, rad. It ends after step_time_out_s
  // at the latest.
  void Begin(const messages::MotionCommand& motion, double leg, const NavigatorInput& input);
  // Begins a motion along a spline, whose number is `move`.
  void Begin(const messages::Spline& spline, std::int64_t move, double leg_m,
             const NavigatorInput& input);

  // Is called once at each tick of the motion.
  void Follow(const NavigatorInput& input);

  // Is told that operators have moved the rover: its heading has jumped, and the rover has not
  // turned.
  void OnPoseUpdate(const messages::PoseEstimate& before, const messages::PoseEstimate& after);

  double measured() const { return measured_; }  // m, or rad the way that it was told
  double leg() const { return leg_; }
  bool Completed() const { return measured_ >= leg_; }
  bool TimedOut(const NavigatorInput& input) const;
  bool Ends(const NavigatorInput& input) const { return Completed() || TimedOut(input); }

  // Returns whether the rover feels a hazard that counts. A hazard that it felt already when the
  // motion began is old until it has gone once; in drives it also counts after felt_again_m.
  bool FeelsAnew(const NavigatorInput& input) const;

  // Returns the command at this tick.
  messages::MotionCommand Command() const { return CommandAt(measured_); }

  // The curvature for which the wheels stand: that of Begin, then that of the last Steer. Turns in
  // place set it to 0.
  void Steer() { steered_per_m_ = Command().curvature_per_m; }
  double steered_per_m() const { return steered_per_m_; }

  // Returns where the motion leads from `from`, which lies on it, in another `way_m`, but no
  // farther than to its end.
  PlanOrigin Ahead(const messages::PoseEstimate& from, double way_m) const;

 private:
  bool turns() const { return motion_.kind == messages::MotionKind::kTurnInPlace; }
  bool Feels(const NavigatorInput& input) const;
  messages::MotionCommand CommandAt(double driven_m) const;

  SpeedLawParams speed_;
  CurvatureLaw law_;
  double time_out_s_;
  double felt_again_m_;

  messages::MotionCommand motion_;
  std::optional<messages::Spline> spline_;  // followed instead of motion_'s arc
  double leg_ = 0.0;
  double measured_ = 0.0;
  double began_m_ = 0.0;      // the odometer at Begin
  double began_s_ = 0.0;      // the on-board clock at Begin
  double heading_rad_ = 0.0;  // at the last tick
  double steered_per_m_ = 0.0;
  bool feels_old_ = false;  // has felt a hazard without a break since Begin
};

}  // namespace rockyard::navigation
