// The closed loop of GESTALT and the fake rover, whose looks may take time: range points come from
// a height function.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>

#include "navigation/fake_rover.h"
#include "navigation/gestalt/gestalt.h"
#include "navigation/route_follower.h"

namespace rockyard::navigation {

// Height of the ground at a place of the world.
using HeightAt = std::function<double(double x_m, double y_m)>;

inline HeightAt Flat() {
  return [](double, double) { return 0.0; };
}

struct Block {
  double x0_m = 0.0;
  double x1_m = 0.0;
  double y0_m = 0.0;
  double y1_m = 0.0;

  bool Holds(double x_m, double y_m, double margin_m = 0.0) const {
    return x_m > x0_m - margin_m && x_m < x1_m + margin_m && y_m > y0_m - margin_m &&
           y_m < y1_m + margin_m;
  }
};

// Flat ground with blocks half a metre high.
inline HeightAt Blocks(std::vector<Block> blocks) {
  return [blocks = std::move(blocks)](double x_m, double y_m) {
    for (const Block& block : blocks) {
      if (block.Holds(x_m, y_m)) return 0.5;
    }
    return 0.0;
  };
}

// Walls 0.4 m thick that leave a square of 2.4 m inside.
inline std::vector<Block> Pit() {
  return {{1.2, 1.6, -1.6, 1.6},
          {-1.6, -1.2, -1.6, 1.6},
          {-1.6, 1.6, 1.2, 1.6},
          {-1.6, 1.6, -1.6, -1.2}};
}

// Points every 8 cm of what lies up to `range_m` within `half_angle_rad` of where the rover looks,
// with no occlusion. Two points a cell and axis at least, at 20 cm cells.
struct FakeRange {
  double near_m = 0.3;
  double range_m = 3.0;
  double half_angle_rad = math::DegToRad(60.0);

  std::vector<math::Vector3> Look(const math::Pose2& X_WR, messages::LookDirection direction,
                                  const HeightAt& height) const {
    constexpr double kSpacing_m = 0.08;
    std::vector<math::Vector3> points_R;
    const double side = direction == messages::LookDirection::kAhead ? 1.0 : -1.0;
    const int n = static_cast<int>(range_m / kSpacing_m);
    const double c = std::cos(X_WR.heading_rad);
    const double s = std::sin(X_WR.heading_rad);
    for (int i = 1; i <= n; ++i) {
      for (int j = -n; j <= n; ++j) {
        const double x_m = i * kSpacing_m;
        const double y_m = j * kSpacing_m;
        const double r_m = std::hypot(x_m, y_m);
        if (r_m < near_m || r_m > range_m) continue;
        if (std::abs(std::atan2(y_m, x_m)) > half_angle_rad) continue;
        const double z_m =
            height(X_WR.x_m + c * side * x_m - s * y_m, X_WR.y_m + s * side * x_m + c * y_m);
        points_R.push_back({side * x_m, y_m, z_m});
      }
    }
    return points_R;
  }
};

// Whether something happens at a tick.
using AtTick = std::function<bool(int tick)>;

inline bool Never(int) { return false; }

struct GestaltSetup {
  GestaltParams params{};
  messages::Goal goal{5.0, 0.0};
  math::Pose2 start{};
  FakeRoverConfig rover{};
  HeightAt height = Flat();
  FakeRange range{};
  int latency_ticks = 0;  // from a look on the move to its answer
  bool loses_answers = false;
  std::function<std::optional<messages::VehicleHazard>(const FakeRover&)> felt = Nothing();
  std::function<bool(const FakeRover&)> touches_behind = [](const FakeRover&) { return false; };
  AtTick feels = Never;  // a touch ahead, beside what is felt
  AtTick held = Never;   // it does not move
  // How it stands, and believes to stand.
  std::function<messages::AttitudeEstimate(int tick)> attitude = [](int) {
    return messages::AttitudeEstimate{};
  };
};

struct GestaltTick {
  double time_s = 0.0;
  messages::PoseEstimate estimate{};
  math::Pose2 X_WR{};
  bool has_cloud = false;
  NavigatorDecision decision{};
  messages::MotionCommand motion{};  // that the wheels were told, after the follower

  bool moves() const { return !decision.looks() && decision.status == NavigatorStatus::kDriving; }
  bool turns() const {
    return moves() && decision.motion.kind == messages::MotionKind::kTurnInPlace;
  }
  bool drives() const { return moves() && decision.motion.kind == messages::MotionKind::kArc; }
  bool backs() const { return drives() && decision.motion.direction < 0; }
  bool stands() const { return motion.kind == messages::MotionKind::kStop; }
  bool chooses() const { return has_cloud && moves(); }
  bool looks(messages::LookDirection direction) const {
    return decision.looks() && *decision.look == direction;
  }
};

// One tick of the rover as the loop of a trial makes it.
class GestaltDrive final : public LoggedDrive<GestaltTick, GestaltNavigator> {
 public:
  explicit GestaltDrive(const GestaltSetup& setup)
      : LoggedDrive({setup.params, setup.goal, setup.rover.speed_m_s}, {setup.rover, setup.start}),
        setup_(setup),
        follower_(setup.rover.speed_m_s, 0.0),
        odometry_(rover_.estimate()) {}

