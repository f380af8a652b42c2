#include "trial/drive/drive_tracer.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "math/functions.h"

namespace rockyard::trial {
namespace {

// Must stay: the texts of truth/trace.h.
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

// Returns one character for each stripe, left to right: # where it shows a hazard.
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

DriveTracer::DriveTracer(const World& world, const Onboard& onboard, const Ledger& ledger,
                         std::vector<messages::Goal> told, truth::Trace* trace)
    : world_(world),
      onboard_(onboard),
      ledger_(ledger),
      told_places_(std::move(told)),
      trace_(trace) {
  if (trace_ != nullptr) Rocks();
}

void DriveTracer::Event(std::string kind, std::string detail) {
  if (trace_ == nullptr) return;
  trace_->events.push_back(
      {ledger_.time_s(), math::ToPose2(world_.state().X_WR), std::move(kind), std::move(detail)});
}

void DriveTracer::Look(messages::LookDirection direction, const Percept& percept) {
  if (trace_ == nullptr) return;
  if (percept.report && percept.report->any()) Event("hazard", Pattern(*percept.report));
  if (!percept.cloud) return;
  const bool ahead = direction == messages::LookDirection::kAhead;
  Event("look",
        fmt::format("{}, {} points", ahead ? "ahead" : "behind", percept.cloud->points_R.size()));
}

void DriveTracer::Vision(const VisualStep& step) {
  if (trace_ == nullptr) return;
  const vision::MotionResult& seen = step.result;
  if (seen.motion) {
    const math::Transform& X_FS = seen.motion->X_FS;
    return Event("vision", fmt::format("{:.3f} m, {:.1f} deg", X_FS.translation().norm(),
                                       math::RadToDeg(math::TurnOf(X_FS.linear()).angle_rad)));
  }
  if (!seen.reason) return;
  Event("vision",
        fmt::format(
            "no motion: {}",
            core::EnumNames<vision::NoMotion>::kNames[static_cast<std::size_t>(*seen.reason)]));
}

void DriveTracer::Waypoint(std::size_t index) {
  if (trace_ == nullptr) return;
  // Waypoints that somebody named have true places; corners of a route are as they were told.
  const CourseParams& course = world_.params().course;
  const bool named = course.route_map.use != RouteUse::kWaypoints;
  const std::vector<messages::Goal> goals = named ? course.Goals() : told_places_;
  // Behind the waypoints come the told goal and the places of a local search.
  const std::size_t waypoints = goals.size() - 1;
  if (index >= waypoints) {
    return Event("waypoint", fmt::format("place {} of the search", index - waypoints + 1));
  }
  const math::Pose2 rover = math::ToPose2(world_.state().X_WR);
  Event("waypoint",
        fmt::format("{} of {}, {:.2f} m from it", index + 1, waypoints,
                    math::Hypot(goals[index].x_m - rover.x_m, goals[index].y_m - rover.y_m)));
}

void DriveTracer::Votes(const messages::NavigationView& view) {
  if (trace_ == nullptr) return;
  for (const auto* row : {&view.forward, &view.backward, &view.point_turns}) {
    for (const messages::MotionVote& vote : *row) {
      if (vote.chosen) Event("chosen", Describe(vote));
    }
  }
}

truth::TraceSample DriveTracer::Now(std::string activity) const {
  const truth::RoverState& state = world_.state();
  return {ledger_.time_s(),
          math::ToPose2(state.X_WR),
          math::Tilt(state.X_WR),
          onboard_.estimate().pose,
          std::move(activity),
          {state.X_WR, state.left_rocker_rad, state.right_rocker_rad, state.left_bogie_rad,
           state.right_bogie_rad, state.steer_rad, state.wheel_angle_rad}};
}

void DriveTracer::Sample(Activity activity) {
  if (trace_ == nullptr) return;
  trace_->samples.push_back(Now(Name(activity)));
  Rocks();
}

void DriveTracer::Rest(std::optional<Activity> activity, bool set_back) {
  if (trace_ == nullptr) return;
  trace_->rests.push_back(
      {trace_->samples.size(), set_back, Now(activity ? Name(*activity) : std::string())});
  Rocks();
}

void DriveTracer::Rocks() {
  if (world_.params().terrain.rocks.mobility == terrain::RockMobility::kFixed) return;
  const auto rocks = world_.field().terrain.rocks();
  const bool first = rock_centers_.empty();
  rock_centers_.resize(rocks.size());
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const math::Vector3& center_W = rocks[i].center_W;
    const bool moved = !first && center_W != rock_centers_[i];
    rock_centers_[i] = center_W;
    if (moved) {
      trace_->rock_moves.push_back({ledger_.time_s(), static_cast<int>(i), center_W});
    }
  }
}

}  // namespace rockyard::trial
