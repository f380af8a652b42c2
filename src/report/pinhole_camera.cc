#include "report/pinhole_camera.h"

#include <algorithm>
#include <cstddef>

namespace rockyard::report {
namespace {

using math::Vector3;

double Depth(const PinholeCamera& camera, const Vector3& point) {
  return camera.axis.dot(point - camera.eye);
}

Vector3 Between(const Vector3& a, const Vector3& b, double share) { return a + share * (b - a); }

ImagePoint Between(const ImagePoint& a, const ImagePoint& b, double share) {
  return {a.column + share * (b.column - a.column), a.row + share * (b.row - a.row)};
}

// The part of a convex polygon where a linear function `inside` is not negative (Sutherland and
// Hodgman 1974).
template <typename Point, typename Inside>
std::vector<Point> Clip(const std::vector<Point>& polygon, Inside inside) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& from = polygon[i];
    const Point& to = polygon[(i + 1) % polygon.size()];
    const double at_from = inside(from);
    const double at_to = inside(to);
    if (at_from >= 0.0) kept.push_back(from);
    if ((at_from >= 0.0) != (at_to >= 0.0)) {
      kept.push_back(Between(from, to, at_from / (at_from - at_to)));
    }
  }
  return kept;
}

std::vector<ImagePoint> WithinImage(const PinholeCamera& camera, std::vector<ImagePoint> polygon) {
  polygon = Clip(polygon, [](const ImagePoint& p) { return p.column; });
  polygon = Clip(polygon, [&](const ImagePoint& p) { return camera.columns_px - p.column; });
  polygon = Clip(polygon, [](const ImagePoint& p) { return p.row; });
  polygon = Clip(polygon, [&](const ImagePoint& p) { return camera.rows_px - p.row; });
  if (polygon.size() < 3) polygon.clear();
  return polygon;
}

// Positive where b -> c turns to the other side than the image's clock.
double Turn(const ImagePoint& a, const ImagePoint& b, const ImagePoint& c) {
  return (b.column - a.column) * (c.row - a.row) - (b.row - a.row) * (c.column - a.column);
}

// The convex hull (Andrew 1979, monotone chain).
std::vector<ImagePoint> Hull(std::vector<ImagePoint> points) {
  std::sort(points.begin(), points.end(), [](const ImagePoint& a, const ImagePoint& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  std::vector<ImagePoint> hull;
  const auto add_chain = [&hull](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto point = first; point != last; ++point) {
      while (hull.size() >= start + 2 && Turn(hull[hull.size() - 2], hull.back(), *point) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    // The other chain begins with it.
    if (!hull.empty()) hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

std::optional<ImagePoint> Project(const PinholeCamera& camera, const Vector3& point) {
  const double depth_m = Depth(camera, point);
  if (depth_m < kNearestDepth_m) return std::nullopt;
  const Vector3 ray = (point - camera.eye) / depth_m;
  return ImagePoint{0.5 * camera.columns_px + camera.focal_columns_px * camera.right.dot(ray),
                    0.5 * camera.rows_px + camera.focal_rows_px * camera.down.dot(ray)};
}

std::vector<ImagePoint> ImageOfPolygon(const PinholeCamera& camera,
                                       std::span<const Vector3> corners) {
  // What is cut lies a little beyond, so that rounding takes none of it.
  constexpr double kCut_m = 1.001 * kNearestDepth_m;
  const std::vector<Vector3> before =
      Clip(std::vector<Vector3>(corners.begin(), corners.end()),
           [&](const Vector3& point) { return Depth(camera, point) - kCut_m; });
  std::vector<ImagePoint> image;
  for (const Vector3& point : before) {
    if (const auto seen = Project(camera, point)) image.push_back(*seen);
  }
  return WithinImage(camera, std::move(image));
}

std::vector<ImagePoint> Silhouette(const PinholeCamera& camera, std::span<const Vector3> points) {
  std::vector<ImagePoint> seen;
  for (const Vector3& point : points) {
    if (const auto at = Project(camera, point)) seen.push_back(*at);
  }
  return WithinImage(camera, Hull(std::move(seen)));
}

std::vector<ImagePoint> BelowHorizon(const PinholeCamera& camera, const Vector3& up) {
  const std::vector<ImagePoint> image{{0.0, 0.0},
                                      {camera.columns_px, 0.0},
                                      {camera.columns_px, camera.rows_px},
                                      {0.0, camera.rows_px}};
  // The ray of an image point is linear in it: axis + u right + v down.
  std::vector<ImagePoint> below = Clip(image, [&](const ImagePoint& p) {
    const double u = (p.column - 0.5 * camera.columns_px) / camera.focal_columns_px;
    const double v = (p.row - 0.5 * camera.rows_px) / camera.focal_rows_px;
    return -up.dot(camera.axis + u * camera.right + v * camera.down);
  });
  if (below.size() < 3) below.clear();
  return below;
}

GridSurface::GridSurface(const messages::NavigationView& view)
    : map_(view.map),
      X_RE_(math::MakePose({view.estimate.x_m, view.estimate.y_m, view.attitude.z_m},
                           view.estimate.heading_rad, view.attitude.pitch_rad,
                           view.attitude.roll_rad)
                .inverse()) {}

std::array<Vector3, 4> GridSurface::Corners(int ix, int iy) const {
  return {Corner(ix, iy), Corner(ix + 1, iy), Corner(ix + 1, iy + 1), Corner(ix, iy + 1)};
}

Vector3 GridSurface::Corner(int ix, int iy) const {
  double sum_m = 0.0;
  int cells = 0;
  for (int y = std::max(iy - 1, 0); y <= std::min(iy, map_.ny - 1); ++y) {
    for (int x = std::max(ix - 1, 0); x <= std::min(ix, map_.nx - 1); ++x) {
      const messages::MapCellView& cell = map_.Cell(x, y);
      if (!cell.has_data) continue;
      sum_m += cell.elevation_m;
      ++cells;
    }
  }
  return X_RE_ *
         Vector3(map_.x0_m + ix * map_.xstep_m, map_.y0_m + iy * map_.ystep_m, sum_m / cells);
}

}  // namespace rockyard::report
