#include "rendering/rover_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// The part of a ray that lies within all slabs and cylinders so far, and the normal where it
// enters.
struct Inside {
  double enter_m = -RoverBody::kFree;
  double leave_m = RoverBody::kFree;
  Vector3 normal_R = Vector3::Zero();

  void Clip(double enter, double leave, const Vector3& normal) {
    if (enter > enter_m) {
      enter_m = enter;
      normal_R = normal;
    }
    leave_m = std::min(leave_m, leave);
  }
  void ClipToSlab(int axis, double position, double direction, double low, double high) {
    if (direction == 0.0) {
      if (position < low || position > high) leave_m = -RoverBody::kFree;
      return;
    }
    // The slab method (Kay and Kajiya 1986): distances to both planes; a convex body is the common
    // part of its slabs, entered at the last entry and left at the first exit.
    const double a = (low - position) / direction;
    const double b = (high - position) / direction;
    Vector3 normal = Vector3::Zero();
    // The face through which the ray enters looks against it.
    normal[axis] = direction > 0.0 ? -1.0 : 1.0;
    Clip(std::min(a, b), std::max(a, b), normal);
  }
  // The ray enters ahead of its origin, and before it leaves.
  bool IsEntered() const { return enter_m > 0.0 && enter_m < leave_m; }
};

}  // namespace

RoverBody::RoverBody(std::vector<Box> boxes, std::vector<Wheel> wheels)
    : boxes_(std::move(boxes)), wheels_(std::move(wheels)) {
  EXPECT(!boxes_.empty());
  // One box, and one ball, around all parts.
  bounds_ = boxes_.front();
  for (const Box& box : boxes_) {
    bounds_.low_R = bounds_.low_R.cwiseMin(box.low_R);
    bounds_.high_R = bounds_.high_R.cwiseMax(box.high_R);
  }
  for (const Wheel& wheel : wheels_) {
    const Vector3 reach(wheel.radius_m, wheel.half_width_m, wheel.radius_m);
    bounds_.low_R = bounds_.low_R.cwiseMin(wheel.center_R - reach);
    bounds_.high_R = bounds_.high_R.cwiseMax(wheel.center_R + reach);
  }
  center_R_ = 0.5 * (bounds_.low_R + bounds_.high_R);
  radius_m_ = 0.5 * (bounds_.high_R - bounds_.low_R).norm();
}

// Returns whether the ray misses the box around all parts, as most rays do.
bool RoverBody::PassesBy(const Vector3& origin_R, const Vector3& direction_R) const {
  Inside inside;
  for (int axis = 0; axis < 3; ++axis) {
    inside.ClipToSlab(axis, origin_R[axis], direction_R[axis], bounds_.low_R[axis],
                      bounds_.high_R[axis]);
  }
  return inside.leave_m < 0.0 || inside.enter_m > inside.leave_m;
}

RoverBody::Entry RoverBody::Enter(const Box& box, const Vector3& origin_R,
                                  const Vector3& direction_R) {
  Inside inside;
  for (int axis = 0; axis < 3; ++axis) {
    inside.ClipToSlab(axis, origin_R[axis], direction_R[axis], box.low_R[axis], box.high_R[axis]);
  }
  if (!inside.IsEntered()) return {};
  return {inside.enter_m, inside.normal_R};
}

RoverBody::Entry RoverBody::Enter(const Wheel& wheel, const Vector3& origin_R,
                                  const Vector3& direction_R) {
  const Vector3 p = origin_R - wheel.center_R;
  Inside inside;
  inside.ClipToSlab(1, p.y(), direction_R.y(), -wheel.half_width_m, wheel.half_width_m);
  // |p + t d| = radius in the wheel's plane, x and z: a t^2 + 2 b t + c = 0.
  const double a = direction_R.x() * direction_R.x() + direction_R.z() * direction_R.z();
  const double b = p.x() * direction_R.x() + p.z() * direction_R.z();
  const double c = p.x() * p.x() + p.z() * p.z() - wheel.radius_m * wheel.radius_m;
  if (a > 0.0) {
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return {};
    const double root = std::sqrt(discriminant);
    const double enter_m = (-b - root) / a;
    const Vector3 rim = p + enter_m * direction_R;
    inside.Clip(enter_m, (-b + root) / a, Vector3(rim.x(), 0.0, rim.z()) / wheel.radius_m);
  } else if (c > 0.0) {  // along the axle, outside the cylinder
    return {};
  }
  if (!inside.IsEntered()) return {};
  return {inside.enter_m, inside.normal_R};
}

RoverBody::Entry RoverBody::First(const Vector3& origin_R, const Vector3& direction_R) const {
  Entry first;
  if (PassesBy(origin_R, direction_R)) return first;
  const auto consider = [&first](const Entry& entry) {
    // Parts are few: the nearest entry of all.
    if (entry.distance_m < first.distance_m) first = entry;
  };
  for (const Box& box : boxes_) consider(Enter(box, origin_R, direction_R));
  for (const Wheel& wheel : wheels_) consider(Enter(wheel, origin_R, direction_R));
  return first;
}

double RoverBody::Distance(const Vector3& origin_R, const Vector3& direction_R) const {
  return First(origin_R, direction_R).distance_m;
}

Vector3 RoverBody::Normal(const Vector3& origin_R, const Vector3& direction_R) const {
  const Entry first = First(origin_R, direction_R);
  // A ray that meets nothing has no normal: one that looks back along it stands for it.
  return first.distance_m < kFree ? first.normal_R : Vector3(-direction_R);
}

}  // namespace rockyard::rendering
