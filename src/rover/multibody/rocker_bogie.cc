#include "rover/multibody/rocker_bogie.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/check.h"
#include "math/functions.h"
#include "rover/rover_layout_params.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using messages::kWheelCount;

// Faster than any rover of ours falls or drives, m/s: the solution has blown up, and the trial is a
// simulator fault, which no rate counts.
constexpr double kFastest_m_s = 5.0;

// Settling: each step keeps this share of the velocities, so that the rover sinks gently; it ends
// once the rover is this slow for that many steps, or after so much time.
constexpr double kSettleDamping = 0.8;
constexpr double kSettled_m_s = 1e-3;
constexpr int kSettledSteps = 5;
constexpr double kSettleTime_s = 5.0;
// Friction that sweeps leave open while the rover settles stays in its stance.
constexpr int kSettlePatience = 2;
// Spacing of the points at which Place looks for what lies beneath, m.
constexpr double kProbe_m = 0.03;

// A rectangle in R, and how high what stands on it is above R's x-y plane.
struct Footprint {
  double x_m, y_m, half_length_m, half_width_m, clearance_m;
};

// Returns by how much the terrain rises above the clearance over R's x-y plane, 0 at least.
double RiseBelow(const Footprint& area, const math::Transform& X_WR,
                 const terrain::Terrain& terrain) {
  const Vector3 up = X_WR.linear().col(2);
  // A grid of points no farther apart than kProbe_m, borders included.
  const int nx = static_cast<int>(std::ceil(2.0 * area.half_length_m / kProbe_m));
  const int ny = static_cast<int>(std::ceil(2.0 * area.half_width_m / kProbe_m));
  double rise_m = 0.0;
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      const Vector3 p_R(area.x_m + area.half_length_m * (2.0 * i / nx - 1.0),
                        area.y_m + area.half_width_m * (2.0 * j / ny - 1.0), 0.0);
      const Vector3 p_W = X_WR * p_R;
      // Rise over the plane along its normal, to first order in the slope.
      const double height_m = (terrain.Height(p_W.x(), p_W.y()) - p_W.z()) * up.z();
      rise_m = std::max(rise_m, height_m - area.clearance_m);
    }
  }
  return rise_m;
}

}  // namespace

RockerBogie::RockerBogie(const RoverParams& params, const terrain::Terrain& terrain)
    : params_(params),
      steered_(MakeRoverGeometry(params.geometry).steered),
      terrain_(terrain),
      body_(params),
      inertia_(params),
      finder_(params.geometry, terrain),
      solver_(params, terrain.ground().soil()),
      motors_(params) {
  if (params.physics.dynamics == Dynamics::kBullet) bullet_.emplace(params);
}

RockerBogie::RockerBogie(const RoverParams& params, const terrain::RockHoldingParams& holding,
                         terrain::Terrain& terrain)
    : RockerBogie(params, terrain) {
  loose_rocks_.emplace(holding, params.physics.gravity_m_s2, params.physics.step_s, terrain);
}

math::Transform RockerBogie::LiftedPose(const math::Pose2& X_WR) const {
  const terrain::Ground& ground = terrain_.ground();
  const Vector3 up = ground.Normal(X_WR.x_m, X_WR.y_m);
  const Vector3 heading(math::Cos(X_WR.heading_rad), math::Sin(X_WR.heading_rad), 0.0);
  // `forward` lies in the ground's tangent plane, forward . up = 0, and keeps its heading as seen
  // from above.
  Vector3 forward = heading - heading.dot(up) / up.z() * Vector3::UnitZ();
  forward.normalize();
  math::Transform X = math::Transform::Identity();
  X.linear() << forward, up.cross(forward), up;
  X.translation() = Vector3(X_WR.x_m, X_WR.y_m, ground.Height(X_WR.x_m, X_WR.y_m));

  const RoverGeometryParams& size = params_.geometry;
  double rise_m = RiseBelow(
      {0.0, 0.0, 0.5 * size.belly_length_m, 0.5 * size.belly_width_m, size.belly_clearance_m}, X,
      terrain_);
  for (const Vector3& wheel_R : MakeRoverGeometry(size).wheel_R) {
    rise_m = std::max(rise_m, RiseBelow({wheel_R.x(), wheel_R.y(), size.wheel_radius_m,
                                         0.5 * size.width_m - size.arm_y_m, 0.0},
                                        X, terrain_));
  }
  X.translation() += rise_m * up;
  return X;
}

