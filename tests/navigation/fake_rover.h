// A rover in the plane that does what a navigator commands, one tick at a time, and believes its
// own encoders and gyro. It carries no terrain: reports come from a function of the test.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/random.h"
#include "math/pose.h"
#include "navigation/navigator.h"
#include "navigation/pathfinder/pathfinder.h"

namespace rockyard::navigation {

using Stripes = messages::PerStripe<bool>;

inline constexpr Stripes kClear{};
inline constexpr Stripes kLeftHazard{true, true, false, false, false};
inline constexpr Stripes kCentreHazard{false, false, true, false, false};
inline constexpr Stripes kRightHazard{false, false, false, true, true};
inline constexpr Stripes kOutermostHazards{true, false, false, false, true};
inline constexpr Stripes kAllHazards{true, true, true, true, true};

inline Stripes Mirrored(const Stripes& stripes) {
  return {stripes[4], stripes[3], stripes[2], stripes[1], stripes[0]};
}

// How the fake rover reports its heading; the messages leave it open.
enum class HeadingRange { kWrapped, kUnbounded };

struct FakeRoverConfig {
  double tick_s = 0.05;
  double speed_m_s = 0.15;
  double turn_rate_rad_s = 0.5;
  double gyro_scale = 0.94;      // measured over true turn
  double odometer_scale = 1.05;  // measured over true distance
  HeadingRange heading_range = HeadingRange::kWrapped;

  // Largest measured motion of one tick: what a manoeuvre may overshoot.
  double tick_distance_m() const { return speed_m_s * tick_s * odometer_scale; }
  double tick_turn_rad() const { return turn_rate_rad_s * tick_s * gyro_scale; }
};

class FakeRover {
 public:
  FakeRover(const FakeRoverConfig& config, const math::Pose2& X_WR) : config_(config), X_WR_(X_WR) {
    estimate_.x_m = X_WR.x_m;
    estimate_.y_m = X_WR.y_m;
    estimate_.heading_rad = X_WR.heading_rad;
  }

  void Move(const messages::MotionCommand& motion) {
    if (motion.kind == messages::MotionKind::kStop) return;
    if (motion.kind == messages::MotionKind::kTurnInPlace) {
      Advance(0.0, motion.direction * config_.turn_rate_rad_s * config_.tick_s);
      return;
    }
    const double forward_m = motion.direction * config_.speed_m_s * config_.tick_s;
    Advance(forward_m, motion.curvature_per_m * forward_m);
  }

  void SetEstimate(const messages::PoseUpdate& update) {
    estimate_.x_m = update.x_m;
    estimate_.y_m = update.y_m;
    estimate_.heading_rad = update.heading_rad;
  }

  const FakeRoverConfig& config() const { return config_; }
  const math::Pose2& X_WR() const { return X_WR_; }
  const messages::PoseEstimate& estimate() const { return estimate_; }

 private:
  void Advance(double forward_m, double turn_rad) {
    const double middle_rad = X_WR_.heading_rad + 0.5 * turn_rad;
    X_WR_.x_m += forward_m * std::cos(middle_rad);
    X_WR_.y_m += forward_m * std::sin(middle_rad);
    X_WR_.heading_rad += turn_rad;

    const double measured_m = config_.odometer_scale * forward_m;
    const double measured_rad = config_.gyro_scale * turn_rad;
    const double middle_est_rad = estimate_.heading_rad + 0.5 * measured_rad;
    estimate_.x_m += measured_m * std::cos(middle_est_rad);
    estimate_.y_m += measured_m * std::sin(middle_est_rad);
    estimate_.heading_rad += measured_rad;
    if (config_.heading_range == HeadingRange::kWrapped) {
      estimate_.heading_rad = math::WrapAngle(estimate_.heading_rad);
    }
    estimate_.distance_m += std::abs(measured_m);
  }

  FakeRoverConfig config_;
  math::Pose2 X_WR_;
  messages::PoseEstimate estimate_;
};

// What drives share: navigator and rover, a log of ticks, which hold a `decision`, and stepping
// until something happens.
template <typename Tick, typename DrivingNavigator>
class LoggedDrive {
 public:
  LoggedDrive(DrivingNavigator navigator, const FakeRover& rover)
      : navigator_(std::move(navigator)), rover_(rover) {}
  virtual ~LoggedDrive() = default;

  virtual const Tick& Step() = 0;

