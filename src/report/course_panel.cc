#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "report/step_scene.h"

namespace rockyard::report {
namespace {

using messages::MapView;
using messages::NavigationView;

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

  // Nothing for rocks beyond the frame, and for those that would be dots.
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

  // From the middle of the rover to its front.
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
