// What a drive tells of its course, where somebody asks for a trace.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "trial/drive.h"

namespace rockyard::trial {
namespace {

std::string Name(Activity activity) {
  switch (activity) {
    case Activity::kDriving:
      return "drive";
    case Activity::kTurning:
      return "turn";
    case Activity::kSteering:
      return "steer";
    case Activity::kScanning:
      return "scan";
    case Activity::kStalled:
      return "stall";
    case Activity::kImaging:
      return "image";
    case Activity::kComputing:
      return "compute";
    case Activity::kOverhead:
      return "overhead";
  }
  return "";
}

// One character a stripe, left to right.
std::string Pattern(const messages::HazardReport& report) {
  std::string text;
  for (const bool hazard : report.stripe_hazard) text += hazard ? '#' : '.';
  return text;
}

std::string Describe(const messages::MotionCommand& motion) {
  const auto side = [](double left) { return left > 0.0 ? "left" : "right"; };
  if (motion.kind == messages::MotionKind::kTurnInPlace) {
    return fmt::format("turn {}", side(motion.direction));
  }
  const std::string way = motion.direction > 0 ? "forward" : "backward";
  if (motion.curvature_per_m == 0.0) return way + " straight";
  return fmt::format("{} {} {:.2f}/m", way, side(motion.curvature_per_m),
                     std::abs(motion.curvature_per_m));
}

std::string Describe(const messages::MotionVote& vote) {
  return fmt::format("{}: vote {:.0f}, hazard {:.0f}, waypoint {:.0f}", Describe(vote.motion),
                     vote.merged, vote.hazard, vote.waypoint);
}

}  // namespace

// Reports of hazards that are believed, and every look that shows points.
void Drive::RecordLook(messages::LookDirection direction) {
  if (trace_ == nullptr) return;
  if (percept_.report && percept_.report->any()) Record("hazard", Pattern(*percept_.report));
  if (!percept_.cloud) return;
  const bool ahead = direction == messages::LookDirection::kAhead;
  Record("look",
         fmt::format("{}, {} points", ahead ? "ahead" : "behind", percept_.cloud->points_R.size()));
}

// What was declared, and how far the rover truly is from there.
void Drive::RecordWaypoint(std::size_t index) {
  if (trace_ == nullptr) return;
  const std::vector<messages::Goal> goals = params_.course.Goals();
  const math::Pose2 rover = math::ToPose2(rover_->state().X_WR);
  Record("waypoint",
         fmt::format("{} of {}, {:.2f} m from it", index + 1, goals.size() - 1,
                     std::hypot(goals[index].x_m - rover.x_m, goals[index].y_m - rover.y_m)));
}

void Drive::ShowStep() {
  const messages::NavigationView* view = navigator_.view();
  if (!percept_.cloud || view == nullptr) return;
  if (step_watcher_) {
    step_watcher_({params_, field_.terrain, rover_->state().X_WR, key_, *view, *percept_.cloud});
  }
  if (trace_ == nullptr) return;
  for (const auto* row : {&view->forward, &view->backward, &view->point_turns}) {
    for (const messages::MotionVote& vote : *row) {
      if (vote.chosen) Record("chosen", Describe(vote));
    }
  }
}

void Drive::Record(std::string kind, std::string detail) {
  if (trace_ == nullptr) return;
  trace_->events.push_back(
      {ledger_.time_s(), math::ToPose2(rover_->state().X_WR), std::move(kind), std::move(detail)});
}

truth::TraceSample Drive::Now(std::string activity) const {
  const truth::RoverState& state = rover_->state();
  return {ledger_.time_s(),
          math::ToPose2(state.X_WR),
          math::Tilt(state.X_WR),
          pose(),
          std::move(activity),
          {state.X_WR, state.left_rocker_rad, state.right_rocker_rad, state.left_bogie_rad,
           state.right_bogie_rad, state.steer_rad, state.wheel_angle_rad}};
}

void Drive::Sample(Activity activity) {
  if (trace_ == nullptr) return;
  trace_->samples.push_back(Now(Name(activity)));
  RecordRocks();
}

void Drive::Rest(Activity activity, double duration_s) {
  ledger_.Spend(activity, duration_s);
  if (duration_s > 0.0) RecordRest(activity);
}

void Drive::RecordRest(std::optional<Activity> activity, bool set_back) {
  if (trace_ == nullptr) return;
  trace_->rests.push_back(
      {trace_->samples.size(), set_back, Now(activity ? Name(*activity) : std::string())});
  RecordRocks();
}

void Drive::RecordRocks() {
  if (params_.terrain.rocks.mobility == terrain::RockMobility::kFixed) return;
  const auto rocks = field_.terrain.rocks();
  const bool first = rock_centers_.empty();
  rock_centers_.resize(rocks.size());
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const math::Vector3& center_W = rocks[i].center_W;
    const bool moved = !first && center_W != rock_centers_[i];
    rock_centers_[i] = center_W;
    if (moved) trace_->rock_moves.push_back({ledger_.time_s(), static_cast<int>(i), center_W});
  }
}

}  // namespace rockyard::trial
