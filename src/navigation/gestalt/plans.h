// Plans that GESTALT makes on the move (Howard 2012, section 2). The cycle asks it when to look,
// and tells it what came of the looks; drive records hold its counts.
#pragma once

#include <cstdint>

#include "navigation/gestalt/gestalt_params.h"
#include "navigation/navigator.h"

namespace rockyard::navigation {

// When the rover looks on the move, and what becomes of the plans. Invariant: one look at most
// awaits its answer, and it was asked for during the motion under way; the counts are those of
// looks that were answered.
class PlansOnTheMove {
 public:
  explicit PlansOnTheMove(const GestaltContinuousParams& params) : params_(params) {}

  // Is told that a motion begins which the next plan is to replace. Returns the number of the
  // motion.
  std::int64_t Begin(double time_s);
  // Is told that a motion begins which is driven to its end.
  void Stop() { on_ = false; }
  bool on() const { return on_; }

  // Measures the speed; is called once at each tick of the motion.
  void Measure(double driven_m, double time_s);

  // Returns whether the rover looks at this tick of a motion of `leg_m`.
  bool Asks(double leg_m);
  bool awaits_look() const { return awaits_look_; }

  // Is told that the answer to the look is no longer wanted.
  void Drop() { awaits_look_ = false; }

  // Is told that the motion has ended and nothing has replaced it. Returns whether the rover waits
  // for a plan.
  bool WaitsAtEnd();

  // Are told what came of the look: it was answered; then the plan begins at `origin`, where the
  // rover believes to be at `now`, or there is no safe plan.
  void Answer();
  void Start(const messages::PoseEstimate& origin, const messages::PoseEstimate& now);
  void Refuse() { ++counts_.unsafe; }

  // Returns the way since the look until time_s, at the speed that was measured when the look was
  // asked for.
  double WaySince(const messages::LookMoment& look, double time_s) const {
    return look_speed_m_s_ * (time_s - look.time_s);
  }

  const PlanCounts& counts() const { return counts_; }

 private:
  GestaltContinuousParams params_;
  bool on_ = false;
  bool awaits_look_ = false;
  bool late_ = false;      // the motion ended before the look was answered
  double driven_m_ = 0.0;  // at the last tick
  double time_s_ = 0.0;
  double speed_m_s_ = 0.0;
  double look_speed_m_s_ = 0.0;
  std::int64_t moves_ = 0;
  PlanCounts counts_;
};

}  // namespace rockyard::navigation
