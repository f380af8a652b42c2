// Clothoids on flat, firm ground: the path that the wheels really make against the planned one,
// where the steering motors keep up with the curvature and where they do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "math/angles.h"
#include "navigation/navigator.h"
#include "rover/rover_layout_params.h"
#include "scenario/shipped.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using messages::MotionCommand;
using messages::MotionKind;

// Curvature c + c' s over `length_m`, s from where the piece begins.
struct Piece {
  double curvature_per_m = 0.0;
  double rate_per_m2 = 0.0;
  double length_m = 0.0;
};

// A path of pieces, one after the other, from the origin along x.
class Plan {
 public:
  explicit Plan(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  double length_m() const {
    double sum_m = 0.0;
    for (const Piece& piece : pieces_) sum_m += piece.length_m;
    return sum_m;
  }

  // The piece at s, and where it begins.
  struct Place {
    Piece piece;
    double from_m = 0.0;
  };
  Place At(double s_m) const {
    Place place{pieces_.front(), 0.0};
    for (std::size_t i = 1; i < pieces_.size(); ++i) {
      if (s_m < place.from_m + place.piece.length_m) break;
      place = {pieces_[i], place.from_m + place.piece.length_m};
    }
    return place;
  }

  double Curvature(double s_m) const {
    const auto [piece, from_m] = At(s_m);
    return piece.curvature_per_m + piece.rate_per_m2 * (s_m - from_m);
  }

  // Heading: c s + c' s^2 / 2 of the piece at s, after the whole of those before.
  double Heading(double s_m) const {
    double heading_rad = 0.0;
    double from_m = 0.0;
    for (const Piece& piece : pieces_) {
      const double way_m = std::clamp(s_m - from_m, 0.0, piece.length_m);
      heading_rad += piece.curvature_per_m * way_m + 0.5 * piece.rate_per_m2 * way_m * way_m;
      from_m += piece.length_m;
    }
    return heading_rad;
  }

  // x = int cos(heading) ds, y = int sin(heading) ds by Simpson's rule over steps of 5 mm: right to
  // some 0.01 mm, also where the curvature jumps within one.
  math::Pose2 Pose(double s_m) const {
    const auto steps = static_cast<int>(std::ceil(s_m / 5e-3)) + 1;
    const double h_m = s_m / steps;
    math::Pose2 pose{0.0, 0.0, Heading(s_m)};
    for (int i = 0; i < steps; ++i) {
      const double a_rad = Heading(i * h_m);
      const double m_rad = Heading((i + 0.5) * h_m);
      const double b_rad = Heading((i + 1.0) * h_m);
      pose.x_m += h_m / 6.0 * (std::cos(a_rad) + 4.0 * std::cos(m_rad) + std::cos(b_rad));
      pose.y_m += h_m / 6.0 * (std::sin(a_rad) + 4.0 * std::sin(m_rad) + std::sin(b_rad));
    }
    return pose;
  }

  // Sums over the jumps of the curvature, from a straight start on: of J, 1/m, and of J times the
  // way from there to the end.
  double Jumps() const {
    return SumOfJumps([](double) { return 1.0; });
  }
  double JumpsTimesRest() const {
    return SumOfJumps([this](double from_m) { return length_m() - from_m; });
  }

  Plan Mirrored() const {
    std::vector<Piece> pieces = pieces_;
    for (Piece& piece : pieces) {
      piece.curvature_per_m *= -1.0;
      piece.rate_per_m2 *= -1.0;
    }
    return Plan(pieces);
  }

 private:
  template <typename Weight>
  double SumOfJumps(const Weight& weight) const {
    double sum = 0.0;
    double before_per_m = 0.0;
    double from_m = 0.0;
    for (const Piece& piece : pieces_) {
      sum += std::abs(piece.curvature_per_m - before_per_m) * weight(from_m);
      before_per_m = piece.curvature_per_m + piece.rate_per_m2 * piece.length_m;
      from_m += piece.length_m;
    }
    return sum;
  }

  std::vector<Piece> pieces_;
};

struct DraughtsmanParams {
  Plan plan{{{0.0, 0.0, 1.0}}};
  int direction = 1;

  void Visit(core::FieldVisitor&) {}
};

// Drives the pieces of a plan as one move, and gives up at its end. The tick at which it tells a
// piece is up to a tick's way beyond where that begins: it tells the piece's curvature of there.
class Draughtsman final : public navigation::Navigator {
 public:
  explicit Draughtsman(const DraughtsmanParams& params) : params_(params) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    const double odometer_m = input.estimate.distance_m;
    if (odometer_m >= params_.plan.length_m()) {
      return {.status = navigation::NavigatorStatus::kGaveUp};
    }
    if (odometer_m >= until_m_) Begin(odometer_m);
    return {.motion = motion_};
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}

