#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "report/colour_ramp.h"
#include "report/pinhole_camera.h"
#include "report/step_scene.h"

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

  // Not as wide as kSmallestRock.
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

}  // namespace rockyard::report
