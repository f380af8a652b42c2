// The drawings of field_export.h: OBJ and SVG.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "math/functions.h"
#include "terrain/arena.h"
#include "terrain/contours.h"
#include "terrain/field_export.h"
#include "terrain/rock.h"

namespace rockyard::terrain {
namespace {

constexpr double kGroundGrid_m = 0.1;
constexpr int kMeridians = 16;
constexpr int kParallels = 8;  // intervals from pole to pole

// Writes vertices and faces and counts the vertices, which OBJ numbers from 1 over the whole file.
class ObjWriter {
 public:
  void Group(std::string_view name) { Write("g {}\n", name); }
  int Vertex(const math::Vector3& p) {
    Write("v {:.6f} {:.6f} {:.6f}\n", p.x(), p.y(), p.z());
    return ++vertices_;
  }
  void Quad(int a, int b, int c, int d) { Write("f {} {} {} {}\n", a, b, c, d); }
  void Triangle(int a, int b, int c) { Write("f {} {} {}\n", a, b, c); }
  std::string Take() { return std::move(text_); }

 private:
  template <typename... Args>
  void Write(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  std::string text_ = "# rockyard terrain: x along the course, y left, z up, m\n";
  int vertices_ = 0;
};

void WriteGround(const Ground& ground, const Rectangle& area, ObjWriter& obj) {
  const auto cells = [&ground](double extent_m) {
    return ground.IsPlane() ? 1 : std::max(1, static_cast<int>(extent_m / kGroundGrid_m));
  };
  const double width_m = area.x_max_m - area.x_min_m;
  const double depth_m = area.y_max_m - area.y_min_m;
  const int nx = cells(width_m);
  const int ny = cells(depth_m);
  obj.Group("ground");
  int last = 0;
  for (int iy = 0; iy <= ny; ++iy) {
    for (int ix = 0; ix <= nx; ++ix) {
      const double x_m = area.x_min_m + width_m * ix / nx;
      const double y_m = area.y_min_m + depth_m * iy / ny;
      last = obj.Vertex({x_m, y_m, ground.Height(x_m, y_m)});
    }
  }
  const int first = last - (nx + 1) * (ny + 1) + 1;
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      const int corner = first + iy * (nx + 1) + ix;
      // Counter-clockwise as seen from above: faces look up.
      obj.Quad(corner, corner + 1, corner + nx + 2, corner + nx + 1);
    }
  }
}

// A circle of a rock around its vertical axis, as shares of its semi-axes.
struct Parallel {
  double radius;
  double height;
};

// Returns a parallel of a sphere: 0 is the south pole, kParallels the north pole.
Parallel SphereParallel(int number) {
  const double latitude = std::numbers::pi * (static_cast<double>(number) / kParallels - 0.5);
  return {math::Cos(latitude), math::Sin(latitude)};
}

// Returns a parallel of a cap: 1 is the base, kParallels the top. They are denser towards the top,
// where a cap bends.
Parallel CapParallel(const Rock& rock, int number) {
  const double share = static_cast<double>(kParallels - number) / (kParallels - 1);
  const double height = 1.0 - share * share;
  return {ParallelRadius(rock, height), height};
}

void WriteRock(const Rock& rock, int index, ObjWriter& obj) {
  obj.Group(fmt::format("rock_{}", index));
  const bool cap = rock.cap_growth > 0.0;
  const int bottom = obj.Vertex(
      OnRock(rock, cap ? math::Vector3::Zero() : math::Vector3(-math::Vector3::UnitZ())));
  // Parallels from the lowest one up, each with kMeridians points; fans close both ends.
  for (int i = 1; i < kParallels; ++i) {
    const Parallel parallel = cap ? CapParallel(rock, i) : SphereParallel(i);
    for (int j = 0; j < kMeridians; ++j) {
      const double longitude = 2.0 * std::numbers::pi * j / kMeridians;
      obj.Vertex(OnRock(rock, {parallel.radius * math::Cos(longitude),
                               parallel.radius * math::Sin(longitude), parallel.height}));
    }
  }
  const int top = obj.Vertex(OnRock(rock, math::Vector3::UnitZ()));
  const auto ring = [bottom](int i, int j) { return bottom + 1 + i * kMeridians + j % kMeridians; };
  for (int j = 0; j < kMeridians; ++j) {
    obj.Triangle(bottom, ring(0, j + 1), ring(0, j));
    for (int i = 0; i + 2 < kParallels; ++i) {
      obj.Quad(ring(i, j), ring(i, j + 1), ring(i + 1, j + 1), ring(i + 1, j));
    }
    obj.Triangle(top, ring(kParallels - 2, j), ring(kParallels - 2, j + 1));
  }
}

void DrawRectangle(const Rectangle& r, std::string_view style, std::string& svg) {
  fmt::format_to(std::back_inserter(svg),
                 "<rect x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" {}/>\n",
                 r.x_min_m, -r.y_max_m, r.x_max_m - r.x_min_m, r.y_max_m - r.y_min_m, style);
}

void DrawLine(double x1_m, double y1_m, double x2_m, double y2_m, std::string_view style,
              std::string& svg) {
  fmt::format_to(std::back_inserter(svg),
                 "<line x1=\"{:.3f}\" y1=\"{:.3f}\" x2=\"{:.3f}\" y2=\"{:.3f}\" {}/>\n", x1_m,
                 -y1_m, x2_m, -y2_m, style);
}

void DrawCross(double x_m, double y_m, std::string_view name, std::string& svg) {
  constexpr double kArm_m = 0.12;
  constexpr std::string_view kStyle = "stroke=\"#c22\" stroke-width=\"0.04\"";
  fmt::format_to(std::back_inserter(svg), "<g><title>{}</title>\n", name);
  DrawLine(x_m - kArm_m, y_m - kArm_m, x_m + kArm_m, y_m + kArm_m, kStyle, svg);
  DrawLine(x_m - kArm_m, y_m + kArm_m, x_m + kArm_m, y_m - kArm_m, kStyle, svg);
  svg += "</g>\n";
}

// Returns the grey of a rock: light for low rocks, dark from kBellyHeight_m on.
int Grey(const Rock& rock) {
  constexpr double kLight = 205.0;
  constexpr double kDark = 70.0;
  const double share = std::clamp(rock.height_m / kBellyHeight_m, 0.0, 1.0);
  return static_cast<int>(std::lround(kLight + share * (kDark - kLight)));
}

void DrawRock(const Rock& rock, int index, std::string& svg) {
  svg += "<polygon points=\"";
  for (const math::Vector3& p : PlanOutline(rock)) {
    // SVG's y axis points down.
    fmt::format_to(std::back_inserter(svg), "{:.3f},{:.3f} ", p.x(), -p.y());
  }
  const int grey = Grey(rock);
  fmt::format_to(
      std::back_inserter(svg),
      "\" fill=\"rgb({0},{0},{0})\"><title>rock {1}: diameter {2:.3f} m, height {3:.3f} m</title>"
      "</polygon>\n",
      grey, index, rock.diameter_m, rock.height_m);
}

// Draws the ground of a model: every fifth contour is bolder.
void DrawContours(const Ground& ground, const Rectangle& area, std::string& svg) {
  constexpr int kMostHeights = 25;
  constexpr int kCells = 10000;
  const ContourMap map = Contours(ground, area, kMostHeights, kCells);
  for (const Contour& contour : map.lines) {
    const bool bold = std::lround(contour.height_m / map.interval_m) % 5 == 0;
    svg += "<polyline points=\"";
    for (const CoursePoint& p : contour.line) {
      fmt::format_to(std::back_inserter(svg), "{:.2f},{:.2f} ", p.x_m, -p.y_m);
    }
    fmt::format_to(std::back_inserter(svg),
                   "\" fill=\"none\" stroke=\"#a65\" stroke-width=\"{}\"><title>{:.6g} m</title>"
                   "</polyline>\n",
                   bold ? "0.03" : "0.012", contour.height_m);
  }
}

Rectangle Union(const Rectangle& a, const Rectangle& b) {
  return {std::min(a.x_min_m, b.x_min_m), std::max(a.x_max_m, b.x_max_m),
          std::min(a.y_min_m, b.y_min_m), std::max(a.y_max_m, b.y_max_m)};
}

std::string SvgHead(const Rectangle& view) {
  constexpr double kBorder_m = 0.2;
  constexpr double kPixelsPerMetre = 80.0;
  const double width_m = view.x_max_m - view.x_min_m + 2.0 * kBorder_m;
  const double height_m = view.y_max_m - view.y_min_m + 2.0 * kBorder_m;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.3f} {:.3f} {:.3f} {:.3f}\" "
      "width=\"{:.0f}\" height=\"{:.0f}\">\n",
      view.x_min_m - kBorder_m, -view.y_max_m - kBorder_m, width_m, height_m,
      width_m * kPixelsPerMetre, height_m * kPixelsPerMetre);
}

}  // namespace

