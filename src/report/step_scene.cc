#include "report/step_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "report/pinhole_camera.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using math::Vector3;
using messages::MapCellView;
using messages::NavigationView;

// px. The farthest rocks of a field are thousands.
constexpr double kSmallestRock = 4.0;
constexpr double kFinestCorner = 1.5;

class CameraImage {
 public:
  CameraImage(const PinholeCamera& camera, const SvgFrame& frame) : camera_(camera), frame_(frame) {
    // The tangents of the angles that the image takes, so that it is as wide as what it shows.
    const double width = camera.columns_px / camera.focal_columns_px;
    const double height = camera.rows_px / camera.focal_rows_px;
    const double scale = std::min(frame.width / width, frame.height / height);
    column_scale_ = scale / camera.focal_columns_px;
    row_scale_ = scale / camera.focal_rows_px;
  }

  std::string Draw(const StepScene& scene, const NavigationView& view) {
    const double width = column_scale_ * camera_.columns_px;
    const double height = row_scale_ * camera_.rows_px;
    std::string svg = SvgBox(0.0, 0.0, width, height, "fill=\"#e8eef4\"");
    const Vector3 up_R = scene.X_WR.linear().transpose() * Vector3::UnitZ();
    svg += Shape(BelowHorizon(camera_, up_R), "fill=\"#f4e6d8\" stroke=\"#888\"");
    AddRocks(scene);
    AddGrid(view);
    std::stable_sort(seen_.begin(), seen_.end(),
                     [](const Seen& a, const Seen& b) { return a.range_m > b.range_m; });
    for (const Seen& seen : seen_) svg += seen.svg;
    svg += SvgBox(0.0, 0.0, width, height, "fill=\"none\" stroke=\"#000\"");
    return SvgPart({frame_.left + 0.5 * (frame_.width - width), frame_.top, width, height}, svg);
  }

 private:
  struct Seen {
    double range_m = 0.0;  // from the eye to its middle
    std::string svg;
  };

  std::string Shape(const std::vector<ImagePoint>& polygon, std::string_view style) const {
    std::vector<SvgPoint> points;
    points.reserve(polygon.size());
    for (const ImagePoint& point : polygon) {
      points.push_back({column_scale_ * point.column, row_scale_ * point.row});
    }
    return SvgPolygon(points, style);
  }

  void Add(std::span<const Vector3> points_R, const std::vector<ImagePoint>& polygon,
           std::string_view style) {
    if (polygon.empty()) return;
    Vector3 middle = Vector3::Zero();
    for (const Vector3& point : points_R) middle += point / static_cast<double>(points_R.size());
    seen_.push_back({(middle - camera_.eye).norm(), Shape(polygon, style)});
  }

  void AddRocks(const StepScene& scene) {
    const math::Transform X_RW = scene.X_WR.inverse();
    for (const SceneRock& rock : scene.rocks) {
      std::vector<Vector3> surface_R;
      surface_R.reserve(rock.surface_W.size());
      for (const Vector3& point : rock.surface_W) surface_R.push_back(X_RW * point);
      const std::vector<ImagePoint> outline = Silhouette(camera_, surface_R);
      if (!IsDot(outline)) Add(surface_R, Coarse(outline), "fill=\"#c9bfb4\" stroke=\"#000\"");
    }
  }

  // Leaves out corners that are nearer to the one before than kFinestCorner.
  std::vector<ImagePoint> Coarse(const std::vector<ImagePoint>& outline) const {
    std::vector<ImagePoint> kept;
    for (const ImagePoint& point : outline) {
      if (!kept.empty() && std::hypot(column_scale_ * (point.column - kept.back().column),
                                      row_scale_ * (point.row - kept.back().row)) < kFinestCorner) {
        continue;
      }
      kept.push_back(point);
    }
    return kept;
  }

  // Whether the outline is not as wide as kSmallestRock.
  bool IsDot(const std::vector<ImagePoint>& outline) const {
    const auto [left, right] = std::minmax_element(
        outline.begin(), outline.end(),
        [](const ImagePoint& a, const ImagePoint& b) { return a.column < b.column; });
    return outline.empty() || column_scale_ * (right->column - left->column) < kSmallestRock;
  }

