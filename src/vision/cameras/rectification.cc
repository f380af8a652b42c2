#include "vision/cameras/rectification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "math/angles.h"
#include "math/functions.h"
#include "vision/cameras/cahv.h"

namespace rockyard::vision {
namespace {

using core::Problem;
using math::Vector3;

constexpr double kShortestBaseline_m = 1e-6;
constexpr double kLeastBaselineToView_rad = math::DegToRad(20.0);
constexpr double kMostBaselineToRows_rad = math::DegToRad(45.0);
constexpr int kBorderSteps = 64;
constexpr double kFewestPixels = 2.0;
constexpr int kLongestRectifiedSide_px = 16384;

template <typename Value>
core::Result<Value> Refuse(std::string path, std::string reason, std::string suggestion) {
  return std::vector<Problem>{{std::move(path), std::move(reason), std::move(suggestion)}};
}

// How a camera looks at the middle of its image.
struct View {
  Vector3 direction;
  Vector3 row;            // the unit direction in which columns grow
  double focal_px = 0.0;  // pixels per radian, the mean of rows and columns
};

core::Result<View> ViewOf(const CameraModel& camera, const std::string& path) {
  if (camera.size.columns < 1 || camera.size.rows < 1) {
    return Refuse<View>(path, "has no pixels", "give the size of the image");
  }
  RayJacobian jacobian;
  const auto ray = BackProject(camera, MiddleOf(camera.size), &jacobian);
  if (!ray || !jacobian.direction.allFinite() || !CentreOf(camera).allFinite()) {
    return Refuse<View>(path, "sees nothing in the middle of its image",
                        "check that every number of the model is right and finite");
  }
  const Vector3 along = jacobian.direction.col(0);
  const Vector3 down = jacobian.direction.col(1);
  const double area = along.cross(down).dot(ray->direction);
  if (!(area > 0.0)) {
    return Refuse<View>(path, "shows a mirror image",
                        "flip the image and the signs of its horizontal vector");
  }
  return View{ray->direction, along.normalized(), 1.0 / std::sqrt(area)};
}

struct Axes {
  Vector3 right;  // h'
  Vector3 down;   // v'
  Vector3 ahead;  // A'
};

double AngleBetween(const Vector3& a, const Vector3& b) {
  return math::Atan2(a.cross(b).norm(), a.dot(b));
}

core::Result<Axes> AxesOf(const Vector3& baseline, const View& left, const View& right) {
  if (!(baseline.norm() >= kShortestBaseline_m)) {
    return Refuse<Axes>("baseline", fmt::format("is {:.3g} m long", baseline.norm()),
                        "give two cameras that stand apart, in one frame");
  }
  if (!(left.direction.dot(right.direction) > 0.0)) {
    return Refuse<Axes>("right",
                        fmt::format("looks {:.0f} deg away from where the left one looks",
                                    math::RadToDeg(AngleBetween(left.direction, right.direction))),
                        "give two cameras that look the same way, in one frame");
  }
  const Vector3 h = baseline.normalized();
  const Vector3 view = (left.direction + right.direction).normalized();
  const double off_view_rad = math::Asin(std::fmin(1.0, view.cross(h).norm()));
  if (off_view_rad < kLeastBaselineToView_rad) {
    return Refuse<Axes>("baseline",
                        fmt::format("is {:.1f} deg from the direction in which the cameras look",
                                    math::RadToDeg(off_view_rad)),
                        fmt::format("use cameras side by side, at least {:.0f} deg off it",
                                    math::RadToDeg(kLeastBaselineToView_rad)));
  }
  const Vector3 ahead = (view - view.dot(h) * h).normalized();
  const Vector3 rows = left.row + right.row;
  const double off_rows_rad = AngleBetween(rows - rows.dot(ahead) * ahead, h);
  if (!(off_rows_rad <= std::numbers::pi - kMostBaselineToRows_rad)) {
    return Refuse<Axes>("baseline", "leads to the left: the eyes are swapped",
                        "exchange the left and the right camera with their images");
  }
  if (!(off_rows_rad <= kMostBaselineToRows_rad)) {
    return Refuse<Axes>(
        "baseline",
        fmt::format("is {:.0f} deg from the rows of the images", math::RadToDeg(off_rows_rad)),
        "turn images of cameras one above the other by 90 deg");
  }
  return Axes{h, ahead.cross(h), ahead};
}

// A rectangle of slopes (to the right, down) from A'.
using Box = Eigen::AlignedBox2d;

// Returns the rectangle around what a camera sees, from the rays of its border and of a coarse grid
// inside, for lenses whose image bulges.
Box FieldOf(const CameraModel& camera, const Axes& axes, double largest_slope) {
  Box box;
  for (int i = 0; i <= kBorderSteps; ++i) {
    for (int j = 0; j <= kBorderSteps; ++j) {
      const bool border = i == 0 || j == 0 || i == kBorderSteps || j == kBorderSteps;
      if (!border && (i % 8 != 0 || j % 8 != 0)) continue;
      const Pixel pixel(static_cast<double>(i) / kBorderSteps * (camera.size.columns - 1),
                        static_cast<double>(j) / kBorderSteps * (camera.size.rows - 1));
      const auto ray = BackProject(camera, pixel);
      if (!ray) continue;
      const double depth = ray->direction.dot(axes.ahead);
      const Pixel across(ray->direction.dot(axes.right), ray->direction.dot(axes.down));
      const double furthest = across.lpNorm<Eigen::Infinity>();
      if (!(depth > 0.0 || furthest > 0.0)) continue;  // straight behind
      // A ray at a right angle to A' or beyond counts where it leaves what is kept.
      const Pixel slope = across / (depth > 0.0 ? depth : furthest / largest_slope);
      box.extend(slope.cwiseMax(-largest_slope).cwiseMin(largest_slope));
    }
  }
  return box;
}

struct Frame {
  double focal_px = 0.0;
  ImageSize size;
  Pixel axis_px;  // c_h, c_v
};

core::Result<Frame> FrameOf(const Box& field, double natural_focal_px,
                            const RectificationOptions& options) {
  const Eigen::Vector2d extent = field.sizes();
  const bool sized = options.size.columns > 0 && options.size.rows > 0;
  double focal_px = options.focal_px > 0.0 ? options.focal_px : natural_focal_px;
  if (sized && !(options.focal_px > 0.0)) {
    focal_px =
        std::fmin((options.size.columns - 1) / extent.x(), (options.size.rows - 1) / extent.y());
  }
  const Eigen::Vector2d pixels = focal_px * extent;
  if (!(pixels.minCoeff() >= kFewestPixels)) {
    return Refuse<Frame>("field", "is less than 2 pixels wide or high",
                         "give cameras whose images overlap");
  }
  ImageSize size = options.size;
  if (!sized) {
    if (!(pixels.maxCoeff() < kLongestRectifiedSide_px)) {
      return Refuse<Frame>(
          "size", fmt::format("would be {:.0f} x {:.0f} pixels", pixels.x(), pixels.y()),
          fmt::format("use a smaller focal_px or largest_angle, or give a size, up to {} pixels",
                      kLongestRectifiedSide_px));
    }
    // The first pixel sees the field's edge, the last one what is on or beyond the other.
    size = {static_cast<int>(std::ceil(pixels.x())) + 1,
            static_cast<int>(std::ceil(pixels.y())) + 1};
  }
  return Frame{focal_px, size, MiddleOf(size) - focal_px * field.center()};
}

std::vector<Problem> OptionProblems(const RectificationOptions& options) {
  std::vector<Problem> problems;
  if (!(options.focal_px >= 0.0 && std::isfinite(options.focal_px))) {
    problems.push_back({"focal_px", fmt::format("is {}", options.focal_px),
                        "use a positive number, or 0 for the focal length of the images"});
  }
  if (!(options.largest_angle_rad > 0.0 && options.largest_angle_rad < 0.5 * std::numbers::pi)) {
    problems.push_back({"largest_angle_rad", fmt::format("is {}", options.largest_angle_rad),
                        "use an angle between 0 and 1.57"});
  }
  const int longest = std::max(options.size.columns, options.size.rows);
  const int shortest = std::min(options.size.columns, options.size.rows);
  if (shortest < 0 || longest > kLongestRectifiedSide_px || (shortest == 0) != (longest == 0)) {
    problems.push_back(
        {"size", fmt::format("is {} x {} pixels", options.size.columns, options.size.rows),
         fmt::format("use up to {} pixels a side, or none", kLongestRectifiedSide_px)});
  }
  return problems;
}

constexpr double kSame = 1e-9;

bool IsSame(const math::Vector3& a, const math::Vector3& b) {
  return (a - b).norm() <= kSame * a.norm();
}

}  // namespace

core::Result<RectifiedPair> Rectify(const CameraModel& left, const CameraModel& right,
                                    const RectificationOptions& options) {
  if (std::vector<Problem> problems = OptionProblems(options); !problems.empty()) return problems;
  const core::Result<View> left_view = ViewOf(left, "left");
  if (!left_view.ok()) return left_view.problems();
  const core::Result<View> right_view = ViewOf(right, "right");
  if (!right_view.ok()) return right_view.problems();
  const Vector3 baseline = CentreOf(right) - CentreOf(left);
  const core::Result<Axes> axes = AxesOf(baseline, *left_view, *right_view);
  if (!axes.ok()) return axes.problems();

  const double largest_slope = math::Tan(options.largest_angle_rad);
  Box field = FieldOf(left, *axes, largest_slope);
  const Box overlap = field.intersection(FieldOf(right, *axes, largest_slope));
  if (overlap.isEmpty()) {
    return Refuse<RectifiedPair>("field", "is empty: the cameras see nothing in common",
                                 "give two cameras whose images overlap, in one frame");
  }
  if (options.field == RectifiedField::kOverlap) field = overlap;
  const double natural_focal_px = std::sqrt(left_view->focal_px * right_view->focal_px);
  const core::Result<Frame> frame = FrameOf(field, natural_focal_px, options);
  if (!frame.ok()) return frame.problems();

  Cahv aligned{CentreOf(left), axes->ahead,
               frame->focal_px * axes->right + frame->axis_px.x() * axes->ahead,
               frame->focal_px * axes->down + frame->axis_px.y() * axes->ahead};
  RectifiedPair pair{aligned, aligned, frame->size, frame->focal_px, baseline.norm()};
  pair.right.C = CentreOf(right);
  return pair;
}

std::optional<Pixel> SourceOf(const CameraModel& real, const Cahv& aligned, const Pixel& pixel,
                              double range_m) {
  const std::optional<Vector3> direction = LeavePlane(aligned, pixel, nullptr);
  if (!direction || !(range_m > 0.0)) return std::nullopt;
  std::optional<Pixel> source = std::isinf(range_m)
                                    ? ProjectDirection(real, *direction)
                                    : Project(real, aligned.C + range_m * direction->normalized());
  if (!source || !IsInside(real.size, *source)) return std::nullopt;
  return source;
}

std::optional<TriangulatedPoint> Triangulate(const Cahv& left, const Cahv& right,
                                             const Pixel& left_pixel, double disparity_px) {
  if (!(disparity_px > 0.0)) return std::nullopt;
  Eigen::Matrix<double, 3, 2> n_by_pixel;
  const std::optional<math::Vector3> n = LeavePlane(left, left_pixel, &n_by_pixel);
  if (!n) return std::nullopt;
  const double depth = left.H.dot(right.C - left.C) / disparity_px;
  TriangulatedPoint point;
  point.p_A = left.C + depth * *n;
  point.by_measurement.leftCols<2>() = depth * n_by_pixel;
  point.by_measurement.col(2) = -depth / disparity_px * *n;
  if (!point.p_A.allFinite() || !point.by_measurement.allFinite()) return std::nullopt;
  return point;
}

std::optional<RectifiedPair> AlignedPair(const CameraModel& left, const CameraModel& right) {
  const Cahv* l = std::get_if<Cahv>(&left.lens);
  const Cahv* r = std::get_if<Cahv>(&right.lens);
  if (l == nullptr || r == nullptr || left.size != right.size) return std::nullopt;
  if (!IsSame(l->A, r->A) || !IsSame(l->H, r->H) || !IsSame(l->V, r->V)) return std::nullopt;
  const math::Vector3 baseline = r->C - l->C;
  const math::Vector3 rows = l->H - l->H.dot(l->A) * l->A;  // f_h h'
  const math::Vector3 across = baseline.cross(rows);
  if (across.norm() > kSame * baseline.norm() * rows.norm()) return std::nullopt;
  if (baseline.dot(rows) <= 0.0) return std::nullopt;
  return RectifiedPair{*l, *r, left.size, rows.norm(), baseline.norm()};
}

}  // namespace rockyard::vision
