// What a pinhole camera sees of points, surfaces and convex bodies; the map of a navigator as a
// surface, as its rover believes to stand before it. For drawings of decisions and looks alone:
// what a rover sees comes from other cameras (vision/cameras). No record depends on it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "math/pose.h"
#include "messages/navigation_view.h"

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

// Returns the image of a flat convex polygon, cut where it comes nearer than kNearestDepth_m.
// ImageOfPolygon, Silhouette and BelowHorizon return convex polygons within the image, empty where
// there is nothing to see.
std::vector<ImagePoint> ImageOfPolygon(const PinholeCamera& camera,
                                       std::span<const math::Vector3> corners);
// Returns the outline of a convex body through these points. Points nearer than kNearestDepth_m are
// left out.
std::vector<ImagePoint> Silhouette(const PinholeCamera& camera,
                                   std::span<const math::Vector3> points);
// Returns the part of the image that looks below the horizon, for the unit vector that points up.
std::vector<ImagePoint> BelowHorizon(const PinholeCamera& camera, const math::Vector3& up);

// The believed elevations of the map as quadrilaterals in R, by the pose and the attitude that the
// rover believes to have. `view` outlives it.
class GridSurface {
 public:
  explicit GridSurface(const messages::NavigationView& view);

  // Returns the corners of a cell that holds points, once around it, each as high as the cells with
  // points that meet there, on average.
  std::array<math::Vector3, 4> Corners(int ix, int iy) const;

 private:
  // Returns the point of the surface at the lower corner of cell (ix, iy).
  math::Vector3 Corner(int ix, int iy) const;

  const messages::MapView& map_;
  math::Transform X_RE_;  // of the map's frame
};

}  // namespace rockyard::report
