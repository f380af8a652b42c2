// A navigator around another one, which it asks at events and as the last decision says (Until),
// and not at every tick. Drives put it around the navigator of the scenario, inside of all other
// wrappers. Between two questions the motion of the last decision goes on, without its look and its
// operations. Draws no random numbers. A navigator that asks for every tick, as GESTALT does,
// decides as without the gate, bit for bit.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "navigation/navigator.h"

namespace rockyard::navigation {

// Is called with a navigator right after it was asked, and with what it was asked.
using AskedListener = std::function<void(const Navigator& asked, const NavigatorInput& input)>;

class EventGate final : public Navigator {
 public:
  // `navigator` is not null; `goal` is its first one. `on_asked` may be empty; it is not called at
  // ticks at which the last decision goes on.
  EventGate(std::unique_ptr<Navigator> navigator, const messages::Goal& goal,
            AskedListener on_asked = {});

  // Events that `input` names already (of wrappers, of what follows the motion) are among those
  // that the navigator is asked for.
  NavigatorDecision Decide(const NavigatorInput& input) override;
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  void SetGoal(const messages::Goal& goal, GoalChange change) override;
  const messages::NavigationView* view() const override { return navigator_->view(); }
  PlanCounts plan_counts() const override { return navigator_->plan_counts(); }
  const messages::Overlay* overlay() const override { return navigator_->overlay(); }
  std::span<const double> own_values() const override { return navigator_->own_values(); }

 private:
  // Takes note of the way since the last tick, and returns what happened at this one.
  Events Observe(const NavigatorInput& input);
  void JumpBy(const messages::PoseEstimate& before, const messages::PoseEstimate& after);
  double GoalDistance_m(const messages::PoseEstimate& estimate) const;

  std::unique_ptr<Navigator> navigator_;
  messages::Goal goal_;
  AskedListener on_asked_;
  std::optional<NavigatorDecision> last_;  // nothing before the first question
  Events pending_;                         // since the last tick
  // At the last question.
  double asked_s_ = 0.0;
  double asked_odometer_m_ = 0.0;
  // At the last tick.
  double heading_rad_ = 0.0;
  double turned_rad_ = 0.0;  // since the last question, positive left
  double goal_distance_m_ = 0.0;
  std::optional<messages::VehicleHazard> hazard_;
  bool touches_behind_ = false;
};

}  // namespace rockyard::navigation