  // Steps until a tick satisfies `stop` or the limit is reached; true when it did.
  bool StepUntil(const std::function<bool(const Tick&)>& stop, int max_ticks = 20000) {
    for (int i = 0; i < max_ticks; ++i) {
      if (stop(Step())) return true;
    }
    return false;
  }

  // Steps until the navigator arrives or gives up; kDriving when it does neither.
  NavigatorStatus Run(int max_ticks = 200000) {
    StepUntil([](const Tick& t) { return t.decision.status != NavigatorStatus::kDriving; },
              max_ticks);
    return log_.back().decision.status;
  }

  void UpdatePose(const messages::PoseUpdate& update) {
    const messages::PoseEstimate before = rover_.estimate();
    rover_.SetEstimate(update);
    navigator_.OnPoseUpdate(before, rover_.estimate());
  }
  void Correct(const messages::PoseUpdate& update) {
    const messages::PoseEstimate before = rover_.estimate();
    rover_.SetEstimate(update);
    navigator_.OnCorrection(before, rover_.estimate());
  }
  void SetGoal(const messages::Goal& goal, GoalChange change) { navigator_.SetGoal(goal, change); }

  const std::vector<Tick>& log() const { return log_; }
  const DrivingNavigator& navigator() const { return navigator_; }
  const FakeRover& rover() const { return rover_; }

 protected:
  DrivingNavigator navigator_;
  FakeRover rover_;
  std::vector<Tick> log_;
};

// Random numbers for properties of navigators.
class Draws {
 public:
  Draws(core::TrialKey key, std::uint32_t substream)
      : stream_(key, core::Purpose::kTest, substream) {}

  double Between(double low, double high) { return low + (high - low) * stream_.Uniform(); }
  bool Chance(double probability) { return stream_.Uniform() < probability; }
  int Below(int n) { return static_cast<int>(stream_.Uniform() * n); }

 private:
  core::RandomStream stream_;
};

// What the sensor reports to the rover at scan number 0, 1, 2, ...
using HazardSource = std::function<Stripes(const FakeRover& rover, int scan_number)>;

inline HazardSource Always(const Stripes& stripes) {
  return [stripes](const FakeRover&, int) { return stripes; };
}

// The listed reports, then nothing but clear ground.
inline HazardSource Sequence(std::vector<Stripes> reports) {
  return [reports = std::move(reports)](const FakeRover&, int scan_number) {
    const auto index = static_cast<std::size_t>(scan_number);
    return index < reports.size() ? reports[index] : kClear;
  };
}

// What the rover feels at a tick.
using FeltSource = std::function<std::optional<messages::VehicleHazard>(const FakeRover& rover)>;

inline constexpr messages::VehicleHazard kTouchAhead{messages::VehicleHazardKind::kContact,
                                                     messages::HazardSide::kAhead};

// Felt while the true x lies in (low, high).
inline FeltSource FeltBetween(double low_m, double high_m, const messages::VehicleHazard& what) {
  return [=](const FakeRover& rover) -> std::optional<messages::VehicleHazard> {
    if (rover.X_WR().x_m > low_m && rover.X_WR().x_m < high_m) return what;
    return std::nullopt;
  };
}

inline FeltSource FeltBeyond(double low_m, const messages::VehicleHazard& what = kTouchAhead) {
  return FeltBetween(low_m, std::numeric_limits<double>::infinity(), what);
}

// Felt for a tick, as soon as the true x has come that far.
inline FeltSource FeltOnceBeyond(double x_m, const messages::VehicleHazard& what) {
  return
      [=, felt = false](const FakeRover& rover) mutable -> std::optional<messages::VehicleHazard> {
        if (felt || rover.X_WR().x_m < x_m) return std::nullopt;
        felt = true;
        return what;
      };
}

inline FeltSource Nothing() {
  return [](const FakeRover&) { return std::nullopt; };
}

enum class HazardSensor { kOn, kOff };

struct DriveSetup {
  PathfinderParams params{};
  messages::Goal goal{7.6, 0.0};
  math::Pose2 start{};
  FakeRoverConfig rover{};
  HazardSource hazards = Always(kClear);
  HazardSensor sensor = HazardSensor::kOn;
  FeltSource felt = Nothing();
  // Beside what is felt.
  std::function<bool(const FakeRover& rover)> touches_behind = [](const FakeRover&) {
    return false;
  };
};

// One control tick: what the navigator saw and decided.
struct Tick {
  double time_s = 0.0;
  messages::PoseEstimate estimate{};
  math::Pose2 X_WR{};
  bool has_report = false;
  Stripes report{};
  NavigatorDecision decision{};

