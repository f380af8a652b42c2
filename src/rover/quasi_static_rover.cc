#include "rover/quasi_static_rover.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "rover/rover_geometry.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using messages::kWheelCount;

// Contacts are looked for this far beyond what a wheel travels in one stretch, m.
constexpr double kReach_m = 0.01;
// Longest movement of R's origin and largest turn in one stretch, as multiples of what the wheels
// would do: a rover that falls does so in several stretches.
constexpr double kMostMove = 2.0;
constexpr double kMostTurn_rad = 0.1;
// A change of steering below this keeps the stretch, rad.
constexpr double kSameSteer_rad = 0.017;
// Settling: most steps, longest movement in one, and the movement that ends it, m.
constexpr int kSettleSteps = 200;
constexpr double kSettleMove_m = 0.02;
constexpr double kSettled_m = 1e-6;

// Scales rates so that nothing moves further than allowed within the time.
void Limit(double time_s, double most_m, double most_rad, LinkageVector& rates) {
  const double move_m = time_s * rates.head<3>().norm();
  const double turn_rad = time_s * rates.tail<6>().cwiseAbs().maxCoeff();
  const double scale = std::max({1.0, move_m / most_m, turn_rad / most_rad});
  rates /= scale;
}

double TurnArm(const RoverGeometry& geometry) {
  double arm_m = 0.0;
  for (const Vector3& wheel_R : geometry.wheel_R) {
    arm_m = std::max(arm_m, wheel_R.head<2>().norm());
  }
  return arm_m;
}

}  // namespace

QuasiStaticRover::QuasiStaticRover(const RoverParams& params, const terrain::Terrain& terrain)
    : params_(params),
      steered_(MakeRoverGeometry(params.geometry).steered),
      turn_arm_m_(TurnArm(MakeRoverGeometry(params.geometry))),
      terrain_(terrain),
      linkage_(params),
      contacts_(params.geometry, terrain),
      balance_(params, terrain.ground().soil()) {}

Posture QuasiStaticRover::LiftedPosture(const math::Pose2& X_WR) const {
  const terrain::Ground& ground = terrain_.ground();
  const Vector3 up = ground.Normal(X_WR.x_m, X_WR.y_m);
  const Vector3 heading(std::cos(X_WR.heading_rad), std::sin(X_WR.heading_rad), 0.0);
  const Vector3 forward = (heading - heading.dot(up) / up.z() * Vector3::UnitZ()).normalized();
  Eigen::Matrix3d R;
  R << forward, up.cross(forward), up;
  double rise_m = 0.0;
  std::vector<int> rocks;
  const RoverGeometryParams& size = params_.geometry;
  terrain_.RocksNear(X_WR.x_m, X_WR.y_m, std::hypot(0.5 * size.length_m, 0.5 * size.width_m),
                     rocks);
  for (const int index : rocks) {
    const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(index)];
    const double ground_m = ground.Height(rock.center_W.x(), rock.center_W.y());
    rise_m = std::max(rise_m, rock.center_W.z() + rock.semi_axes_m.z() - ground_m);
  }
  Posture posture;
  posture.p_WR = Vector3(X_WR.x_m, X_WR.y_m, ground.Height(X_WR.x_m, X_WR.y_m)) + rise_m * up;
  posture.q_WR = Eigen::Quaterniond(R);
  return posture;
}

void QuasiStaticRover::Place(const math::Pose2& X_WR) {
  state_.steer_rad.fill(0.0);
  posture_ = LiftedPosture(X_WR);
  contacts_.Clear();
  Settle();
  stretch_ = {};
  UpdatePosture();
  UpdateForces();
  Rest();
}

void QuasiStaticRover::Settle() {
  rates_.setZero();
  const double time_s = params_.quasi_static.settle_distance_m / params_.drive.speed_m_s;
  for (int i = 0; i < kSettleSteps; ++i) {
    linkage_.Update(posture_, state_.steer_rad);
    contacts_.Update(linkage_, kReach_m + kSettleMove_m);
    balance_.Solve(linkage_, posture_, {{}, time_s, Freedom::kSettling}, contacts_.contacts(),
                   rates_);
    Limit(time_s, kSettleMove_m, kMostTurn_rad, rates_);
    posture_ = Moved(posture_, rates_, time_s);
    if (time_s * rates_.cwiseAbs().maxCoeff() < kSettled_m) break;
  }
  rates_.setZero();
}