 private:
  void Begin(double odometer_m) {
    const Plan::Place place = params_.plan.At(odometer_m);
    motion_ = {.kind = MotionKind::kArc,
               .curvature_per_m = params_.plan.Curvature(odometer_m),
               .direction = params_.direction,
               .curvature_rate_per_m2 = place.piece.rate_per_m2,
               .move = 1};
    until_m_ = place.from_m + place.piece.length_m;
  }

  DraughtsmanParams params_;
  MotionCommand motion_;
  double until_m_ = 0.0;  // the end of the piece under way
};

// Wheels that steer at once and hardly slip, at the speed of Athena (Howard 2012).
constexpr double kSpeed_m_s = 0.07;
const Overrides kIdealMotors = {"terrain.ground.soil.preset=hard_ground", "rover.drive.ramp_s=0",
                                "rover.drive.steer_rate_deg_s=1000",
                                "navigation.wheel_driver.steer_rate_deg_s=1000",
                                "rover.drive.speed_m_s=0.07"};
const Overrides kQuasiStatic = {"rover.fidelity=quasi_static"};
const Overrides kMultibody = {"rover.fidelity=multibody"};
const Overrides kRolling = {"clock.overlap.steering=true"};
constexpr double kTick_s = 0.05;
// What is driven in a tick.
constexpr double kTick_m = kSpeed_m_s * kTick_s;

DriveParams PlanDrive(const DraughtsmanParams& draughtsman, const Overrides& overrides) {
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add<DraughtsmanParams>(
      {.name = "draughtsman",
       .doc = "drives a plan",
       .traits = [](const DraughtsmanParams&) -> navigation::NavigatorTraits {
         return {navigation::LookReading::kNothing, navigation::CostOfLook{}, {}};
       },
       .make = [](const DraughtsmanParams& p, const navigation::NavigatorSetup&)
           -> std::unique_ptr<navigation::Navigator> { return std::make_unique<Draughtsman>(p); }},
      draughtsman);
  const Overrides empty = {"navigation.navigator=draughtsman", "terrain.rocks.kind=none",
                           "terrain.arena.kind=open", "localization.estimator=oracle",
                           "clock.control_rate_hz=20"};
  return scenario::Shipped("pathfinder/nominal", empty + overrides, defaults).drive;
}

struct Driven {
  DriveParams params;
  TracedTrial trial;

  const std::vector<truth::TraceSample>& samples() const { return trial.trace.samples; }
  const truth::DriveRecord& record() const { return trial.result.record; }
};

Driven Follow(const Plan& plan, const Overrides& overrides, int direction = 1) {
  Driven driven{PlanDrive({plan, direction}, kIdealMotors + overrides), {}};
  driven.trial = RunTraced(driven.params, 0);
  return driven;
}

// Where the plan leads within s. Backward, at the rate -c of turning with the way and with the
// heading against it, that is (-x, y) at the heading -psi.
math::Pose2 Planned(const Plan& plan, double s_m, int direction) {
  math::Pose2 pose = plan.Pose(s_m);
  pose.x_m *= direction;
  pose.heading_rad *= direction;
  return pose;
}

struct Deviation {
  double position_m = 0.0;
  double heading_rad = 0.0;
};

// From where the plan leads within the way that was driven, at the tick at which it is largest.
Deviation LargestDeviation(const Driven& driven, const Plan& plan, int direction = 1) {
  const math::Pose2 start = math::ToPose2(driven.trial.trace.rests.front().sample.posture.X_WR);
  Deviation largest;
  for (const truth::TraceSample& sample : driven.samples()) {
    if (sample.estimate.distance_m > plan.length_m()) continue;
    const math::Pose2 planned = Planned(plan, sample.estimate.distance_m, direction);
    largest.position_m =
        std::max(largest.position_m, std::hypot(sample.pose.x_m - start.x_m - planned.x_m,
                                                sample.pose.y_m - start.y_m - planned.y_m));
    largest.heading_rad = std::max(
        largest.heading_rad, std::abs(math::WrapAngle(sample.pose.heading_rad - start.heading_rad -
                                                      planned.heading_rad)));
  }
  return largest;
}

