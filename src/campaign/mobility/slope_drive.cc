#include "campaign/mobility/slope_drive.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "math/angles.h"
#include "math/functions.h"
#include "messages/commands.h"
#include "rover/rover.h"
#include "rover/rover_layout_params.h"
#include "terrain/terrain.h"

namespace rockyard::campaign {
namespace {

using messages::kWheelCount;
using messages::PerWheel;

constexpr int kLeastWindows = 4;
constexpr int kMostWindows = 100;
constexpr double kSteadySlip = 1e-4;
// A rover whose rims turn by less than this share of what they are told stalls.
constexpr double kStalled = 0.05;
constexpr double kSlopeTipped_rad = math::DegToRad(30.0);
// Steering that holds the heading: the curvature is -(e / L + the sum of e ds / L^2), e the error
// and L this many wheelbases.
constexpr double kHeldWithin = 0.5;
// The sharpest curve that it may be told to hold it, over the wheelbase.
constexpr double kSharpest = 0.5;
// Across the slope it is steady where its heading is, and turns off where that cannot be held.
constexpr double kHeld_rad = math::DegToRad(0.1);
constexpr double kTurnedOff_rad = math::DegToRad(2.0);
// A rover whose slip is more than this gets nowhere: wheels that stand resist in either direction,
// and what is left of its way is how far that is smoothed. Downhill it is as fast as a balance lets
// it.
constexpr double kSpins = 0.98;
// Ways across below this share of the rims' are none.
constexpr double kNoSide = 1e-9;

// The slope's direction, seen from a rover that heads along x.
double DirectionOf(SlopeWay way) {
  switch (way) {
    case SlopeWay::kUp:
      return 0.0;
    case SlopeWay::kDown:
      return std::numbers::pi;
    case SlopeWay::kAcross:
      return 0.5 * std::numbers::pi;
  }
  return 0.0;
}

terrain::Terrain SlopeOf(const terrain::SoilParams& soil, double slope_rad, SlopeWay way) {
  terrain::GroundParams ground{
      .slope_rad = slope_rad, .slope_direction_rad = DirectionOf(way), .soil = soil};
  ground.soil.spread.enabled = false;
  return {terrain::Ground(ground, {}), {}, {}};
}

// Means over a window of the way.
struct Window {
  double rim_m = 0.0;    // way of the mean rim
  double ahead_m = 0.0;  // way of the rover along its heading, and to its right
  double right_m = 0.0;
  double time_s = 0.0;
  PerWheel<double> load_N{}, sinkage_m{}, torque_Nm{}, work_J{};

  double Slip() const { return 1.0 - ahead_m / rim_m; }
};

class SlopeDrive {
 public:
  SlopeDrive(const rover::RoverParams& params, const terrain::SoilParams& soil, double slope_rad,
             SlopeWay way)
      : params_(params),
        geometry_(rover::MakeRoverGeometry(params.geometry)),
        terrain_(SlopeOf(soil, slope_rad, way)),
        rover_(rover::MakeRover(params, terrain_)),
        way_(way),
        window_m_(
            std::max(soil.slip_sinkage.length_m, 5.0 * params.quasi_static.settle_distance_m)) {
    point_.slope_rad = slope_rad;
    rover_->Place({});
  }

  SlopePoint Run() {
    int steady = 0;
    double slip = 2.0;
    for (int window = 0; window < kMostWindows && steady < 2; ++window) {
      const Window last = DriveWindow();
      if (point_.state != SlopeState::kDrives) break;
      Keep(last);
      const bool settled = window >= kLeastWindows;
      if (settled && (last.Slip() >= 1.0 || last.Slip() <= -kSpins)) {
        point_.state = SlopeState::kSlides;
        break;
      }
      const bool same = std::abs(last.Slip() - slip) < kSteadySlip && HeadingError() < kHeld_rad;
      steady = settled && same ? steady + 1 : 0;
      slip = last.Slip();
    }
    Judge(steady >= 2);
    return point_;
  }

 private:
  // Wheel set points for the planar motion of that curvature, at the set speed of the fastest rim.
  messages::WheelCommand Command(double curvature_per_m) const {
    messages::WheelCommand command;
    double fastest = 0.0;
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const double ahead = 1.0 - curvature_per_m * geometry_.wheel_R[i].y();
      const double across = curvature_per_m * geometry_.wheel_R[i].x();
      command.steer_rad[i] = geometry_.steered[i] ? math::Atan2(across, ahead) : 0.0;
      command.rate_rad_s[i] = geometry_.steered[i] ? math::Hypot(ahead, across) : ahead;
      fastest = std::max(fastest, command.rate_rad_s[i]);
    }
    const double unit_rad_s = params_.drive.speed_m_s / (fastest * params_.geometry.wheel_radius_m);
    for (double& rate : command.rate_rad_s) rate *= unit_rad_s;
    return command;
  }