void RockerBogie::Place(const math::Pose2& X_WR) {
  angle_at_place_rad_ = state_.wheel_angle_rad;
  body_.Reset(LiftedPose(X_WR));
  for (std::size_t i = 0; i < kWheelCount; ++i) SetSteer(i, 0.0);
  body_.UpdatePoses();
  finder_.Clear();
  solver_.Clear();
  if (loose_rocks_) loose_rocks_->Clear();
  motors_.Reset();
  commanded_rad_s_.fill(0.0);
  short_steps_left_ = 0;
  Settle();
  body_.StopMotion();
  // What the wheels turned while settling is not driving: it is taken off the angle.
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    angle_at_place_rad_[i] -= body_.JointAngle(kFirstWheel + static_cast<int>(i));
  }
  UpdateState();
}

// The rover sinks onto its contacts with braked wheels; velocities are damped from step to step,
// which leaves the loads as they are at rest.
void RockerBogie::Settle() {
  const messages::PerWheel<double> braked{};
  const int steps = static_cast<int>(kSettleTime_s / params_.physics.step_s);
  int slow_steps = 0;
  for (int i = 0; i < steps && slow_steps < kSettledSteps; ++i) {
    Advance(braked, 1, kSettlePatience);
    const DofVector velocity = body_.Velocity();
    // v <- 0.8 v.
    body_.AddVelocity((kSettleDamping - 1.0) * velocity);
    slow_steps = velocity.head<6>().norm() < kSettled_m_s ? slow_steps + 1 : 0;
  }
}

void RockerBogie::SetSteer(std::size_t wheel, double angle_rad) {
  body_.SetSteer(wheel, angle_rad);
  state_.steer_rad[wheel] = angle_rad;
}

void RockerBogie::Step(const messages::WheelCommand& command) {
  // Steering follows at its rate limit, without torque.
  const double max_rad = params_.drive.steer_rate_rad_s * step_s();
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const double limit = steered_[i] ? params_.drive.max_steer_rad : 0.0;
    const double wanted = std::clamp(command.steer_rad[i], -limit, limit);
    const double change = std::clamp(wanted - state_.steer_rad[i], -max_rad, max_rad);
    if (change != 0.0) SetSteer(i, state_.steer_rad[i] + change);
  }
  const int substeps = Substeps(command.rate_rad_s);
  for (int i = 0; i < substeps; ++i) Advance(command.rate_rad_s, substeps, 1);
  UpdateState();
}

// Motors that accelerate harder than this share of gravity make wheels slide, and what a rover
// loses by that hangs on when within a step the sliding ends. Gentler ramps need no shorter steps:
// see the table of stops and starts in README.md of src/rover.
int RockerBogie::Substeps(const messages::PerWheel<double>& commanded_rad_s) {
  constexpr double kGentle = 0.25;
  constexpr int kSubsteps = 16;
  const double speed_m_s = params_.drive.speed_m_s * params_.physics.time_scale;
  const double gentle_m_s2 = kGentle * params_.physics.gravity_m_s2;
  if (speed_m_s <= gentle_m_s2 * params_.drive.ramp_s) return 1;
  // Where wheels slip much, the body takes this many times as long as a gentle ramp to come to
  // their speed.
  constexpr double kLongest = 3.0;
  if (commanded_rad_s != commanded_rad_s_) {
    const double time_s = kLongest * speed_m_s / gentle_m_s2 + params_.drive.ramp_s;
    short_steps_left_ = static_cast<int>(std::ceil(time_s / params_.physics.step_s));
  }
  commanded_rad_s_ = commanded_rad_s;
  if (short_steps_left_ == 0) return 1;
  --short_steps_left_;
  return kSubsteps;
}

