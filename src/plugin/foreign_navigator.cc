#include "plugin/foreign_navigator.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace rockyard::plugin {

using navigation::FaultKind;
using navigation::NavigatorFault;

const Traits& NavigatorSource::TraitsOf(const Parameters& parameters) const {
  return AnswerTo(parameters, [&] { return ReadTraits(AskTraits(parameters), name()); });
}

void ForeignKind::Visit(core::FieldVisitor& v) {
  parameters_.Visit(v);
  traits_ = &source_->TraitsOf(parameters_);
  for (const core::Problem& problem : traits_->problems) {
    v.Require(problem.path, false, problem.reason, problem.suggestion);
  }
}

namespace {

void Require(bool holds, const char* what, double value) {
  if (!holds) throw NavigatorFault(FaultKind::kNonsense, fmt::format("{} is {}", what, value));
}

}  // namespace

void CheckDecision(const navigation::NavigatorDecision& decision) {
  using messages::MotionKind;
  constexpr double kSharpest_per_m = 1e3;
  const messages::MotionCommand& motion = decision.motion;
  const auto kind = static_cast<int>(motion.kind);
  const auto status = static_cast<int>(decision.status);
  Require(status >= 0 && status <= static_cast<int>(navigation::NavigatorStatus::kStuck),
          "its status", status);
  Require(kind >= 0 && kind <= static_cast<int>(MotionKind::kTurnInPlace), "its kind of motion",
          kind);
  Require(std::abs(motion.curvature_per_m) <= kSharpest_per_m, "curvature_per_m",
          motion.curvature_per_m);
  Require(std::isfinite(motion.curvature_rate_per_m2), "curvature_rate_per_m2",
          motion.curvature_rate_per_m2);
  Require(motion.direction == 1 || motion.direction == -1, "direction (+1 or -1)",
          motion.direction);
  Require(motion.speed_share > 0.0 && motion.speed_share <= 1.0, "speed_share (above 0, to 1)",
          motion.speed_share);
  Require(!std::isnan(motion.end_m), "end_m", motion.end_m);
  const navigation::Until& until = decision.until;
  Require(!std::isnan(until.period_s), "until.period_s", until.period_s);
  Require(until.distance_m >= 0.0, "until.distance_m", until.distance_m);
  Require(until.turn_rad >= 0.0, "until.turn_rad", until.turn_rad);
  Require(!std::isnan(until.near_goal_m), "until.near_goal_m", until.near_goal_m);
  Require(decision.work_ops >= 0.0 && std::isfinite(decision.work_ops), "work_ops",
          decision.work_ops);
}

void CheckOverlay(const messages::Overlay& overlay) {
  constexpr std::size_t kMostValues = 1'000'000;
  std::size_t values = 0;
  for (const messages::OverlayLine& line : overlay.lines) values += line.points.size();
  for (const messages::OverlayGrid& grid : overlay.grids) {
    values += grid.values.size();
    const bool shaped =
        grid.nx >= 0 && grid.ny >= 0 &&
        grid.values.size() == static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny);
    if (!shaped || !(grid.step_m > 0.0)) {
      throw NavigatorFault(
          FaultKind::kNonsense,
          fmt::format("the grid \"{}\" of its overlay has {} values for {} x {} "
                      "cells of {} m",
                      grid.name, grid.values.size(), grid.nx, grid.ny, grid.step_m));
    }
  }
  if (values > kMostValues) {
    throw NavigatorFault(
        FaultKind::kNonsense,
        fmt::format("its overlay has {} values, more than {}", values, kMostValues));
  }
}

}  // namespace rockyard::plugin