  void AddGrid(const NavigationView& view) {
    const GridSurface surface(view);
    for (int iy = 0; iy < view.map.ny; ++iy) {
      for (int ix = 0; ix < view.map.nx; ++ix) {
        const MapCellView& cell = view.map.Cell(ix, iy);
        if (!cell.has_data) continue;
        const std::array<Vector3, 4> corners = surface.Corners(ix, iy);
        Add(corners, ImageOfPolygon(camera_, corners), CellStyle(cell));
      }
    }
  }

  static std::string CellStyle(const MapCellView& cell) {
    if (!cell.known) return "fill=\"none\" stroke=\"#777\" stroke-width=\"0.7\"";
    return SvgFill(ByteColour(cell.goodness)) +
           " fill-opacity=\"0.55\" stroke=\"#333\" stroke-width=\"0.7\"";
  }

  const PinholeCamera& camera_;
  SvgFrame frame_;
  double column_scale_ = 1.0;
  double row_scale_ = 1.0;
  std::vector<Seen> seen_;
};

}  // namespace

std::string CameraPanel(const StepScene& scene, const NavigationView& view, const SvgFrame& frame) {
  if (!scene.camera) {
    return SvgText(frame.left, frame.top + 20.0, "the rover has no camera that looks ahead");
  }
  return CameraImage(*scene.camera, frame).Draw(scene, view);
}

namespace {

using messages::MapView;

constexpr std::string_view kTruePathStyle = "fill=\"none\" stroke=\"#000\" stroke-width=\"2\"";
constexpr std::string_view kBelievedPathStyle =
    "fill=\"none\" stroke=\"#b0005a\" stroke-width=\"2\" stroke-dasharray=\"3 3\"";
constexpr std::string_view kWindowStyle =
    "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\" stroke-dasharray=\"8 4\"";
constexpr std::string_view kRoverStyle =
    "fill=\"#fff\" fill-opacity=\"0.6\" stroke=\"#000\" stroke-width=\"1.5\"";
constexpr std::string_view kPlaceStyle = "fill=\"none\" stroke=\"#d55e00\" stroke-width=\"2\"";
constexpr double kBorder_m = 0.3;
constexpr std::size_t kMostPathPoints = 1000;
constexpr double kSmallestRock_px = 3.0;
constexpr double kSquareRock = 7.0;  // px; below it four corners of eight are as good

struct Place {
  double x_m = 0.0;
  double y_m = 0.0;
};

// A place from the coordinates of a rover at `pose`.
Place FromRover(const math::Pose2& pose, double ahead_m, double left_m) {
  const double c = std::cos(pose.heading_rad);
  const double s = std::sin(pose.heading_rad);
  return {pose.x_m + c * ahead_m - s * left_m, pose.y_m + s * ahead_m + c * left_m};
}

std::array<Place, 4> RoverOutline(const StepScene& scene) {
  const math::Pose2 pose = math::ToPose2(scene.X_WR);
  const double ahead_m = 0.5 * scene.rover_length_m;
  const double left_m = 0.5 * scene.rover_width_m;
  return {FromRover(pose, ahead_m, left_m), FromRover(pose, ahead_m, -left_m),
          FromRover(pose, -ahead_m, -left_m), FromRover(pose, -ahead_m, left_m)};
}

// The map's window lies around the rover as it believes, whatever frame the map has.
std::array<Place, 4> WindowOutline(const StepScene& scene, const NavigationView& view) {
  const MapView& map = view.map;
  const double c = std::cos(view.estimate.heading_rad);
  const double s = std::sin(view.estimate.heading_rad);
  const auto place = [&](double x_m, double y_m) {
    const double dx_m = x_m - view.estimate.x_m;
    const double dy_m = y_m - view.estimate.y_m;
    return FromRover(scene.believed, c * dx_m + s * dy_m, c * dy_m - s * dx_m);
  };
  const double x1_m = map.x0_m + map.nx * map.xstep_m;
  const double y1_m = map.y0_m + map.ny * map.ystep_m;
  return {place(map.x0_m, map.y0_m), place(x1_m, map.y0_m), place(x1_m, y1_m),
          place(map.x0_m, y1_m)};
}

std::vector<SvgPoint> EverySecond(const std::vector<SvgPoint>& points) {
  std::vector<SvgPoint> kept;
  for (std::size_t i = 0; i < points.size(); i += 2) kept.push_back(points[i]);
  return kept;
}

// What the plan shows: x to the right, y up.
class Plan {
 public:
  Plan(const StepScene& scene, const NavigationView& view, const SvgFrame& frame)
      : scene_(scene), view_(view), frame_(frame) {
    x_min_m_ = x_max_m_ = scene.start.x_m;
    y_min_m_ = y_max_m_ = scene.start.y_m;
    for (const Place& corner : WindowOutline(scene, view)) Include(corner.x_m, corner.y_m);
    for (const Place& corner : RoverOutline(scene)) Include(corner.x_m, corner.y_m);
    for (const messages::Goal& place : scene.waypoints) Include(place.x_m, place.y_m);
    const double radius_m = scene.goal_radius_m;
    Include(scene.goal.x_m - radius_m, scene.goal.y_m - radius_m);
    Include(scene.goal.x_m + radius_m, scene.goal.y_m + radius_m);
    for (const TracePath* path : {&scene.true_path, &scene.believed_path}) {
      for (const PathPiece& piece : *path) {
        for (const math::Pose2& pose : piece) Include(pose.x_m, pose.y_m);
      }
    }
    scale_ = std::min(frame.width / (x_max_m_ - x_min_m_ + 2.0 * kBorder_m),
                      frame.height / (y_max_m_ - y_min_m_ + 2.0 * kBorder_m));
  }

