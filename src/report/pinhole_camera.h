// What a pinhole camera sees of points, surfaces and convex bodies.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "math/pose.h"

namespace rockyard::report {

// Positions and directions are in the frame of the rover, m; lengths in the image are px.
struct PinholeCamera {
  math::Vector3 eye = math::Vector3::Zero();
  // Unit vectors at right angles: along the optical axis, along a row, and down a column.
  math::Vector3 axis = math::Vector3::UnitX();
  math::Vector3 right = -math::Vector3::UnitY();
  math::Vector3 down = -math::Vector3::UnitZ();
  double focal_columns_px = 1.0;  // along a row
  double focal_rows_px = 1.0;     // along a column
  double columns_px = 1.0;        // the whole image, whose middle is on the axis
  double rows_px = 1.0;
};

// From the upper left corner of the image, px.
struct ImagePoint {
  double column = 0.0;
  double row = 0.0;
};

// What is nearer to the eye along the axis than this is not seen.
inline constexpr double kNearestDepth_m = 0.05;

// Returns where a point is imaged, beyond the image's edge too; nothing behind the camera.
std::optional<ImagePoint> Project(const PinholeCamera& camera, const math::Vector3& point);

// These return convex polygons within the image, empty where there is nothing to see.
//
// The image of a flat convex polygon, cut where it comes too near.
std::vector<ImagePoint> ImageOfPolygon(const PinholeCamera& camera,
                                       std::span<const math::Vector3> corners);
// The outline of a convex body through these points. Those that are too near are left out.
std::vector<ImagePoint> Silhouette(const PinholeCamera& camera,
                                   std::span<const math::Vector3> points);
// What of the image looks below the horizon, for the unit vector that points up.
std::vector<ImagePoint> BelowHorizon(const PinholeCamera& camera, const math::Vector3& up);

}  // namespace rockyard::report