// Advances one part of a step (semi-implicit Euler): v* = v + h M^-1 f, impulses of all constraints
// on v*, positions with the new v.
void RockerBogie::Advance(const messages::PerWheel<double>& commanded_rad_s, int parts,
                          int patience) {
  const double h = params_.physics.step_s / parts;
  MotorRates rates = motors_.Advance(commanded_rad_s, h);
  // One physics step stands for time_scale steps of real time: rates are as many times faster
  // inside.
  for (double& rate : rates.from) rate *= params_.physics.time_scale;
  for (double& rate : rates.to) rate *= params_.physics.time_scale;
  body_.UpdatePoses();
  finder_.Update(body_);
  const DofVector before = body_.Velocity();
  inertia_.Update(body_);
  const double gravity_m_s2 = params_.physics.gravity_m_s2;
  if (bullet_) {
    bullet_->Take(body_);
    body_.AddVelocity(bullet_->Fall(gravity_m_s2, h));
  } else {
    body_.AddVelocity(h * inertia_.Accelerations(body_.FreeForce(gravity_m_s2)));
  }
  solver_.Solve({inertia_, before, rates, h, patience}, loose_rocks_ ? &*loose_rocks_ : nullptr,
                finder_, body_);
  CheckMotion(body_.Velocity());
  body_.Move(h);
  if (loose_rocks_) loose_rocks_->Move(finder_);
}

void RockerBogie::CheckMotion(const DofVector& velocity) const {
  // Written so that a velocity that is not a number fails, too.
  if (velocity.segment<3>(3).squaredNorm() < kFastest_m_s * kFastest_m_s && velocity.allFinite()) {
    return;
  }
  throw std::runtime_error("the rover's motion blew up: velocity (" + std::to_string(velocity[3]) +
                           ", " + std::to_string(velocity[4]) + ", " + std::to_string(velocity[5]) +
                           ") m/s");
}

void RockerBogie::UpdateState() {
  body_.UpdatePoses();
  const DofVector velocity = body_.Velocity() / params_.physics.time_scale;
  state_.X_WR = body_.X_WR();
  state_.w_WR_rad_s = velocity.head<3>();
  // From the chassis' centre of mass C to R's origin: v_R = v_C + w x (p_R - p_C), all in W.
  // Velocities are reported in real time.
  state_.v_WR_m_s = velocity.segment<3>(3) +
                    state_.w_WR_rad_s.cross(body_.X_WR().translation() - body_.p_WComChassis());
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    state_.wheel_angle_rad[i] =
        angle_at_place_rad_[i] + body_.JointAngle(kFirstWheel + static_cast<int>(i));
    state_.motor_torque_Nm[i] = solver_.MotorTorque_Nm(i);
  }
  state_.left_rocker_rad = body_.JointAngle(kLeftRocker);
  state_.right_rocker_rad = body_.JointAngle(kRightRocker);
  state_.left_bogie_rad = body_.JointAngle(kLeftBogie);
  state_.right_bogie_rad = body_.JointAngle(kRightBogie);
  UpdateContacts(velocity);
}

void RockerBogie::UpdateContacts(const DofVector& velocity) {
  state_.contacts.clear();
  state_.wheel_load_N.fill(0.0);
  state_.wheel_sinkage_m.fill(0.0);
  const math::Transform X_RW = state_.X_WR.inverse(Eigen::Isometry);
  for (const Contact& contact : finder_.contacts()) {
    // Mean force over the step: impulse over h.
    const double force_N = contact.impulse_Ns[0] / solver_.step_s();
    if (force_N <= 0.0) continue;
    const Part& part = finder_.part(contact.part);
    if (part.kind == truth::BodyPart::kWheel) {
      const auto wheel = static_cast<std::size_t>(contact.part);
      state_.wheel_load_N[wheel] += force_N;
      // The soil's share of the penetration; the rest is that of the contact's spring.
      const double spring_m = force_N / params_.contact.stiffness_N_m;
      if (contact.IsSoil()) {
        state_.wheel_sinkage_m[wheel] = std::max(0.0, -contact.gap_m - spring_m);
      }
      continue;
    }
    DofVector along, across;
    body_.FillJacobian(part.body, contact.p_W, contact.along_W, along);
    body_.FillJacobian(part.body, contact.p_W, contact.across_W, across);
    state_.contacts.push_back({part.kind, contact.other >= 0 ? contact.other : -1, force_N,
                               math::Hypot(along.dot(velocity), across.dot(velocity)),
                               contact.n_W.z(), X_RW * contact.p_W});
  }
}

}  // namespace rockyard::rover
