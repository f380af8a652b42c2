#include "vision/cameras/aligned_pair.h"

#include <cmath>
#include <variant>

namespace rockyard::vision {
namespace {

constexpr double kSame = 1e-9;

bool IsSame(const math::Vector3& a, const math::Vector3& b) {
  return (a - b).norm() <= kSame * a.norm();
}

}  // namespace

std::optional<RectifiedPair> AlignedPair(const CameraModel& left, const CameraModel& right) {
  const Cahv* l = std::get_if<Cahv>(&left.lens);
  const Cahv* r = std::get_if<Cahv>(&right.lens);
  if (l == nullptr || r == nullptr || left.size != right.size) return std::nullopt;
  if (!IsSame(l->A, r->A) || !IsSame(l->H, r->H) || !IsSame(l->V, r->V)) return std::nullopt;
  const math::Vector3 baseline = r->C - l->C;
  const math::Vector3 rows = l->H - l->H.dot(l->A) * l->A;  // f_h h'
  const math::Vector3 across = baseline.cross(rows);
  if (across.norm() > kSame * baseline.norm() * rows.norm()) return std::nullopt;
  if (baseline.dot(rows) <= 0.0) return std::nullopt;
  return RectifiedPair{*l, *r, left.size, rows.norm(), baseline.norm()};
}

}  // namespace rockyard::vision
