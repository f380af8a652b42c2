// The closed loop of GESTALT and the fake rover: range points come from a height function.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "navigation/fake_rover.h"
#include "navigation/gestalt/gestalt.h"

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

struct GestaltSetup {
  GestaltParams params;
  messages::Goal goal{5.0, 0.0};
  math::Pose2 start;
  messages::AttitudeEstimate attitude;  // how the rover stands, and believes to stand, everywhere
  FakeRoverConfig rover;
  HeightAt height = Flat();
  FakeRange range;
  std::function<std::optional<messages::VehicleHazard>(const FakeRover&)> felt = Nothing();
  std::function<bool(const FakeRover&)> touches_behind = [](const FakeRover&) { return false; };
};

struct GestaltTick {
  double time_s = 0.0;
  messages::PoseEstimate estimate;
  math::Pose2 X_WR;
  bool has_cloud = false;
  NavigatorDecision decision;

  bool moves() const { return !decision.looks() && decision.status == NavigatorStatus::kDriving; }
  bool turns() const {
    return moves() && decision.motion.kind == messages::MotionKind::kTurnInPlace;
  }
  bool drives() const { return moves() && decision.motion.kind == messages::MotionKind::kArc; }
  bool backs() const { return drives() && decision.motion.direction < 0; }
  bool chooses() const { return has_cloud && moves(); }
  bool looks(messages::LookDirection direction) const {
    return decision.looks() && *decision.look == direction;
  }
};

class GestaltDrive final : public LoggedDrive<GestaltTick, GestaltNavigator> {
 public:
  explicit GestaltDrive(const GestaltSetup& setup)
      : LoggedDrive({setup.params, setup.goal}, {setup.rover, setup.start}), setup_(setup) {}

  const GestaltTick& Step() override {
    GestaltTick tick;
    tick.time_s = static_cast<double>(log_.size()) * setup_.rover.tick_s;
    tick.estimate = rover_.estimate();
    tick.X_WR = rover_.X_WR();
    NavigatorInput input{
        .time_s = tick.time_s, .estimate = tick.estimate, .attitude = setup_.attitude};
    messages::PointCloud cloud;
    if (!log_.empty() && log_.back().decision.looks()) {
      cloud.direction = *log_.back().decision.look;
      cloud.points_R = setup_.range.Look(rover_.X_WR(), cloud.direction, setup_.height);
      Tilt(cloud);
      input.cloud = &cloud;
      tick.has_cloud = true;
    }
    const auto felt = setup_.felt(rover_);
    if (felt) input.vehicle_hazard = &*felt;
    input.touches_behind = setup_.touches_behind(rover_);
    tick.decision = navigator_.Decide(input);
    if (tick.moves()) rover_.Move(tick.decision.motion);
    log_.push_back(tick);
    return log_.back();
  }

  int Looks(messages::LookDirection direction) const {
    int looks = 0;
    for (const GestaltTick& tick : log_) looks += tick.looks(direction) ? 1 : 0;
    return looks;
  }

 private:
  // From the levelled frame of the rover to its own.
  void Tilt(messages::PointCloud& cloud) const {
    const messages::AttitudeEstimate& a = setup_.attitude;
    const math::Transform X_LR = math::MakePose({0.0, 0.0, a.z_m}, 0.0, a.pitch_rad, a.roll_rad);
    for (math::Vector3& point : cloud.points_R) point = X_LR.inverse() * point;
  }

  GestaltSetup setup_;
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
inline FakeRoverConfig TrueRover() {
  FakeRoverConfig rover;
  rover.gyro_scale = 1.0;
  rover.odometer_scale = 1.0;
  return rover;
}

inline GestaltSetup TrueSetup() {
  GestaltSetup setup;
  setup.rover = TrueRover();
  return setup;
}

}  // namespace rockyard::navigation