  std::string Draw() const {
    std::string svg = SvgBox(0.0, 0.0, frame_.width, frame_.height, "fill=\"#f4e6d8\"");
    for (const SceneRock& rock : scene_.rocks) svg += DrawRock(rock);
    svg += DrawOutline(WindowOutline(scene_, view_), kWindowStyle);
    svg += DrawPath(scene_.true_path, kTruePathStyle);
    svg += DrawPath(scene_.believed_path, kBelievedPathStyle);
    svg += DrawOutline(RoverOutline(scene_), kRoverStyle) + DrawRover();
    svg += DrawPlaces();
    const SvgPoint scale{10.0, frame_.height - 10.0};
    svg += SvgBox(0.0, scale.y - 20.0, scale_ + 20.0, 30.0, "fill=\"#fff\" fill-opacity=\"0.8\"");
    svg += SvgLine(scale, {scale.x + scale_, scale.y}, "stroke=\"#000\" stroke-width=\"3\"");
    svg += SvgText(scale.x, scale.y - 6.0, "1 m", 12.0);
    return SvgPart(frame_, svg);
  }

 private:
  void Include(double x_m, double y_m) {
    x_min_m_ = std::min(x_min_m_, x_m);
    x_max_m_ = std::max(x_max_m_, x_m);
    y_min_m_ = std::min(y_min_m_, y_m);
    y_max_m_ = std::max(y_max_m_, y_m);
  }

  // The middle of what is shown stands in the middle of the frame.
  SvgPoint At(double x_m, double y_m) const {
    return {0.5 * frame_.width + scale_ * (x_m - 0.5 * (x_min_m_ + x_max_m_)),
            0.5 * frame_.height - scale_ * (y_m - 0.5 * (y_min_m_ + y_max_m_))};
  }

  bool Shows(const SvgPoint& point) const {
    return point.x >= 0.0 && point.x <= frame_.width && point.y >= 0.0 && point.y <= frame_.height;
  }

