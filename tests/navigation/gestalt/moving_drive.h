// GESTALT on the move in closed loop with a fake rover whose looks take time.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <optional>

#include "drive.h"
#include "navigation/motion_follower.h"

namespace rockyard::navigation {

using messages::LookDirection;
using messages::MotionKind;

struct MovingSetup {
  GestaltParams params;
  messages::Goal goal{8.0, 0.0};
  FakeRoverConfig rover = TrueRover();
  HeightAt height = Flat();
  FakeRange range;
  int latency_ticks = 0;  // from a look on the move to its answer
  bool loses_answers = false;
  std::function<bool(int tick)> feels = [](int) { return false; };
  std::function<bool(int tick)> held = [](int) { return false; };  // it does not move
  // How it stands, and believes to stand.
  std::function<messages::AttitudeEstimate(int tick)> attitude = [](int) {
    return messages::AttitudeEstimate{};
  };
};

struct MovingTick {
  double time_s = 0.0;
  messages::PoseEstimate estimate;
  math::Pose2 X_WR;
  bool answered = false;
  NavigatorDecision decision;
  messages::MotionCommand motion;  // that the wheels were told, after the follower

  bool stands() const { return motion.kind == MotionKind::kStop; }
};

// One tick of the rover as the loop of a trial makes it.
class MovingDrive final : public LoggedDrive<MovingTick, GestaltNavigator> {
 public:
  explicit MovingDrive(const MovingSetup& setup)
      : LoggedDrive({setup.params, setup.goal, setup.rover.speed_m_s}, {setup.rover, {}}),
        setup_(setup),
        follower_(setup.rover.speed_m_s, 0.0) {}

  // Until there are so many ticks in the log.
  NavigatorStatus Run(int most_ticks = 40000) {
    return LoggedDrive::Run(most_ticks - static_cast<int>(log_.size()));
  }

  const MovingTick& Step() override {
    const int number = static_cast<int>(log_.size());
    MovingTick tick;
    tick.time_s = number * setup_.rover.tick_s;
    tick.estimate = rover_.estimate();
    tick.X_WR = rover_.X_WR();
    NavigatorInput input{.time_s = tick.time_s,
                         .estimate = tick.estimate,
                         .attitude = setup_.attitude(number),
                         .odometry = odometry_};
    std::optional<Answer> answer;
    if (!under_way_.empty() && under_way_.front().ready_tick <= number) {
      answer = under_way_.front();
      under_way_.pop_front();
      input.cloud = &answer->cloud;
      input.look = &answer->moment;
      tick.answered = true;
    }
    const messages::VehicleHazard felt{};
    if (setup_.feels(number)) input.vehicle_hazard = &felt;
    tick.decision = navigator_.Decide(input);
    if (tick.decision.status == NavigatorStatus::kDriving) Act(tick, number);
    log_.push_back(tick);
    return log_.back();
  }

  // As operators do; looks under way are dropped, as a trial drops them.
  void MoveByHand(const messages::PoseUpdate& update) {
    UpdatePose(update);
    odometry_ = rover_.estimate();
    under_way_.clear();
  }

  int StopsToLook() const {
    return static_cast<int>(std::count_if(log_.begin(), log_.end(), [](const MovingTick& tick) {
      return tick.decision.stops_to_look();
    }));
  }
  int Answers() const {
    return static_cast<int>(std::count_if(log_.begin(), log_.end(),
                                          [](const MovingTick& tick) { return tick.answered; }));
  }

 private:
  struct Answer {
    int ready_tick = 0;
    messages::PointCloud cloud;
    messages::LookMoment moment;
  };

  void Act(MovingTick& tick, int number) {
    if (tick.decision.looks()) {
      const bool stops = tick.decision.stops_to_look();
      if (stops) under_way_.clear();
      if (stops || !setup_.loses_answers) See(*tick.decision.look, number, stops);
      if (stops) return;
    }
    tick.motion =
        follower_.Follow(tick.decision.motion, tick.estimate.distance_m, setup_.rover.tick_s);
    const messages::PoseEstimate before = rover_.estimate();
    if (!setup_.held(number)) rover_.Move(tick.motion);
    CarryOdometry(before, rover_.estimate());
  }

  void See(LookDirection direction, int number, bool stops) {
    Answer answer;
    answer.ready_tick = number + 1 + (stops ? 0 : setup_.latency_ticks);
    answer.cloud.direction = direction;
    answer.cloud.points_R = setup_.range.Look(rover_.X_WR(), direction, setup_.height);
    const messages::AttitudeEstimate attitude = setup_.attitude(number);
    // From the levelled frame of the rover to its own.
    const math::Transform X_LR =
        math::MakePose({0.0, 0.0, attitude.z_m}, 0.0, attitude.pitch_rad, attitude.roll_rad);
    for (math::Vector3& point : answer.cloud.points_R) point = X_LR.inverse() * point;
    answer.moment = {looks_++, number * setup_.rover.tick_s, rover_.estimate(), odometry_,
                     attitude};
    under_way_.push_back(answer);
  }

  // Adds the motion of a tick, as measured, to the pose in the frame of odometry.
  void CarryOdometry(const messages::PoseEstimate& before, const messages::PoseEstimate& after) {
    const double turn_rad = odometry_.heading_rad - before.heading_rad;
    const double dx_m = after.x_m - before.x_m;
    const double dy_m = after.y_m - before.y_m;
    odometry_.x_m += std::cos(turn_rad) * dx_m - std::sin(turn_rad) * dy_m;
    odometry_.y_m += std::sin(turn_rad) * dx_m + std::cos(turn_rad) * dy_m;
    odometry_.heading_rad =
        math::WrapAngle(odometry_.heading_rad + after.heading_rad - before.heading_rad);
    odometry_.distance_m = after.distance_m;
  }

  MovingSetup setup_;
  MotionFollower follower_;
  messages::PoseEstimate odometry_;
  std::deque<Answer> under_way_;
  std::int64_t looks_ = 0;
};

inline MovingSetup SetupOf(DriveCycle cycle) {
  MovingSetup setup;
  setup.params.continuous.cycle = cycle;
  setup.params.waypoints.goal_tolerance_m = 0.5;
  setup.params.drive.arrival_check = ArrivalCheck::kWhileDriving;
  setup.rover.speed_m_s = 0.07;
  return setup;
}

inline constexpr DriveCycle kOnTheMove[] = {DriveCycle::kCsod, DriveCycle::kCsad};

inline void SeeNearGroundOnly(MovingSetup& setup) {
  setup.range.range_m = 1.2;
  setup.params.plan.plan_max_dist_m = setup.params.splines.length_m = 1.1;
}

// What holds for either cycle that looks on the move.
class OnTheMove : public testing::TestWithParam<DriveCycle> {
 protected:
  MovingSetup setup_ = SetupOf(GetParam());
};

// Blocks hold no place of the vehicle's centre: obstacles grow by half its width, 0.42 m, in the
// map; a cell of 0.2 m may be half covered.
inline void ExpectClearOf(const MovingDrive& drive, const Block& block) {
  for (const MovingTick& tick : drive.log()) {
    ASSERT_FALSE(block.Holds(tick.X_WR.x_m, tick.X_WR.y_m, 0.42 - 0.1))
        << tick.X_WR.x_m << ", " << tick.X_WR.y_m;
  }
}

}  // namespace rockyard::navigation
