#include "trial/referee/referee.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/functions.h"

namespace rockyard::trial {
namespace {

using truth::EndCause;

double Between(double x0_m, double y0_m, double x1_m, double y1_m) {
  return math::Hypot(x1_m - x0_m, y1_m - y0_m);
}

// Least lift share of a rock that bears the belly, within 45 deg of the vertical; a rock that the
// chassis runs into pushes back rather than up.
constexpr double kMinLiftShare = 0.7071;

bool RestsOnBelly(const truth::RoverState& state) {
  return std::any_of(state.contacts.begin(), state.contacts.end(), [](const auto& contact) {
    return contact.part == truth::BodyPart::kBelly && contact.rock >= 0 &&
           contact.normal_force_N > 0.0 && contact.lift_share > kMinLiftShare;
  });
}

// A rover whose wheels stand deeper than their axles on average rests on more than wheels.
bool IsEmbedded(const truth::RoverState& state, double wheel_radius_m) {
  const auto& depth_m = state.wheel_sinkage_m;
  const double mean_m =
      std::accumulate(depth_m.begin(), depth_m.end(), 0.0) / static_cast<double>(depth_m.size());
  return mean_m > wheel_radius_m;
}

// Returns whether a value is beyond a limit. A limit of 0 is none.
bool IsBeyond(double value, double limit) { return limit > 0.0 && value > limit; }

bool IsMotion(Activity activity) {
  return activity == Activity::kDriving || activity == Activity::kTurning;
}

}  // namespace

Referee::Referee(const RefereeParams& params, const CourseParams& course,
                 const messages::Goal& told_goal, std::optional<ArenaBounds> bounds,
                 double wheel_radius_m)
    : params_(params),
      course_(course),
      told_goal_(told_goal),
      bounds_(bounds),
      wheel_radius_m_(wheel_radius_m),
      tip_over_cosine_(math::Cos(params.tip_over_rad)),
      progress_{Between(course.start_x_m, course.start_y_m, told_goal.x_m, told_goal.y_m),
                course.start_x_m, course.start_y_m} {}

std::optional<Verdict> Referee::Observe(const Observation& observation, const Ledger& ledger) {
  // Records depend on this order: where several rules hold after one tick, the first is the cause.
  const truth::RoverState& state = observation.state;
  if (state.X_WR.linear()(2, 2) < tip_over_cosine_) {
    return Verdict{EndCause::kFellOver};
  }
  const double x = state.X_WR.translation().x();
  if (bounds_ && (x < bounds_->min_x_m || x > bounds_->max_x_m)) {
    return Verdict{EndCause::kLeftArena};
  }
  if (ledger.empty()) return Verdict{EndCause::kBatteriesEmpty};
  if (params_.time_limit_s > 0.0 && ledger.time_s() >= params_.time_limit_s) {
    return Verdict{EndCause::kTimeLimit};
  }
  if (IsEmbedded(state, wheel_radius_m_)) {
    return Verdict{EndCause::kSankIn};
  }
  if (auto stuck = CheckStuck(observation)) return stuck;
  return CheckNoPath(observation, ledger.time_s());
}

std::optional<Verdict> Referee::CheckStuck(const Observation& observation) {
  if (!IsMotion(observation.activity)) return std::nullopt;
  if (!window_) OpenWindow(observation);
  window_->duration_s += observation.duration_s;
  AddObeyed(observation, *window_);
  if (RestsOnBelly(observation.state)) window_->belly_s += observation.duration_s;
  if (window_->duration_s < params_.stall_window_s) return std::nullopt;
  // Windows follow one another without overlap: a rover is found stuck at the end of the first one
  // in which it did not move, up to two windows after it stopped.
  const Window window = *window_;
  OpenWindow(observation);
  if (MovedSince(window, observation)) return std::nullopt;
  if (window.belly_s >= params_.high_centre_time_share * window.duration_s) {
    return Verdict{EndCause::kBellyOnRock};
  }
  return Verdict{EndCause::kNoMotion};
}

void Referee::OpenWindow(const Observation& observation) {
  window_ = Window{.pose = math::ToPose2(observation.state.X_WR),
                   .estimate = observation.estimate,
                   .last_X_WR = observation.state.X_WR};
}

void Referee::OnReflection(const truth::RoverState& state, double line_m) {
  if (!window_) return;
  window_->estimate.y_m = 2.0 * line_m - window_->estimate.y_m;
  window_->pose.heading_rad = -window_->pose.heading_rad;
  window_->estimate.heading_rad = -window_->estimate.heading_rad;
  window_->last_X_WR = state.X_WR;
}

void Referee::AddObeyed(const Observation& observation, Window& window) {
  const math::Transform& X_WR = observation.state.X_WR;
  const math::Vector3 before_W = window.last_X_WR.linear().col(0);
  const math::Vector3 forward_W = X_WR.linear().col(0);
  if (observation.activity == Activity::kTurning) {
    const double turn_rad =
        math::Atan2(before_W.x() * forward_W.y() - before_W.y() * forward_W.x(),
                    before_W.x() * forward_W.x() + before_W.y() * forward_W.y());
    window.obeyed_rad += observation.direction * turn_rad;
  } else {
    window.obeyed_m +=
        observation.direction * forward_W.dot(X_WR.translation() - window.last_X_WR.translation());
  }
  window.last_X_WR = X_WR;
}

// A rover that rocks to and fro between two rocks does not move. A rover that is told to dither and
// does so is not stuck: it finds no path.
bool Referee::MovedSince(const Window& window, const Observation& observation) const {
  const auto moved = [&](double distance_m, double turn_rad) {
    return distance_m > params_.stall_distance_m ||
           std::abs(math::WrapAngle(turn_rad)) > params_.stall_turn_rad;
  };
  const math::Pose2 pose = math::ToPose2(observation.state.X_WR);
  const messages::PoseEstimate& estimate = observation.estimate;
  const bool truly = moved(Between(window.pose.x_m, window.pose.y_m, pose.x_m, pose.y_m),
                           pose.heading_rad - window.pose.heading_rad) ||
                     window.obeyed_m > params_.stall_distance_m ||
                     window.obeyed_rad > params_.stall_turn_rad;
  const bool believes =
      moved(Between(window.estimate.x_m, window.estimate.y_m, estimate.x_m, estimate.y_m),
            estimate.heading_rad - window.estimate.heading_rad);
  return truly || (believes && params_.spinning_wheels == SpinningWheels::kDriveOn);
}

std::optional<Verdict> Referee::CheckNoPath(const Observation& observation, double time_s) {
  if (MadeProgress(observation)) {
    progress_.time_s = time_s;
    progress_.distance_m = observation.true_distance_m;
    progress_.turned_rad = observation.turned_in_place_rad;
    return std::nullopt;
  }
  const double distance_m = observation.true_distance_m - progress_.distance_m;
  const double turn_rad = observation.turned_in_place_rad - progress_.turned_rad;
  no_progress_distance_m_ = std::max(no_progress_distance_m_, distance_m);
  no_progress_turn_rad_ = std::max(no_progress_turn_rad_, turn_rad);
  if (IsBeyond(distance_m, params_.no_path_distance_m)) {
    return Verdict{EndCause::kPatienceDistance};
  }
  if (IsBeyond(turn_rad, params_.no_path_turn_rad)) {
    return Verdict{EndCause::kPatienceTurning};
  }
  if (IsBeyond(time_s - progress_.time_s, params_.no_path_time_s)) {
    return Verdict{EndCause::kPatienceTime};
  }
  return std::nullopt;
}

// Progress: the rover believes to be nearer than ever and has truly moved, as spinning wheels are
// no progress.
bool Referee::MadeProgress(const Observation& observation) {
  const double goal_distance_m =
      Between(observation.estimate.x_m, observation.estimate.y_m, told_goal_.x_m, told_goal_.y_m);
  const auto p = observation.state.X_WR.translation();
  if (goal_distance_m > progress_.goal_distance_m - params_.no_path_progress_m ||
      Between(progress_.x_m, progress_.y_m, p.x(), p.y()) < params_.no_path_progress_m) {
    return false;
  }
  progress_.goal_distance_m = goal_distance_m;
  progress_.x_m = p.x();
  progress_.y_m = p.y();
  return true;
}

void Referee::OnNextGoal(const messages::Goal& told_goal, const Observation& observation,
                         double time_s) {
  told_goal_ = told_goal;
  const messages::PoseEstimate& estimate = observation.estimate;
  const auto p = observation.state.X_WR.translation();
  progress_ = {.goal_distance_m = Between(estimate.x_m, estimate.y_m, told_goal.x_m, told_goal.y_m),
               .x_m = p.x(),
               .y_m = p.y(),
               .time_s = time_s,
               .distance_m = observation.true_distance_m,
               .turned_rad = observation.turned_in_place_rad};
}

Verdict Referee::OnNavigatorStop(navigation::NavigatorStatus status, const truth::RoverState& state,
                                 double time_s) const {
  if (status == navigation::NavigatorStatus::kGaveUp) {
    return {EndCause::kGaveUp};
  }
  if (status == navigation::NavigatorStatus::kStuck) {
    return {EndCause::kNoticedStuck};
  }
  if (course_.goal_rock.enabled) return {EndCause::kRockNotFound};
  const auto p = state.X_WR.translation();
  const messages::Goal goal = course_.GoalAt(time_s);
  const double off_m = Between(p.x(), p.y(), goal.x_m, goal.y_m);
  return {off_m <= course_.goal_radius_m ? EndCause::kArrived : EndCause::kBelievedOnly};
}

}  // namespace rockyard::trial
