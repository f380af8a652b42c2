#include "rendering/cylinder/coloured_body.h"

#include <cmath>
#include <limits>

namespace rockyard::rendering {
namespace {

using math::Vector3;

// The smaller root of a t^2 + 2 b t + c = 0 that lies ahead; nothing where the line misses.
std::optional<double> FirstRoot(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (a <= 0.0 || discriminant < 0.0) return std::nullopt;
  const double root = (-b - std::sqrt(discriminant)) / a;
  if (root <= 0.0) return std::nullopt;
  return root;
}

}  // namespace

BodyCaster::BodyCaster(ColouredBody body)
    : body_(body), cosine_(std::cos(body.heading_rad)), sine_(std::sin(body.heading_rad)) {}

std::array<Vector3, 8> BodyCaster::Corners() const {
  std::array<Vector3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double x = (i & 1U) != 0U ? body_.half.x() : -body_.half.x();
    const double y = (i & 2U) != 0U ? body_.half.y() : -body_.half.y();
    const double z = (i & 4U) != 0U ? body_.half.z() : -body_.half.z();
    corners[i] = body_.middle_L + Vector3(cosine_ * x - sine_ * y, sine_ * x + cosine_ * y, z);
  }
  return corners;
}

std::optional<BodyHit> BodyCaster::Cast(const ColourRay& ray) const {
  const auto turned = [this](const Vector3& v) {
    return Vector3(cosine_ * v.x() + sine_ * v.y(), cosine_ * v.y() - sine_ * v.x(), v.z());
  };
  const ColourRay ray_B{turned(ray.origin - body_.middle_L), turned(ray.direction)};
  std::optional<BodyHit> hit;
  switch (body_.shape) {
    case BodyShape::kEllipsoid:
      hit = CastEllipsoid(ray_B);
      break;
    case BodyShape::kBox:
      hit = CastBox(ray_B);
      break;
    case BodyShape::kCylinder:
      hit = CastCylinder(ray_B);
      break;
  }
  if (hit) {
    const Vector3 n = hit->normal;
    hit->normal = {cosine_ * n.x() - sine_ * n.y(), sine_ * n.x() + cosine_ * n.y(), n.z()};
  }
  return hit;
}

// |(o + t d) / h|^2 = 1; the normal is along p / h^2.
std::optional<BodyHit> BodyCaster::CastEllipsoid(const ColourRay& ray_B) const {
  const Vector3 o = ray_B.origin.cwiseQuotient(body_.half);
  const Vector3 d = ray_B.direction.cwiseQuotient(body_.half);
  const auto along = FirstRoot(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1.0);
  if (!along) return std::nullopt;
  const Vector3 normal = (o + *along * d).cwiseQuotient(body_.half).normalized();
  return BodyHit{*along, normal, 0};
}

// The last of the three slabs that the ray enters, unless it has left another before.
std::optional<BodyHit> BodyCaster::CastBox(const ColourRay& ray_B) const {
  double entered = 0.0;
  double left = std::numeric_limits<double>::infinity();
  int face = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = ray_B.direction[axis];
    if (speed == 0.0) {
      if (std::abs(ray_B.origin[axis]) > body_.half[axis]) return std::nullopt;
      continue;
    }
    const double reach = std::copysign(body_.half[axis], speed);
    const double in = (-reach - ray_B.origin[axis]) / speed;
    if (in > entered) {
      entered = in;
      face = 2 * axis + (speed > 0.0 ? 0 : 1);
    }
    left = std::fmin(left, (reach - ray_B.origin[axis]) / speed);
  }
  if (face < 0 || entered > left) return std::nullopt;
  Vector3 normal = Vector3::Zero();
  normal[face / 2] = face % 2 == 0 ? -1.0 : 1.0;
  return BodyHit{entered, normal, face};
}

std::optional<BodyHit> BodyCaster::CastCylinder(const ColourRay& ray_B) const {
  const Vector3& o = ray_B.origin;
  const Vector3& d = ray_B.direction;
  const double radius_m = body_.half.x();
  const auto wall = FirstRoot(d.x() * d.x() + d.y() * d.y(), o.x() * d.x() + o.y() * d.y(),
                              o.x() * o.x() + o.y() * o.y() - radius_m * radius_m);
  if (!wall) return std::nullopt;
  const Vector3 p = o + *wall * d;
  if (std::abs(p.z()) <= body_.half.z()) {
    // Quadrant q lies between the azimuths 90 q and 90 (q + 1) deg of the cylinder.
    const int quadrant = p.y() >= 0.0 ? (p.x() > 0.0 ? 0 : 1) : (p.x() < 0.0 ? 2 : 3);
    return BodyHit{*wall, {p.x() / radius_m, p.y() / radius_m, 0.0}, quadrant};
  }
  if (p.z() < 0.0 || d.z() >= 0.0) return std::nullopt;
  const double along = (body_.half.z() - o.z()) / d.z();
  const Vector3 on_top = o + along * d;
  if (std::hypot(on_top.x(), on_top.y()) > radius_m) return std::nullopt;
  return BodyHit{along, Vector3::UnitZ(), 4};
}

}  // namespace rockyard::rendering