  bool moves() const {
    return !decision.looks() && decision.status == NavigatorStatus::kDriving &&
           decision.motion.kind != messages::MotionKind::kStop;
  }
  bool turns() const {
    return moves() && decision.motion.kind == messages::MotionKind::kTurnInPlace;
  }
  bool drives() const { return moves() && decision.motion.kind == messages::MotionKind::kArc; }
  bool backs() const { return drives() && decision.motion.direction < 0; }
};

// The closed loop of navigator and fake rover, with a log of every tick.
class Drive final : public LoggedDrive<Tick, PathfinderNavigator> {
 public:
  explicit Drive(const DriveSetup& setup)
      : LoggedDrive({setup.params, setup.goal, setup.sensor == HazardSensor::kOn},
                    {setup.rover, setup.start}),
        setup_(setup) {}

  const Tick& Step() override {
    Tick tick{.time_s = static_cast<double>(log_.size()) * setup_.rover.tick_s,
              .estimate = rover_.estimate(),
              .X_WR = rover_.X_WR()};
    messages::HazardReport report;
    NavigatorInput input{.time_s = tick.time_s, .estimate = tick.estimate};
    if (!log_.empty() && log_.back().decision.looks()) {
      report.scan_number = scans_;
      report.stripe_hazard = setup_.hazards(rover_, scans_);
      ++scans_;
      input.report = &report;
      tick.has_report = true;
      tick.report = report.stripe_hazard;
    }
    const std::optional<messages::VehicleHazard> felt = setup_.felt(rover_);
    input.touches_behind = felt && felt->side == messages::HazardSide::kBehind;
    if (felt && !input.touches_behind) input.vehicle_hazard = &*felt;
    input.touches_behind |= setup_.touches_behind(rover_);
    tick.decision = navigator_.Decide(input);
    if (tick.moves()) rover_.Move(tick.decision.motion);
    log_.push_back(tick);
    return log_.back();
  }

  // The brakes hold: time passes, and nothing is measured.
  NavigatorDecision HeldDecision(double time_s) {
    return navigator_.Decide({.time_s = time_s, .estimate = rover_.estimate()});
  }

  int scans() const { return scans_; }

 private:
  DriveSetup setup_;
  int scans_ = 0;
};

inline constexpr double kRounding = 1e-9;

// A manoeuvre ends at the first tick at which as much was measured as is asked for, so that it
// exceeds that by less than the motion of a tick.
inline void ExpectEnds(double measured, double asked, double tick) {
  EXPECT_GE(measured, asked - kRounding);
  EXPECT_LE(measured, asked + tick + kRounding);
}

inline double DistanceToGoal(const messages::PoseEstimate& estimate, const messages::Goal& goal) {
  return std::hypot(goal.x_m - estimate.x_m, goal.y_m - estimate.y_m);
}

// Measured motion over a range of ticks, from the change of the estimates.
struct MeasuredMotion {
  double driven_m = 0.0;
  double turned_rad = 0.0;  // sum of magnitudes
};

// Motion measured from tick `first` to tick `last` of a log without pose updates between them.
inline MeasuredMotion MotionBetween(const std::vector<Tick>& log, std::size_t first,
                                    std::size_t last) {
  MeasuredMotion motion;
  for (std::size_t i = first; i < last; ++i) {
    motion.driven_m += log[i + 1].estimate.distance_m - log[i].estimate.distance_m;
    motion.turned_rad +=
        std::abs(math::WrapAngle(log[i + 1].estimate.heading_rad - log[i].estimate.heading_rad));
  }
  return motion;
}

// How often a log comes to ticks that hold something after one that does not.
template <typename AnyTick, typename Holds>
int Stretches(const std::vector<AnyTick>& log, const Holds& holds) {
  int count = 0;
  bool held = false;
  for (const AnyTick& tick : log) {
    count += holds(tick) && !held;
    held = holds(tick);
  }
  return count;
}

inline std::vector<std::size_t> ScanTicks(const std::vector<Tick>& log) {
  std::vector<std::size_t> ticks;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (log[i].decision.looks()) ticks.push_back(i);
  }
  return ticks;
}

}  // namespace rockyard::navigation