// A bend, an S of three clothoids, one whose wheels are steered by 3 deg/s, and a corner where the
// curvature jumps: within 1 / m.
const Plan kBend({{0.0, 0.5, 2.0}});
const Plan kSnake({{0.0, 0.8, 0.75}, {0.6, -0.8, 1.5}, {-0.6, 0.8, 0.75}});
const Plan kSharp({{0.0, 3.0, 0.3}, {0.9, -3.0, 0.6}, {-0.9, 3.0, 0.3}});
const Plan kCorner({{0.0, 0.0, 0.5}, {0.5, 0.0, 1.0}, {-0.5, 0.5, 1.5}});

// A piece begins up to a tick's way d late: a jump of the curvature by J leaves the heading off by
// up to J d, and what lies across the way by that much of what is still to go. `close` is what is
// left without jumps.
void ExpectPlanned(const Driven& driven, const Plan& plan, const Deviation& close,
                   int direction = 1) {
  EXPECT_GT(driven.record().true_distance_m, plan.length_m() - kTick_m);
  const Deviation off = LargestDeviation(driven, plan, direction);
  EXPECT_LT(off.position_m, close.position_m + kTick_m * plan.JumpsTimesRest());
  EXPECT_LT(off.heading_rad, close.heading_rad + kTick_m * plan.Jumps());
}

// Less than half a tick's way, and the angle of that at 1 / m. The multibody holds itself to the
// ground by friction at every moment. The quasi-static rover moves along a chord from tick to tick,
// in the direction of a balance of forces half a tick ahead, where it expects to be by the motion
// of the tick before: its tolerance is three times as wide.
constexpr Deviation kCloseMultibody{0.0005, 0.0005};
constexpr Deviation kCloseQuasiStatic{0.0015, 0.0015};

TEST(ClothoidDrive, ThePathIsThePlannedOneWithinATick) {
  for (const Plan& plan : {kBend, kSnake, kSharp, kCorner}) {
    for (const auto& [each, direction] : {std::pair(plan, 1), std::pair(plan.Mirrored(), -1)}) {
      SCOPED_TRACE(testing::Message() << each.Curvature(0.7) << " 1/m, way " << direction);
      const Driven quasi_static = Follow(each, kQuasiStatic + kRolling, direction);
      ExpectPlanned(quasi_static, each, kCloseQuasiStatic, direction);
      const Driven multibody = Follow(each, kMultibody + kRolling, direction);
      ExpectPlanned(multibody, each, kCloseMultibody, direction);
      for (const Driven* driven : {&quasi_static, &multibody}) {
        EXPECT_EQ(driven->record().moves, 1.0);
        EXPECT_EQ(driven->record().stops, 1.0);  // the end
      }
    }
  }
}

// Where it may not steer on the move beyond 10 deg, it stands at the corner, and nowhere else.
TEST(ClothoidDrive, ThePathIsTheSameWhereTheRoverStandsToSteer) {
  for (const auto& [fidelity, close] :
       {std::pair(kQuasiStatic, kCloseQuasiStatic), std::pair(kMultibody, kCloseMultibody)}) {
    const Driven snake = Follow(kSnake, fidelity);
    ExpectPlanned(snake, kSnake, close);
    EXPECT_EQ(snake.record().stops, 1.0);
    const Driven corner = Follow(kCorner, fidelity);
    ExpectPlanned(corner, kCorner, close);
    EXPECT_EQ(corner.record().stops, 2.0);
    EXPECT_GT(corner.record().steer_time_s, 0.0);
  }
}

// Angle and rim speed, as a share of the fastest, of a wheel at (x, y) about the centre of rotation
// (0, 1 / c): its axle points there where it is steered.
struct Ackermann {
  messages::PerWheel<double> steer_rad{};
  messages::PerWheel<double> rim_share{};

  Ackermann(const messages::DriveCalibration& wheels, double c) {
    double fastest = 0.0;
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      const double along = 1.0 - c * wheels.wheel_y_m[i];
      const double across = wheels.steered[i] ? c * wheels.wheel_x_m[i] : 0.0;
      steer_rad[i] = std::atan(across / along);
      rim_share[i] = std::hypot(along, across);
      fastest = std::max(fastest, rim_share[i]);
    }
    for (double& share : rim_share) share /= fastest;
  }
};

