#include "vision/lens.h"

#include <algorithm>
#include <numbers>

#include "math/functions.h"

namespace rockyard::vision {
namespace {

using math::Vector3;
using messages::Lens;

struct LensAngles {
  double a_rad = 0.0;  // to the right
  double b_rad = 0.0;  // downwards
};

// Returns what the lens makes of a direction. Must stay the inverse of PixelRay below.
std::optional<LensAngles> Angles(Lens lens, const Vector3& p) {
  const double aside_m = math::Hypot(p.y(), p.z());
  switch (lens) {
    // The row's plane holds the lateral axis: b = atan2(-z, x) is its depression, a the angle of
    // the direction out of the vertical plane through x.
    case Lens::kEquidistantRows: {
      const double in_row_m = math::Hypot(p.x(), p.z());
      if (in_row_m == 0.0) return std::nullopt;
      return LensAngles{math::Atan2(-p.y(), in_row_m), math::Atan2(-p.z(), p.x())};
    }
    case Lens::kEquidistant: {
      if (aside_m == 0.0) return p.x() > 0.0 ? std::optional(LensAngles{}) : std::nullopt;
      // r = f theta: the angle from the axis, divided over y and z as the direction is.
      const double share = math::Atan2(aside_m, p.x()) / aside_m;
      return LensAngles{-share * p.y(), -share * p.z()};
    }
    case Lens::kPinhole:
      break;
  }
  if (p.x() <= 0.0) return std::nullopt;
  // r = f tan(theta).
  return LensAngles{-p.y() / p.x(), -p.z() / p.x()};
}

}  // namespace

Vector3 PixelRay(const messages::Camera& camera, const PixelPosition& pixel) {
  const double a_rad = pixel.column_px * camera.column_pitch_rad;
  const double b_rad = pixel.row_px * camera.row_pitch_rad;
  switch (camera.lens) {
    // Down by b about the lateral axis, then by a out of that plane to the right.
    case Lens::kEquidistantRows:
      return {math::Cos(a_rad) * math::Cos(b_rad), -math::Sin(a_rad),
              -math::Cos(a_rad) * math::Sin(b_rad)};
    case Lens::kEquidistant: {
      const double theta_rad = math::Hypot(a_rad, b_rad);
      // sin(theta) / theta, 1 on the axis.
      const double share = theta_rad > 0.0 ? math::Sin(theta_rad) / theta_rad : 1.0;
      return {math::Cos(theta_rad), -share * a_rad, -share * b_rad};
    }
    case Lens::kPinhole:
      break;
  }
  return Vector3(1.0, -a_rad, -b_rad).normalized();
}

std::optional<PixelPosition> Project(const messages::Camera& camera, const Vector3& p_C) {
  const std::optional<LensAngles> angles = Angles(camera.lens, p_C);
  if (!angles) return std::nullopt;
  return PixelPosition{angles->a_rad / camera.column_pitch_rad,
                       angles->b_rad / camera.row_pitch_rad};
}

double ImageOfAngle(Lens lens, double angle_rad) {
  return lens == Lens::kPinhole ? math::Tan(angle_rad) : angle_rad;
}

bool HasDirections(Lens lens, double half_width_rad, double half_height_rad) {
  switch (lens) {
    case Lens::kEquidistantRows:
      return std::max(half_width_rad, half_height_rad) <= 0.5 * std::numbers::pi;
    case Lens::kEquidistant:
      return math::Hypot(half_width_rad, half_height_rad) < std::numbers::pi;
    case Lens::kPinhole:
      break;
  }
  return true;
}

}  // namespace rockyard::vision
