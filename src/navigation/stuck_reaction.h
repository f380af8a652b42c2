// A navigator around any other one, for what the rover does where it notices that it is stuck: it
// gives up, or drives back along its last arc once in a drive and gives up the next time. Drives
// put it around their navigator unless on_board_stuck.reaction is off. The navigator below is not
// asked while the rover backs off; afterwards it goes on with what was under way, from where the
// rover then believes to be. Draws no random numbers.
//
// Limits: backing off is blind, and by wheel odometry: wheels that spin back end it as well. A
// touch at the end that leads ends it, where the rover has contact switches (as Touches of
// gestalt/manoeuvre.h says).
//
// No record of a drive without the reaction depends on it, as such a drive does not make one.
#pragma once

#include <memory>
#include <span>

#include "navigation/navigator.h"
#include "navigation/reaction_params.h"

namespace rockyard::navigation {

class StuckReaction final : public Navigator {
 public:
  // `reaction` of `params` is not kOff, and `navigator` not null.
  StuckReaction(const StuckReactionParams& params, std::unique_ptr<Navigator> navigator);

  NavigatorDecision Decide(const NavigatorInput& input) override;
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  void SetGoal(const messages::Goal& goal, GoalChange change) override {
    navigator_->SetGoal(goal, change);
  }
  const messages::NavigationView* view() const override { return navigator_->view(); }
  PlanCounts plan_counts() const override { return navigator_->plan_counts(); }
  const messages::Overlay* overlay() const override { return navigator_->overlay(); }
  std::span<const double> own_values() const override { return navigator_->own_values(); }

 private:
  enum class Stage { kNavigating, kBackingOff, kBackedOff };

  NavigatorDecision Ask(const NavigatorInput& input);
  void BeginBackOff(const messages::PoseEstimate& estimate);
  // Returns whether the back-off is over after this tick.
  bool HasBackedOff(const NavigatorInput& input) const;

  StuckReactionParams params_;
  std::unique_ptr<Navigator> navigator_;
  Stage stage_ = Stage::kNavigating;
  messages::MotionCommand last_arc_{messages::MotionKind::kArc, 0.0, +1};  // of the navigator
  messages::MotionCommand back_off_;
  double odometer_at_back_off_m_ = 0.0;
};

}  // namespace rockyard::navigation
