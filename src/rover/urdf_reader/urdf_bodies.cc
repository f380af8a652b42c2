#include "rover/urdf_reader/urdf_bodies.h"

#include <cmath>
#include <tuple>

#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// How far a joint's axis may lean and still count as one about y or z, and the axis of a rim
// against that of its joint.
constexpr double kLeaning_rad = math::DegToRad(5.0);
constexpr double kRimLeaning_rad = math::DegToRad(1.0);
// How far a rim's axis may be from that of its joint, as a share of its radius.
constexpr double kRimOffset = 0.02;

bool LieWithin(const Vector3& a, const Vector3& b, double angle_rad) {
  return std::abs(a.dot(b)) >= math::Cos(angle_rad);
}

}  // namespace

bool AreAlong(const Vector3& a, const Vector3& b) { return LieWithin(a, b, kLeaning_rad); }

UrdfBodies::UrdfBodies(const UrdfModel& model)
    : model_(model),
      X_0L_(LinkPoses(model)),
      body_(model.links.size()),
      carries_(model.links.size()),
      cylinders_(model.links.size()) {
  for (const std::size_t link : model.order) {
    const auto carrier = model.links[link].parent_joint;
    const bool begins = !carrier || model.joints[*carrier].kind != UrdfJointKind::kFixed;
    body_[link] = begins ? link : body_[model.joints[*carrier].parent];
    if (carrier && begins) ++carries_[body_[model.joints[*carrier].parent]];
    for (const UrdfShape& shape : model.links[link].shapes) {
      if (shape.kind == UrdfShapeKind::kCylinder) {
        cylinders_[body_[link]].push_back({link, &shape});
      }
    }
  }
}

Vector3 UrdfBodies::Axis_0(std::size_t joint) const {
  return X_0L_[model_.joints[joint].child].linear() * model_.joints[joint].axis_C;
}

bool UrdfBodies::TurnsAbout(std::size_t joint, const Vector3& axis_0) const {
  return model_.joints[joint].Turns() && AreAlong(Axis_0(joint), axis_0);
}

bool UrdfBodies::IsAbout(const Placed& placed, std::size_t joint) const {
  const math::Transform X_0S = X_0L_[placed.link] * placed.shape->X_LS;
  const Vector3 axis = Axis_0(joint);
  const Vector3 from = X_0S.translation() - X_0L_[model_.joints[joint].child].translation();
  const double off_m = (from - from.dot(axis) * axis).norm();
  return LieWithin(X_0S.linear().col(2), axis, kRimLeaning_rad) &&
         off_m <= kRimOffset * placed.shape->radius_m;
}

std::optional<UrdfRim> UrdfBodies::RimOf(std::size_t joint) const {
  const auto rank = [](const UrdfShape& shape) {
    return std::tuple(shape.use == UrdfUse::kCollision, shape.radius_m, shape.length_m);
  };
  std::optional<UrdfRim> best;
  for (const Placed& placed : cylinders_[Below(joint)]) {
    if (!IsAbout(placed, joint)) continue;
    if (best && rank(*placed.shape) <= rank(*best->shape)) continue;
    best = UrdfRim{placed.shape, X_0L_[placed.link] * placed.shape->X_LS.translation()};
  }
  return best;
}

}  // namespace rockyard::rover