TEST(ClothoidDrive, WheelsAreThoseOfTheCurvatureOfTheMoment) {
  for (const Overrides& fidelity : {kQuasiStatic, kMultibody}) {
    const Driven driven = Follow(kSharp, fidelity + kRolling);
    const messages::DriveCalibration wheels = rover::MakeDriveCalibration(driven.params.rover);
    const std::vector<truth::TraceSample>& samples = driven.samples();
    for (std::size_t tick = 2; tick + 1 < samples.size(); ++tick) {
      const truth::TraceSample& before = samples[tick - 1];
      const truth::TraceSample& now = samples[tick];
      const double from_m = before.estimate.distance_m;
      const double to_m = now.estimate.distance_m;
      if (kSharp.At(from_m).from_m != kSharp.At(to_m).from_m) continue;
      const Ackermann wanted(wheels, kSharp.Curvature(0.5 * (from_m + to_m)));
      for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
        // A rim at full speed leaves R's origin less in a bend, so that the middle of a tick lies
        // up to 0.35 mm before where it is told for: at 3 / m2 and 0.35 m of angle per curvature.
        EXPECT_NEAR(now.posture.steer_rad[i], wanted.steer_rad[i], 5e-4) << tick << " " << i;
        const double rim_m_s =
            wheels.wheel_radius_m *
            (now.posture.wheel_angle_rad[i] - before.posture.wheel_angle_rad[i]) / kTick_s;
        EXPECT_NEAR(rim_m_s, kSpeed_m_s * wanted.rim_share[i], 1e-4) << tick << " " << i;
      }
    }
  }
}

// To 0.6 / m and back, to -0.6 / m and back: each motor turns by twice the sum of the angles there.
// What the curvature's peaks fall short of between two ticks is 0.8 / m2 times a tick's way.
TEST(ClothoidDrive, TheRecordAddsUpWhatTheMotorsTurned) {
  for (const Overrides& fidelity : {kQuasiStatic, kMultibody}) {
    const Driven driven = Follow(kSnake, fidelity + kRolling);
    const messages::DriveCalibration wheels = rover::MakeDriveCalibration(driven.params.rover);
    const Ackermann left(wheels, 0.6);
    const Ackermann right(wheels, -0.6);
    double sum_rad = 0.0;
    double most_rad = 0.0;
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      const double turned_rad = 2.0 * (std::abs(left.steer_rad[i]) + std::abs(right.steer_rad[i]));
      sum_rad += turned_rad;
      most_rad = std::max(most_rad, turned_rad);
    }
    EXPECT_NEAR(driven.record().steer_turned_rad, sum_rad / 4.0, 0.003);
    EXPECT_NEAR(driven.record().steer_turned_max_rad, most_rad, 0.003);
    EXPECT_GT(sum_rad / 4.0, 0.5);
  }
}

const Overrides kSlowMotors = {"rover.drive.steer_rate_deg_s=1",
                               "navigation.wheel_driver.steer_rate_deg_s=1"};

// The control: motors that take 1 deg/s where 3 are asked for, while the wheels roll on.
TEST(ClothoidDrive, WhereTheMotorsAreTooSlowThePathLags) {
  for (const Overrides& fidelity : {kQuasiStatic, kMultibody}) {
    const Driven driven = Follow(kSharp, fidelity + kRolling + kSlowMotors);
    EXPECT_GT(LargestDeviation(driven, kSharp).position_m, 5.0 * kTick_m);
    EXPECT_EQ(driven.record().stops, 1.0);  // the end
    const double most_rad = math::DegToRad(1.0) * kTick_s;
    const std::vector<truth::TraceSample>& samples = driven.samples();
    std::size_t limited = 0;
    for (std::size_t tick = 1; tick < samples.size(); ++tick) {
      double largest_rad = 0.0;
      for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
        largest_rad = std::max(largest_rad, std::abs(samples[tick].posture.steer_rad[i] -
                                                     samples[tick - 1].posture.steer_rad[i]));
      }
      EXPECT_LT(largest_rad, most_rad + 1e-12) << tick;
      if (largest_rad > most_rad - 1e-12) ++limited;
      EXPECT_GT(samples[tick].estimate.distance_m, samples[tick - 1].estimate.distance_m) << tick;
    }
    EXPECT_GT(limited, 9 * samples.size() / 10);
  }
}

// And the control of the control: motors as slow make the planned path where the rover stands for
// each of their turns. Of the quasi-static rover, which stands still while its wheels are steered:
// the multibody's odometer moves by what they scrub.
TEST(ClothoidDrive, SlowMotorsMakeThePathWhereTheRoverWaitsForThem) {
  const Driven driven =
      Follow(kSharp, kQuasiStatic + kSlowMotors +
                         Overrides{"navigation.wheel_driver.steer_while_driving_deg=0"});
  ExpectPlanned(driven, kSharp, {.position_m = kTick_m, .heading_rad = kTick_m});
  EXPECT_GT(driven.record().steer_time_s, driven.record().drive_time_s);
  EXPECT_GT(driven.record().stops, 100.0);
}

}  // namespace
}  // namespace rockyard::trial