  // Draws a rock; nothing for rocks beyond the frame, and for those that would be dots.
  std::string DrawRock(const SceneRock& rock) const {
    std::vector<SvgPoint> corners;
    corners.reserve(rock.outline_W.size());
    for (const math::Vector3& corner : rock.outline_W)
      corners.push_back(At(corner.x(), corner.y()));
    const auto shown = [this](const SvgPoint& point) { return Shows(point); };
    if (std::none_of(corners.begin(), corners.end(), shown)) return "";
    const auto [least, most] =
        std::minmax_element(corners.begin(), corners.end(),
                            [](const SvgPoint& a, const SvgPoint& b) { return a.x < b.x; });
    const double width = most->x - least->x;
    if (width < kSmallestRock_px) return "";
    if (width < kSquareRock) corners = EverySecond(corners);
    // Light for low rocks.
    const int grey = static_cast<int>(std::lround(205.0 - 135.0 * rock.height_share));
    return SvgPolygon(corners, fmt::format("fill=\"rgb({0},{0},{0})\"", grey));
  }

  std::string DrawPath(const TracePath& path, std::string_view style) const {
    std::string svg;
    for (const PathPiece& piece : Thinned(path, kMostPathPoints)) {
      if (piece.size() < 2) continue;
      std::vector<SvgPoint> points;
      points.reserve(piece.size());
      for (const math::Pose2& pose : piece) points.push_back(At(pose.x_m, pose.y_m));
      svg += SvgPolyline(points, style);
    }
    return svg;
  }

  std::string DrawOutline(const std::array<Place, 4>& corners, std::string_view style) const {
    std::vector<SvgPoint> points;
    points.reserve(corners.size());
    for (const Place& corner : corners) points.push_back(At(corner.x_m, corner.y_m));
    return SvgPolygon(points, style);
  }

  // The line from the middle of the rover to its front.
  std::string DrawRover() const {
    const math::Pose2 pose = math::ToPose2(scene_.X_WR);
    const Place front = FromRover(pose, 0.5 * scene_.rover_length_m, 0.0);
    return SvgLine(At(pose.x_m, pose.y_m), At(front.x_m, front.y_m),
                   "stroke=\"#000\" stroke-width=\"1.5\"");
  }

  std::string DrawPlaces() const {
    const SvgPoint start = At(scene_.start.x_m, scene_.start.y_m);
    std::string svg = fmt::format(
        "<path d=\"M{:.1f} {:.1f}l10 10m0 -10l-10 10\" {}><title>start</title></path>\n",
        start.x - 5.0, start.y - 5.0, kPlaceStyle);
    for (const messages::Goal& place : scene_.waypoints) {
      const SvgPoint at = At(place.x_m, place.y_m);
      svg += fmt::format(
          "<path d=\"M{:.1f} {:.1f}l6 6l-6 6l-6 -6Z\" {}><title>waypoint</title></path>\n", at.x,
          at.y - 6.0, kPlaceStyle);
    }
    const SvgPoint goal = At(scene_.goal.x_m, scene_.goal.y_m);
    return svg + fmt::format(
                     "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}><title>goal</title>"
                     "</circle>\n",
                     goal.x, goal.y, std::max(3.0, scale_ * scene_.goal_radius_m), kPlaceStyle);
  }

  const StepScene& scene_;
  const NavigationView& view_;
  SvgFrame frame_;
  double x_min_m_ = 0.0;
  double x_max_m_ = 0.0;
  double y_min_m_ = 0.0;
  double y_max_m_ = 0.0;
  double scale_ = 1.0;  // px per metre
};

std::string CourseKey(const SvgFrame& frame) {
  struct Entry {
    std::string_view style;
    std::string_view text;
    double width;
  };
  constexpr Entry kEntries[] = {{kTruePathStyle, "true path", 94.0},
                                {kBelievedPathStyle, "path believed", 124.0},
                                {kWindowStyle, "map, as believed", 146.0}};
  const double y = frame.top + frame.height + kCourseKeyHeight - 5.0;
  double x = frame.left;
  std::string svg;
  for (const Entry& entry : kEntries) {
    svg += SvgLine({x, y - 4.0}, {x + 28.0, y - 4.0}, entry.style);
    svg += SvgText(x + 33.0, y, entry.text, 12.0);
    x += entry.width;
  }
  return svg + SvgText(x, y, "x start, ring goal, diamond waypoint", 12.0);
}

}  // namespace

std::string CoursePanel(const StepScene& scene, const NavigationView& view, const SvgFrame& frame) {
  return Plan(scene, view, frame).Draw() + CourseKey(frame);
}

}  // namespace rockyard::report