void QuasiStaticRover::Steer(const messages::PerWheel<double>& wanted_rad) {
  const double most_rad = params_.drive.steer_rate_rad_s * step_s();
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const double limit = steered_[i] ? params_.drive.max_steer_rad : 0.0;
    const double wanted = std::clamp(wanted_rad[i], -limit, limit);
    state_.steer_rad[i] += std::clamp(wanted - state_.steer_rad[i], -most_rad, most_rad);
  }
}

void QuasiStaticRover::Rest() {
  state_.v_WR_m_s.setZero();
  state_.w_WR_rad_s.setZero();
  for (truth::BodyContact& contact : state_.contacts) contact.sliding_speed_m_s = 0.0;
}

// The stretch goes on where neither wheels nor steering have changed.
bool QuasiStaticRover::Goes(const messages::WheelCommand& command) const {
  if (stretch_.duration_s == 0.0 || command.rate_rad_s != stretch_.rate_rad_s) return false;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    if (std::abs(state_.steer_rad[i] - stretch_.steer_rad[i]) > kSameSteer_rad) return false;
  }
  return true;
}

double QuasiStaticRover::StretchTime_s(const messages::PerWheel<double>& rate_rad_s) const {
  double rate = 0.0;
  for (const double wheel_rate : rate_rad_s) rate = std::max(rate, std::abs(wheel_rate));
  const double rim_m_s = rate * params_.geometry.wheel_radius_m;
  const double way_m = std::min(params_.quasi_static.settle_distance_m,
                                params_.quasi_static.settle_turn_rad * turn_arm_m_);
  return way_m / rim_m_s;
}

void QuasiStaticRover::Plan(const messages::PerWheel<double>& rate_rad_s) {
  stretch_.from = posture_;
  stretch_.duration_s = StretchTime_s(rate_rad_s);
  stretch_.elapsed_s = 0.0;
  stretch_.rate_rad_s = rate_rad_s;
  stretch_.steer_rad = state_.steer_rad;
  linkage_.Update(posture_, state_.steer_rad);
  contacts_.Update(linkage_, params_.quasi_static.settle_distance_m + kReach_m);
  balance_.Solve(linkage_, posture_, {rate_rad_s, stretch_.duration_s, Freedom::kAll},
                 contacts_.contacts(), rates_);
  if (!rates_.allFinite()) throw std::runtime_error("no balance of forces with finite rates");
  Limit(stretch_.duration_s, kMostMove * params_.quasi_static.settle_distance_m, kMostTurn_rad,
        rates_);
  stretch_.to = Moved(posture_, rates_, stretch_.duration_s);
  state_.v_WR_m_s = rates_.head<3>();
  state_.w_WR_rad_s = rates_.segment<3>(3);
  UpdateForces();
}

void QuasiStaticRover::Step(const messages::WheelCommand& command) {
  Steer(command.steer_rad);
  const bool turning = std::any_of(command.rate_rad_s.begin(), command.rate_rad_s.end(),
                                   [](double rate) { return rate != 0.0; });
  if (!turning) return Rest();
  if (!Goes(command)) Plan(command.rate_rad_s);
  double left_s = step_s();
  while (stretch_.elapsed_s + left_s >= stretch_.duration_s) {
    left_s -= stretch_.duration_s - stretch_.elapsed_s;
    posture_ = stretch_.to;
    Plan(command.rate_rad_s);
  }
  stretch_.elapsed_s += left_s;
  posture_ = Between(stretch_.from, stretch_.to, stretch_.elapsed_s / stretch_.duration_s);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    state_.wheel_angle_rad[i] += step_s() * command.rate_rad_s[i];
  }
  UpdatePosture();
}

void QuasiStaticRover::UpdatePosture() {
  state_.X_WR.linear() = posture_.q_WR.toRotationMatrix();
  state_.X_WR.translation() = posture_.p_WR;
  state_.left_rocker_rad = posture_.rocker_rad;
  state_.right_rocker_rad = -posture_.rocker_rad;
  state_.left_bogie_rad = posture_.bogie_rad[0];
  state_.right_bogie_rad = posture_.bogie_rad[1];
}

void QuasiStaticRover::UpdateForces() {
  state_.contacts.clear();
  state_.wheel_load_N.fill(0.0);
  for (const RestingContact& contact : contacts_.contacts()) {
    if (contact.load_N <= 0.0) continue;
    if (contact.IsWheel()) {
      state_.wheel_load_N[static_cast<std::size_t>(contact.part)] += contact.load_N;
    } else {
      state_.contacts.push_back(
          {contact.kind, std::max(contact.other, -1), contact.load_N, contact.sliding_speed_m_s});
    }
  }
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    state_.motor_torque_Nm[i] = balance_.MotorTorque_Nm(i);
  }
}

}  // namespace rockyard::rover
