// A navigator for tests that shows what a test tells it to, decision by decision.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/archive.h"
#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "scenario/shipped.h"

namespace rockyard::navigation {

// What the navigator shows, and what is noted of it; for one test at a time.
struct ShowingParams {
  // What it shows after its decision of this number, counted from 0; nothing: null. May throw.
  std::function<std::optional<messages::Overlay>(int)> shows;
  int decisions = 8;      // after which it gives up
  double period_s = 2.0;  // between two of them

  struct Seen {
    int decisions = 0;
    int shows = 0;                                 // how often it was asked what it shows
    std::vector<messages::PoseEstimate> believed;  // at each decision
    std::vector<double> times_s;
  };
  std::shared_ptr<Seen> seen = std::make_shared<Seen>();

  void Visit(core::FieldVisitor&) {}
};

// Drives straight on.
class ShowingNavigator final : public Navigator {
 public:
  explicit ShowingNavigator(const ShowingParams& params) : params_(params) {}

  NavigatorDecision Decide(const NavigatorInput& input) override {
    ++params_.seen->decisions;
    params_.seen->believed.push_back(input.estimate);
    params_.seen->times_s.push_back(input.time_s);
    if (++decisions_ > params_.decisions) return Finish(NavigatorStatus::kGaveUp);
    return Move({.kind = messages::MotionKind::kArc}, {.period_s = params_.period_s});
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, GoalChange) override {}
  const messages::Overlay* overlay() const override {
    ++params_.seen->shows;
    shown_ = params_.shows(decisions_ - 1);
    return shown_ ? &*shown_ : nullptr;
  }

 private:
  ShowingParams params_;
  int decisions_ = 0;
  mutable std::optional<messages::Overlay> shown_;
};

// Returns the nominal scenario of the Pathfinder with this navigator.
inline scenario::Scenario WithShowing(const ShowingParams& params,
                                      std::vector<std::string> overrides = {}) {
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add<ShowingParams>(
      {.name = "showing",
       .doc = "shows what a test wants",
       .traits = [](const ShowingParams&) -> NavigatorTraits {
         return {LookReading::kNothing, CostOfLook{}, {"goal_tolerance_m", 0.1}};
       },
       .make = [](const ShowingParams& p, const NavigatorSetup&) -> std::unique_ptr<Navigator> {
         return std::make_unique<ShowingNavigator>(p);
       }},
      params);
  overrides.insert(overrides.end(),
                   {"navigation.navigator=showing", "rover.fidelity=quasi_static"});
  return scenario::Shipped("pathfinder/nominal", overrides, defaults);
}

// Returns an overlay of one line from (0, 0) to (x_m, 1).
inline messages::Overlay LineTo(double x_m) {
  return {.lines = {{"path", {{0.0, 0.0}, {x_m, 1.0}}}}, .grids = {}};
}

}  // namespace rockyard::navigation
