// Statics of a six-wheel rover at a vertical step across its way: how much friction it takes to get
// up, from the geometry of rigid wheels and the balance of forces alone, without the rover's code.
//
// Both sides do the same, so that chassis and rockers are one body and the bogies another, hinged
// to it: half a rover in a plane. A wheel's centre moves along the curve that lies a radius r off
// the ground, the face of the step, its edge and its top. On the edge of a step of height h the
// normal of the contact turns from acos((r - h) / r) off the vertical, a right angle from h = r on,
// to none. With the forces N_i n_i + F_i t_i on the wheels,
//   sum of forces and moments on all, and of moments about the hinge on the bogie, vanish,
// four equations for six forces. A posture holds where there is a solution with |F_i| <= mu N_i.
// The friction that a step takes is the largest, over the way up, of the least mu that holds.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "rover/rover_layout_params.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// A rover whose bogies are in front, before a step whose face stands at x = 0.
class StepStatics {
 public:
  StepStatics(const RoverParams& params, double height_m)
      : radius_m_(params.geometry.wheel_radius_m), height_m_(height_m) {
    const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
    const RoverMasses masses = MakeRoverMasses(params);
    const auto flat = [](const math::Vector3& p) { return Vector(p.x(), p.z()); };
    const double g = params.physics.gravity_m_s2;
    for (std::size_t i = 0; i < kWheels; ++i) wheel_[i] = flat(geometry.wheel_R[i]);
    hinge_ = flat(geometry.bogie_pivot_R[0]);
    const double wheel_N = g * masses.wheel.mass_kg;
    Add(0.5 * g * masses.chassis.mass_kg, flat(masses.chassis.com_B), main_);
    Add(g * masses.rocker.mass_kg, flat(geometry.rocker_pivot_R[0]), main_);
    Add(wheel_N, wheel_[2], main_);
    Add(g * masses.bogie.mass_kg, hinge_, bogie_);
    Add(wheel_N, wheel_[0], bogie_);
    Add(wheel_N, wheel_[1], bogie_);
  }

  // The least friction, of ground and step alike, with which all three axles get up.
  double LeastFriction() const {
    return OverTheWay(kWheels, [](double mu, bool) { return mu; });
  }
  // The least pull on the ground, over the load, with which so many axles get up a step of that
  // friction.
  double LeastPull(double step_friction, std::size_t axles) const {
    return OverTheWay(axles, [step_friction](double pull, bool on_ground) {
      return on_ground ? pull : step_friction;
    });
  }

 private:
  using Vector = Eigen::Vector2d;
  static constexpr std::size_t kWheels = 3;  // front, middle, rear
  static constexpr double kStart_m = -2.0;   // where the way of a wheel's centre begins
  static constexpr double kStride_m = 0.004;

  struct Weight {
    double weight_N = 0.0;
    Vector center = Vector::Zero();
  };
  // A wheel at a place of its way.
  struct Place {
    Vector center;
    Vector normal;
    enum { kGround, kClimbing, kTop } on;
  };
  struct Posture {
    std::array<Place, kWheels> wheels;
    Vector hinge;
    Vector main_center;   // of mass
    Vector bogie_center;  // of mass
  };
  // What bounds the friction of a wheel at a value of the unknown, on the ground or on the step.
  using Bound = std::function<double(double value, bool on_ground)>;

  static void Add(double weight_N, const Vector& p, Weight& body) {
    body.center = (body.weight_N * body.center + weight_N * p) / (body.weight_N + weight_N);
    body.weight_N += weight_N;
  }
  static double Cross(const Vector& a, const Vector& b) { return a.x() * b.y() - a.y() * b.x(); }
  static Vector Turned(const Vector& p, double angle_rad) {
    return Eigen::Rotation2Dd(angle_rad) * p;
  }
  static double AngleOf(const Vector& p) { return std::atan2(p.y(), p.x()); }

  // Angle of the edge's normal off the vertical, backwards, where a wheel comes to it.
  double EdgeAngle() const { return std::acos(std::max(1.0 - height_m_ / radius_m_, 0.0)); }
  double FaceLength() const { return std::max(height_m_ - radius_m_, 0.0); }
  // Way at which a wheel meets the step.
  double MeetsAt() const { return -radius_m_ * std::sin(EdgeAngle()) - kStart_m; }

  Place At(double way_m) const {
    if (way_m < MeetsAt()) return {{kStart_m + way_m, radius_m_}, {0.0, 1.0}, Place::kGround};
    double on_step_m = way_m - MeetsAt();
    if (on_step_m < FaceLength()) {
      return {{-radius_m_, radius_m_ + on_step_m}, {-1.0, 0.0}, Place::kClimbing};
    }
    on_step_m -= FaceLength();
    const double angle_rad = EdgeAngle() - on_step_m / radius_m_;
    if (angle_rad > 0.0) {
      const Vector normal(-std::sin(angle_rad), std::cos(angle_rad));
      return {Vector(0.0, height_m_) + radius_m_ * normal, normal, Place::kClimbing};
    }
    return {{-radius_m_ * angle_rad, height_m_ + radius_m_}, {0.0, 1.0}, Place::kTop};
  }

