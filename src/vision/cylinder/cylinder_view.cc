#include "vision/cylinder/cylinder_view.h"

#include <cmath>
#include <numbers>

namespace rockyard::vision {
namespace {

constexpr double kQuadrant_rad = 0.5 * std::numbers::pi;

// Where the wall's line at this direction (of length 1, off the axis) is imaged.
std::optional<WallLine> LineAt(const CameraModel& camera, const CylinderPlace& place,
                               const math::Vector3& direction, const math::Vector3& half_axis_m) {
  const math::Vector3 middle = place.p_LT_L + place.radius_m * direction;
  const auto upper = Project(camera, middle + half_axis_m);
  const auto lower = Project(camera, middle - half_axis_m);
  if (!upper || !lower) return std::nullopt;
  const double rows = lower->y() - upper->y();
  if (std::abs(rows) < 1e-9) return std::nullopt;
  const Pixel mean = 0.5 * (*upper + *lower);
  return WallLine{mean.x(), mean.y(), (lower->x() - upper->x()) / rows};
}

}  // namespace

std::optional<WallView> WallSeen(const CameraModel& camera, const EyeGeometry& eyes,
                                 const CylinderPlace& place, double height_m) {
  const math::Vector3& up = place.axis_L;
  // Azimuths are told from the direction to the middle between the eyes, which is theta in T.
  const math::Vector3 to_middle = AcrossAxis(eyes.middle_L - place.p_LT_L, up).normalized();
  const math::Vector3 to_side = up.cross(to_middle);
  const math::Vector3 to_eye = AcrossAxis(CentreOf(camera) - place.p_LT_L, up);
  const double distance_m = to_eye.norm();
  if (!(distance_m > place.radius_m)) return std::nullopt;
  const double eye_rad = std::atan2(to_eye.dot(to_side), to_eye.dot(to_middle));
  const double half_rad = std::acos(place.radius_m / distance_m);
  const math::Vector3 half_axis_m = 0.5 * height_m * (up + place.roll_rad * eyes.right_L);
  WallView view;
  const auto add_line = [&](double azimuth_rad) {
    const math::Vector3 direction =
        std::cos(azimuth_rad) * to_middle + std::sin(azimuth_rad) * to_side;
    const auto line = LineAt(camera, place, direction, half_axis_m);
    if (line) view.lines.push_back(*line);
    return line.has_value();
  };
  // Counter-clockwise seen from above is from left to right in the image.
  const double first_rad = eye_rad - half_rad;
  const double last_rad = eye_rad + half_rad;
  if (!add_line(first_rad)) return std::nullopt;
  int quadrant = static_cast<int>(std::floor((place.orientation_rad + first_rad) / kQuadrant_rad));
  while ((quadrant + 1) * kQuadrant_rad - place.orientation_rad < last_rad) {
    ++quadrant;
    view.quadrants.push_back((quadrant + 3) & 3);
    if (!add_line(quadrant * kQuadrant_rad - place.orientation_rad)) return std::nullopt;
  }
  view.quadrants.push_back(quadrant & 3);
  if (!add_line(last_rad)) return std::nullopt;
  return view;
}

}  // namespace rockyard::vision