  // Straight up or down nothing turns it.
  double HeadingError() const {
    return way_ == SlopeWay::kAcross ? std::abs(math::Heading(rover_->state().X_WR)) : 0.0;
  }

  void Judge(bool steady) {
    if (point_.state == SlopeState::kDrives) {
      if (HeadingError() > kTurnedOff_rad) {
        point_.state = SlopeState::kTurns;
      } else if (point_.slip > kSpins) {
        point_.state = SlopeState::kSpins;
      } else if (!steady) {
        point_.state = SlopeState::kCreeps;
      }
    }
    switch (point_.state) {
      case SlopeState::kSpins:
      case SlopeState::kStalls:
        point_.slip = 1.0;
        break;
      case SlopeState::kSlides:
        point_.slip = point_.slip > 0.0 ? 1.0 : -1.0;
        point_.has_values = way_ != SlopeWay::kAcross;
        break;
      case SlopeState::kTurns:
      case SlopeState::kTips:
        point_.has_values = false;
        break;
      default:
        break;
    }
  }

  double Curvature(double step_m) {
    if (way_ != SlopeWay::kAcross) return 0.0;
    const double error_rad = math::Heading(rover_->state().X_WR);
    const double within_m = kHeldWithin * params_.geometry.wheelbase_m;
    const double most_per_m = kSharpest / params_.geometry.wheelbase_m;
    const double wanted_per_m = -(error_rad + error_sum_m_ / within_m) / within_m;
    // The sum waits where the curve cannot be sharper.
    if (std::abs(wanted_per_m) < most_per_m) error_sum_m_ += error_rad * step_m;
    return std::clamp(wanted_per_m, -most_per_m, most_per_m);
  }

  // Rolls for one window; tells the state where that is the end.
  Window DriveWindow() {
    const double radius_m = params_.geometry.wheel_radius_m;
    const double told_m = params_.drive.speed_m_s * rover_->step_s();
    const int most = static_cast<int>(std::ceil(window_m_ / (kStalled * told_m)));
    Window window;
    for (int step = 0; window.rim_m < window_m_; ++step) {
      const truth::RoverState before = rover_->state();
      rover_->Step(Command(Curvature(told_m)));
      const truth::RoverState& after = rover_->state();
      if (math::Tilt(after.X_WR) > point_.slope_rad + kSlopeTipped_rad) {
        point_.state = SlopeState::kTips;
        return window;
      }
      if (step >= most) {
        point_.state = SlopeState::kStalls;
        return window;
      }
      window.time_s += rover_->step_s();
      const math::Vector3 moved_R =
          before.X_WR.linear().transpose() * (after.X_WR.translation() - before.X_WR.translation());
      window.ahead_m += moved_R.x();
      window.right_m -= moved_R.y();
      for (std::size_t i = 0; i < kWheelCount; ++i) {
        const double turn_rad = after.wheel_angle_rad[i] - before.wheel_angle_rad[i];
        window.rim_m += radius_m * turn_rad / kWheelCount;
        window.work_J[i] += after.motor_torque_Nm[i] * turn_rad;
        window.load_N[i] += after.wheel_load_N[i] * rover_->step_s();
        window.sinkage_m[i] += after.wheel_sinkage_m[i] * rover_->step_s();
        window.torque_Nm[i] += after.motor_torque_Nm[i] * rover_->step_s();
      }
    }
    return window;
  }

  void Keep(const Window& window) {
    point_.slip = std::clamp(window.Slip(), -1.0, 1.0);
    const bool sideways = std::abs(window.right_m) > kNoSide * window.rim_m;
    point_.side_slip_rad = sideways ? math::Atan2(window.right_m, std::abs(window.ahead_m)) : 0.0;
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      point_.load_N[i] = window.load_N[i] / window.time_s;
      point_.sinkage_m[i] = window.sinkage_m[i] / window.time_s;
      point_.torque_Nm[i] = window.torque_Nm[i] / window.time_s;
      point_.power_W[i] = window.work_J[i] / window.time_s;
    }
  }

  const rover::RoverParams params_;
  const rover::RoverGeometry geometry_;
  const terrain::Terrain terrain_;
  const std::unique_ptr<rover::Rover> rover_;
  const SlopeWay way_;
  const double window_m_;
  double error_sum_m_ = 0.0;
  SlopePoint point_;
};

}  // namespace

SlopePoint DriveSlope(const rover::RoverParams& params, const terrain::SoilParams& soil,
                      double slope_rad, SlopeWay way) {
  return SlopeDrive(params, soil, slope_rad, way).Run();
}

rover::RoverParams Loaded(const rover::RoverParams& params, double factor) {
  rover::RoverParams loaded = params;
  for (double* mass_kg : {&loaded.mass.total_kg, &loaded.mass.wheel_kg, &loaded.mass.rocker_kg,
                          &loaded.mass.bogie_kg}) {
    *mass_kg *= factor;
  }
  return loaded;
}

}  // namespace rockyard::campaign
