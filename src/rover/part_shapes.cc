#include "rover/part_shapes.h"

#include <algorithm>
#include <cmath>

#include "math/functions.h"
#include "rover/rover_layout_params.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using truth::BodyPart;

// Rounding of the wheels' edges as a share of the width, and of chassis and panel, m. Contacts are
// found between cores, so a margin must exceed any penetration (some 1 mm).
constexpr double kWheelRounding = 0.25;  // must equal that of WheelShape (wheel_rock_gap.cc)
constexpr double kBoxRounding_m = 0.01;

// Returns a capsule of that radius about the line from a to b, in the frame of the body.
Part Segment(BodyPart kind, int body, const Vector3& a, const Vector3& b, double radius_m) {
  return {kind,
          body,
          Core::kSegment,
          Meets::kRocks,
          a,
          b,
          radius_m,
          0.5 * (a + b),
          0.5 * (b - a).norm() + radius_m};
}

// Returns a box fixed to the chassis, with edges rounded by kBoxRounding_m: core and margin
// together fill the box.
Part Box(BodyPart kind, const Vector3& low_R, const Vector3& high_R) {
  const Vector3 center = 0.5 * (low_R + high_R);
  const Vector3 half = 0.5 * (high_R - low_R) - Vector3::Constant(kBoxRounding_m);
  return {kind,           kChassis, Core::kBox,
          Meets::kRocks,  center,   half,
          kBoxRounding_m, center,   half.norm() + kBoxRounding_m};
}

// Adds four points at the corners of a level rectangle, in R, which stand for a box against planes.
void AddCorners(BodyPart kind, double length_m, double width_m, double z_m,
                std::vector<Part>& parts) {
  for (const double x : {0.5 * length_m, -0.5 * length_m}) {
    for (const double y : {0.5 * width_m, -0.5 * width_m}) {
      const Vector3 p(x, y, z_m);
      parts.push_back({kind, kChassis, Core::kPoint, Meets::kGroundAndWalls, p, p, 0.0, p, 0.0});
    }
  }
}

void AddWheels(const RoverGeometryParams& params, std::vector<Part>& parts) {
  // Core and margin together have the wheel's radius and width, as WheelShape (wheel_rock_gap.cc).
  const double margin_m =
      std::min(kWheelRounding * params.wheel_width_m, 0.5 * params.wheel_radius_m);
  const double half_width_m = 0.5 * params.wheel_width_m - margin_m;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    parts.push_back(
        {BodyPart::kWheel, kFirstWheel + static_cast<int>(i), Core::kCylinder, Meets::kEverything,
         Vector3::Zero(), Vector3(params.wheel_radius_m - margin_m, half_width_m, 0.0), margin_m,
         Vector3::Zero(), math::Hypot(params.wheel_radius_m, 0.5 * params.wheel_width_m)});
  }
}

void AddArms(const RoverGeometryParams& params, std::vector<Part>& parts) {
  const RoverGeometry geometry = MakeRoverGeometry(params);
  const double radius_m = params.arm_radius_m;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vector3 rocker_R = geometry.rocker_pivot_R[side];
    const Vector3 bogie_R = geometry.bogie_pivot_R[side];
    const int rocker = kLeftRocker + static_cast<int>(side);
    const int bogie = kLeftBogie + static_cast<int>(side);
    parts.push_back(
        Segment(BodyPart::kRocker, rocker, Vector3::Zero(), bogie_R - rocker_R, radius_m));
    for (std::size_t i = 3 * side; i < 3 * side + 3; ++i) {
      const int body = geometry.on_bogie[i] ? bogie : rocker;
      const Vector3 pivot_R = geometry.on_bogie[i] ? bogie_R : rocker_R;
      // The hub is at the wheel's height, in the plane of the arms, beside the wheel's inner face;
      // the strut from knee to hub is vertical.
      const Vector3 hub_R(geometry.wheel_R[i].x(), pivot_R.y(), geometry.wheel_R[i].z());
      const Vector3 hub_B = hub_R - pivot_R;
      const Vector3 knee_B(hub_B.x(), 0.0, params.knee_z_m - pivot_R.z());
      parts.push_back(Segment(BodyPart::kRocker, body, Vector3::Zero(), knee_B, radius_m));
      parts.push_back(Segment(BodyPart::kRocker, body, knee_B, hub_B, radius_m));
      parts.push_back(Segment(BodyPart::kHub, body, hub_B, hub_B, params.hub_radius_m));
    }
  }
}

}  // namespace

std::vector<Part> MakeParts(const RoverGeometryParams& params) {
  std::vector<Part> parts;
  AddWheels(params, parts);
  AddArms(params, parts);
  // Must equal the panel of BodyBoxes (rover_layout_params.h), which hide the view of sensors.
  const double panel_z_m = params.height_m - 2.5 * kBoxRounding_m;
  const Vector3 belly(0.5 * params.belly_length_m, 0.5 * params.belly_width_m, 0.0);
  const Vector3 panel(0.5 * params.length_m, 0.5 * params.width_m, 0.0);
  parts.push_back(Box(BodyPart::kBelly, Vector3(0, 0, params.belly_clearance_m) - belly,
                      Vector3(0, 0, panel_z_m) + belly));
  parts.push_back(Box(BodyPart::kPanelEdge, Vector3(0, 0, panel_z_m) - panel,
                      Vector3(0, 0, params.height_m) + panel));
  AddCorners(BodyPart::kBelly, params.belly_length_m, params.belly_width_m,
             params.belly_clearance_m, parts);
  AddCorners(BodyPart::kPanelEdge, params.length_m, params.width_m, params.height_m, parts);
  return parts;
}

Vector3 NearestOnCore(const Part& part, const Vector3& p_B) {
  switch (part.core) {
    case Core::kPoint:
      return part.a_B;
    case Core::kSegment: {
      const Vector3 along = part.b_B - part.a_B;
      const double length2 = along.squaredNorm();
      if (length2 == 0.0) return part.a_B;
      return part.a_B + std::clamp((p_B - part.a_B).dot(along) / length2, 0.0, 1.0) * along;
    }
    case Core::kCylinder: {
      const double y = std::clamp(p_B.y(), -part.b_B.y(), part.b_B.y());
      const double radius = math::Hypot(p_B.x(), p_B.z());
      // Radial and axial clamps are independent: the axis of the cylinder is y.
      const double shrink = radius > part.b_B.x() ? part.b_B.x() / radius : 1.0;
      return {shrink * p_B.x(), y, shrink * p_B.z()};
    }
    // Clamping each coordinate on its own is the nearest point of a box.
    case Core::kBox:
      return part.a_B + (p_B - part.a_B).cwiseMax(-part.b_B).cwiseMin(part.b_B);
  }
  return part.a_B;
}

double LeastAlong(const Part& part, const Vector3& n_B) {
  switch (part.core) {
    case Core::kPoint:
      return n_B.dot(part.a_B);
    case Core::kSegment:
      return std::min(n_B.dot(part.a_B), n_B.dot(part.b_B));
    case Core::kCylinder:
      // Support of a disc of radius r and half width w about the y axis: min n . x = -r sqrt(n_x^2
      // + n_z^2) - w |n_y|.
      return -part.b_B.x() * std::sqrt(n_B.x() * n_B.x() + n_B.z() * n_B.z()) -
             part.b_B.y() * std::abs(n_B.y());
    case Core::kBox:
      return n_B.dot(part.a_B) - n_B.cwiseAbs().dot(part.b_B);
  }
  return n_B.dot(part.a_B);
}

}  // namespace rockyard::rover