  const GestaltTick& Step() override {
    const int number = static_cast<int>(log_.size());
    GestaltTick tick{.time_s = number * setup_.rover.tick_s,
                     .estimate = rover_.estimate(),
                     .X_WR = rover_.X_WR()};
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
      tick.has_cloud = true;
    }
    auto felt = setup_.felt(rover_);
    if (setup_.feels(number)) felt = messages::VehicleHazard{};
    if (felt) input.vehicle_hazard = &*felt;
    input.touches_behind = setup_.touches_behind(rover_);
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

  int Looks(messages::LookDirection direction) const {
    return Count([=](const GestaltTick& tick) { return tick.looks(direction); });
  }
  int StopsToLook() const {
    return Count([](const GestaltTick& tick) { return tick.decision.stops_to_look(); });
  }
  int Answers() const { return Count(std::mem_fn(&GestaltTick::has_cloud)); }

 private:
  struct Answer {
    int ready_tick = 0;
    messages::PointCloud cloud;
    messages::LookMoment moment;
  };

  template <typename Holds>
  int Count(const Holds& holds) const {
    return static_cast<int>(std::count_if(log_.begin(), log_.end(), holds));
  }

  void Act(GestaltTick& tick, int number) {
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

  void See(messages::LookDirection direction, int number, bool stops) {
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
    const math::Pose2 carried = math::Carried(Planar(odometry_), Planar(before), Planar(after));
    odometry_ = {carried.x_m, carried.y_m, carried.heading_rad, after.distance_m};
  }

  GestaltSetup setup_;
  MotionFollower follower_;
  messages::PoseEstimate odometry_;
  std::deque<Answer> under_way_;
  std::int64_t looks_ = 0;
};

// Of the map of the last decision.
inline const messages::MapCellView& CellAt(const GestaltDrive& drive, double x_m, double y_m) {
  const messages::MapView& map = drive.navigator().view()->map;
  return map.Cell(static_cast<int>(std::floor((x_m - map.x0_m) / map.xstep_m)),
                  static_cast<int>(std::floor((y_m - map.y0_m) / map.ystep_m)));
}

inline int GoodnessAt(const GestaltDrive& drive, double x_m, double y_m) {
  return CellAt(drive, x_m, y_m).goodness;
}

// Whether two maps hold the same heights in the same cells.
inline bool HoldSameData(const messages::MapView& a, const messages::MapView& b) {
  if (a.x0_m != b.x0_m || a.y0_m != b.y0_m || a.cells.size() != b.cells.size()) return false;
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    if (a.cells[i].has_data != b.cells[i].has_data) return false;
    if (a.cells[i].elevation_m != b.cells[i].elevation_m) return false;
  }
  return true;
}

// A rover whose encoders and gyro tell the truth.
inline FakeRoverConfig TrueRover() { return {.gyro_scale = 1.0, .odometer_scale = 1.0}; }

inline GestaltSetup TrueSetup() { return {.rover = TrueRover()}; }

// What tests of GESTALT on the move share.

using messages::LookDirection;
using messages::MotionKind;

inline GestaltSetup SetupOf(DriveCycle cycle) {
  GestaltSetup setup = TrueSetup();
  setup.goal = {8.0, 0.0};
  setup.params.continuous.cycle = cycle;
  setup.params.waypoints.goal_tolerance_m = 0.5;
  setup.params.drive.arrival_check = ArrivalCheck::kWhileDriving;
  setup.rover.speed_m_s = 0.07;
  return setup;
}

inline constexpr DriveCycle kOnTheMove[] = {DriveCycle::kCsod, DriveCycle::kCsad};

inline void SeeNearGroundOnly(GestaltSetup& setup) {
  setup.range.range_m = 1.2;
  setup.params.plan.plan_max_dist_m = setup.params.splines.length_m = 1.1;
}

// What holds for either cycle that looks on the move.
class OnTheMove : public testing::TestWithParam<DriveCycle> {
 protected:
  GestaltSetup setup_ = SetupOf(GetParam());
};

// Blocks hold no place of the vehicle's centre: obstacles grow by half its width, 0.42 m, in the
// map; a cell of 0.2 m may be half covered.
inline void ExpectClearOf(const GestaltDrive& drive, const Block& block) {
  for (const GestaltTick& tick : drive.log()) {
    ASSERT_FALSE(block.Holds(tick.X_WR.x_m, tick.X_WR.y_m, 0.42 - 0.1))
        << tick.X_WR.x_m << ", " << tick.X_WR.y_m;
  }
}

}  // namespace rockyard::navigation