std::string ToObj(const Field& field, const TerrainParams& params) {
  ObjWriter obj;
  WriteGround(field.terrain.ground(), DrivableBounds(params.arena), obj);
  int index = 0;
  for (const Rock& rock : field.terrain.rocks()) WriteRock(rock, index++, obj);
  return obj.Take();
}

std::string ToSvg(const Field& field, const TerrainParams& params, const Course& course,
                  const SvgOverlay& overlay) {
  const Rectangle all = DrivableBounds(params.arena);
  std::string svg = SvgHead(overlay.elements.empty() ? all : Union(all, overlay.area));
  DrawRectangle(all, "fill=\"#f4e6d8\"", svg);
  if (params.ground.elevation.IsGiven()) DrawContours(field.terrain.ground(), all, svg);
  int index = 0;
  for (const Rock& rock : field.terrain.rocks()) DrawRock(rock, index++, svg);
  DrawRectangle(ArenaBounds(params.arena), "fill=\"none\" stroke=\"#444\" stroke-width=\"0.03\"",
                svg);
  if (params.arena.IsVirtual()) {
    for (const double y_m : {params.arena.MirrorLine(), -params.arena.MirrorLine()}) {
      DrawLine(all.x_min_m, y_m, all.x_max_m, y_m,
               "stroke=\"#36c\" stroke-width=\"0.02\" stroke-dasharray=\"0.15 0.1\"", svg);
    }
  }
  DrawCross(course.start_x_m, course.start_y_m, "start", svg);
  for (const CoursePoint& point : course.waypoints) {
    DrawCross(point.x_m, point.y_m, "waypoint", svg);
  }
  DrawCross(course.goal_x_m, course.goal_y_m, "goal", svg);
  svg += overlay.elements;
  svg += "</svg>\n";
  return svg;
}

}  // namespace rockyard::terrain
