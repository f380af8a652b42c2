#include "trial/referee.h"

#include <algorithm>
#include <cmath>

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

double Between(double x0_m, double y0_m, double x1_m, double y1_m) {
  return std::hypot(x1_m - x0_m, y1_m - y0_m);
}

bool BellyTouches(const truth::RoverState& state) {
  return std::any_of(state.contacts.begin(), state.contacts.end(), [](const auto& contact) {
    return contact.part == truth::BodyPart::kBelly && contact.normal_force_N > 0.0;
  });
}

bool IsMotion(Activity activity) {
  return activity == Activity::kDriving || activity == Activity::kTurning;
}

}  // namespace

Referee::Referee(const RefereeParams& params, const CourseParams& course,
                 std::optional<ArenaBounds> bounds)
    : params_(params),
      course_(course),
      bounds_(bounds),
      best_goal_distance_m_(
          Between(course.start_x_m, course.start_y_m, course.goal_x_m, course.goal_y_m)) {}

std::optional<Verdict> Referee::Observe(const Observation& observation, const Ledger& ledger) {
  const truth::RoverState& state = observation.state;
  if (math::Tilt(state.X_WR) > params_.tip_over_rad) {
    return Verdict{TrialOutcome::kTipOver, "tilted beyond tip_over_deg"};
  }
  const double x = state.X_WR.translation().x();
  if (bounds_ && (x < bounds_->min_x_m || x > bounds_->max_x_m)) {
    return Verdict{TrialOutcome::kLeftArena, "drove past an end of the arena"};
  }
  if (ledger.empty()) return Verdict{TrialOutcome::kEnergyDepleted, "batteries empty"};
  if (ledger.time_s() >= params_.time_limit_s) {
    return Verdict{TrialOutcome::kTimeLimit, "simulated time reached time_limit_s"};
  }
  if (auto stuck = CheckStuck(observation)) return stuck;
  return CheckNoPath(observation);
}

std::optional<Verdict> Referee::CheckStuck(const Observation& observation) {
  if (!IsMotion(observation.activity)) return std::nullopt;
  const math::Pose2 pose = math::ToPose2(observation.state.X_WR);
  const messages::PoseEstimate& estimate = observation.estimate;
  const auto moved = [&](double distance_m, double turn_rad) {
    return distance_m > params_.stall_distance_m ||
           std::abs(math::WrapAngle(turn_rad)) > params_.stall_turn_rad;
  };
  const bool truly_moved = moved(Between(window_pose_.x_m, window_pose_.y_m, pose.x_m, pose.y_m),
                                 pose.heading_rad - window_pose_.heading_rad);
  const bool believes_moved =
      params_.spinning_wheels == SpinningWheels::kDriveOn &&
      moved(Between(window_estimate_.x_m, window_estimate_.y_m, estimate.x_m, estimate.y_m),
            estimate.heading_rad - window_estimate_.heading_rad);
  if (!window_open_ || truly_moved || believes_moved) {
    window_open_ = true;
    window_pose_ = pose;
    window_estimate_ = estimate;
    window_s_ = 0.0;
    belly_s_ = 0.0;
    return std::nullopt;
  }
  window_s_ += observation.duration_s;
  if (BellyTouches(observation.state)) belly_s_ += observation.duration_s;
  if (window_s_ < params_.stall_window_s) return std::nullopt;
  if (belly_s_ >= params_.high_centre_load * window_s_) {
    return Verdict{TrialOutcome::kHighCentred, "no motion with the belly on a rock"};
  }
  return Verdict{TrialOutcome::kJammed, "no motion although the wheels were told to turn"};
}

std::optional<Verdict> Referee::CheckNoPath(const Observation& observation) {
  const double goal_distance_m = Between(observation.estimate.x_m, observation.estimate.y_m,
                                         course_.goal_x_m, course_.goal_y_m);
  if (goal_distance_m <= best_goal_distance_m_ - params_.no_path_progress_m) {
    best_goal_distance_m_ = goal_distance_m;
    progress_distance_m_ = observation.true_distance_m;
    progress_turn_rad_ = observation.turned_in_place_rad;
    return std::nullopt;
  }
  if (observation.true_distance_m - progress_distance_m_ > params_.no_path_distance_m) {
    return Verdict{TrialOutcome::kNoPath, "drove no_path_distance_m without coming nearer"};
  }
  if (observation.turned_in_place_rad - progress_turn_rad_ > params_.no_path_turn_rad) {
    return Verdict{TrialOutcome::kNoPath, "turned no_path_turn_deg without coming nearer"};
  }
  return std::nullopt;
}

Verdict Referee::OnNavigatorStop(navigation::NavigatorStatus status,
                                 const truth::RoverState& state) const {
  if (status == navigation::NavigatorStatus::kGaveUp) {
    return {TrialOutcome::kNoPath, "the navigator gave up"};
  }
  const auto p = state.X_WR.translation();
  const double off_m = Between(p.x(), p.y(), course_.goal_x_m, course_.goal_y_m);
  if (off_m <= course_.goal_radius_m) {
    return {TrialOutcome::kGoalReached, "arrived within goal_radius_m"};
  }
  return {TrialOutcome::kFalseGoal, "believed to have arrived outside goal_radius_m"};
}

}  // namespace rockyard::trial
