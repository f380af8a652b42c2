#include "navigation/event_gate.h"

#include <cmath>
#include <utility>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::navigation {
namespace {

using messages::PoseEstimate;
using messages::VehicleHazard;

// Ticks of 1/20 s do not add up exactly.
constexpr double kRounding_s = 1e-9;

bool SameHazard(const VehicleHazard* now, const std::optional<VehicleHazard>& before) {
  if (now == nullptr || !before) return now == nullptr && !before;
  return now->kind == before->kind && now->side == before->side;
}

}  // namespace

EventGate::EventGate(std::unique_ptr<Navigator> navigator, const messages::Goal& goal,
                     AskedListener on_asked)
    : navigator_(std::move(navigator)), goal_(goal), on_asked_(std::move(on_asked)) {
  EXPECT(navigator_ != nullptr);
}

NavigatorDecision EventGate::Decide(const NavigatorInput& input) {
  Events events = Observe(input);
  // The answer to a look is never kept waiting, and a look that came to nothing is asked for again.
  const bool tick = !last_ || last_->until.period_s <= 0.0 || last_->stops_to_look();
  if (events.empty()) {
    if (!tick) return *last_;
    events.Add(Event::kTick);
  }
  NavigatorInput asked = input;
  asked.events = events;
  const NavigatorDecision decision = navigator_->Decide(asked);
  asked_s_ = input.time_s;
  asked_odometer_m_ = input.estimate.distance_m;
  turned_rad_ = 0.0;
  // What goes on until the next question: a look and operations belong to this tick alone.
  last_ = decision;
  if (!decision.stops_to_look()) last_->look.reset();
  last_->work_ops = 0.0;
  if (on_asked_) on_asked_(*navigator_, asked);
  return decision;
}

Events EventGate::Observe(const NavigatorInput& input) {
  Events events = input.events;
  const PoseEstimate& estimate = input.estimate;
  const double goal_m = GoalDistance_m(estimate);
  if (last_) {
    const Until& until = last_->until;
    turned_rad_ += math::WrapAngle(estimate.heading_rad - heading_rad_);
    if (std::abs(estimate.distance_m - asked_odometer_m_) >= until.distance_m ||
        std::abs(turned_rad_) >= until.turn_rad) {
      events.Add(Event::kManoeuvre);
    }
    if (until.period_s > 0.0 && input.time_s - asked_s_ >= until.period_s - kRounding_s) {
      events.Add(Event::kPeriod);
    }
    if (goal_m <= until.near_goal_m && goal_distance_m_ > until.near_goal_m) {
      events.Add(Event::kNearGoal);
    }
  } else {
    events.Add(Event::kStart);
  }
  if (input.look != nullptr) events.Add(Event::kLook);
  if (input.notices_stuck) events.Add(Event::kStuck);
  if (!SameHazard(input.vehicle_hazard, hazard_)) events.Add(Event::kHazard);
  if (input.touches_behind != touches_behind_) events.Add(Event::kTouchBehind);
  events = Events(events.bits() | pending_.bits());
  pending_ = {};
  heading_rad_ = estimate.heading_rad;
  goal_distance_m_ = goal_m;
  hazard_ = input.vehicle_hazard != nullptr ? std::optional(*input.vehicle_hazard) : std::nullopt;
  touches_behind_ = input.touches_behind;
  return events;
}

void EventGate::OnPoseUpdate(const PoseEstimate& before, const PoseEstimate& after) {
  JumpBy(before, after);
  pending_.Add(Event::kPoseUpdate);
  navigator_->OnPoseUpdate(before, after);
}

void EventGate::OnCorrection(const PoseEstimate& before, const PoseEstimate& after) {
  JumpBy(before, after);
  pending_.Add(Event::kCorrection);
  navigator_->OnCorrection(before, after);
}

// A jump of the estimate is no turn of the rover.
void EventGate::JumpBy(const PoseEstimate& before, const PoseEstimate& after) {
  heading_rad_ += after.heading_rad - before.heading_rad;
}

void EventGate::SetGoal(const messages::Goal& goal, GoalChange change) {
  goal_ = goal;
  pending_.Add(Event::kGoal);
  navigator_->SetGoal(goal, change);
}

double EventGate::GoalDistance_m(const PoseEstimate& estimate) const {
  return math::Hypot(goal_.x_m - estimate.x_m, goal_.y_m - estimate.y_m);
}

}  // namespace rockyard::navigation