  // The way, behind `from_m`, of a wheel whose centre is as far from p as given.
  double WayBehind(double from_m, const Vector& p, double distance_m) const {
    const auto far = [&](double way_m) { return (At(way_m).center - p).norm() >= distance_m; };
    double low = from_m;
    while (!far(low)) low -= kStride_m;
    double high = low + kStride_m;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (far(middle) ? low : high) = middle;
    }
    return low;
  }

  Posture PostureAt(double front_way_m) const {
    Posture posture;
    posture.wheels[0] = At(front_way_m);
    const Vector& front = posture.wheels[0].center;
    const double middle_way_m = WayBehind(front_way_m, front, (wheel_[0] - wheel_[1]).norm());
    posture.wheels[1] = At(middle_way_m);
    const Vector& middle = posture.wheels[1].center;
    const double bogie_rad = AngleOf(front - middle) - AngleOf(wheel_[0] - wheel_[1]);
    posture.hinge = middle + Turned(hinge_ - wheel_[1], bogie_rad);
    const Vector arm = hinge_ - wheel_[2];
    posture.wheels[2] = At(WayBehind(middle_way_m, posture.hinge, arm.norm()));
    const double main_rad = AngleOf(posture.hinge - posture.wheels[2].center) - AngleOf(arm);
    posture.main_center = posture.hinge + Turned(main_.center - hinge_, main_rad);
    posture.bogie_center = posture.hinge + Turned(bogie_.center - hinge_, bogie_rad);
    return posture;
  }

  // Whether forces within the bounds hold the posture: whether a corner of the polygon does, which
  // the bounds cut out of the plane that the equations leave.
  bool Holds(const Posture& posture, double value, const Bound& bound) const {
    using Row = Eigen::Matrix<double, 1, 6>;
    Eigen::Matrix<double, 6, 6> equations = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    std::array<Row, 2 * kWheels> bounds;
    for (std::size_t i = 0; i < kWheels; ++i) {
      const Place& wheel = posture.wheels[i];
      const double mu = bound(value, wheel.on == Place::kGround);
      const Vector arm = wheel.center - radius_m_ * wheel.normal - posture.hinge;
      const std::array<Vector, 2> directions{wheel.normal,
                                             Vector(wheel.normal.y(), -wheel.normal.x())};
      for (std::size_t part = 0; part < 2; ++part) {
        const auto column = static_cast<Eigen::Index>(2 * i + part);
        equations.block<2, 1>(0, column) = directions[part];
        equations(2, column) = Cross(arm, directions[part]);
        if (i < 2) equations(3, column) = Cross(arm, directions[part]);
        // mu N + F >= 0 and mu N - F >= 0.
        Row& row = bounds[2 * i + part];
        row.setZero();
        row(static_cast<Eigen::Index>(2 * i)) = mu;
        row(static_cast<Eigen::Index>(2 * i + 1)) = part == 0 ? 1.0 : -1.0;
      }
    }
    const Vector down(0.0, -1.0);
    right(1) = main_.weight_N + bogie_.weight_N;
    right(3) = -bogie_.weight_N * Cross(posture.bogie_center - posture.hinge, down);
    right(2) = right(3) - main_.weight_N * Cross(posture.main_center - posture.hinge, down);
    for (std::size_t a = 0; a < bounds.size(); ++a) {
      for (std::size_t b = a + 1; b < bounds.size(); ++b) {
        equations.row(4) = bounds[a];
        equations.row(5) = bounds[b];
        const Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> solver(equations);
        if (!solver.isInvertible()) continue;
        const Eigen::Matrix<double, 6, 1> forces_N = solver.solve(right);
        if (std::all_of(bounds.begin(), bounds.end(),
                        [&](const Row& row) { return row.dot(forces_N) > -1e-6; })) {
          return true;
        }
      }
    }
    return false;
  }

  double OverTheWay(std::size_t axles, const Bound& bound) const {
    double least = 0.0;
    bool last = false;
    for (double way_m = MeetsAt() + 1e-6; !last; way_m += kStride_m) {
      const Posture posture = PostureAt(way_m);
      last = posture.wheels[axles - 1].on == Place::kTop;
      const bool climbs = std::any_of(posture.wheels.begin(), posture.wheels.end(),
                                      [](const Place& p) { return p.on == Place::kClimbing; });
      if (!climbs || Holds(posture, least, bound)) continue;
      double high = kMost;
      for (int i = 0; i < 16; ++i) {
        const double middle = 0.5 * (least + high);
        (Holds(posture, middle, bound) ? high : least) = middle;
      }
      least = high;
    }
    return least;
  }

  static constexpr double kMost = 2.0;

  double radius_m_;
  double height_m_;
  std::array<Vector, kWheels> wheel_;
  Vector hinge_;
  Weight main_;   // chassis, rocker, rear wheel
  Weight bogie_;  // with its wheels
};

}  // namespace rockyard::rover
