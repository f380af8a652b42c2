#include "campaign/looks/look_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "campaign/looks/picture_lines.h"
#include "report/colour_ramp.h"
#include "report/grid_surface.h"
#include "vision/cameras/cahv.h"

namespace rockyard::campaign {
namespace {

using image_files::ColouredPoint;
using image_files::Picture;
using image_files::Rgb;
using math::Vector3;
using messages::LookDirection;

constexpr double kElevationCell_m = 0.05;
constexpr Rgb kUnknownCell{60, 60, 60};
// Of a picture under lines.
constexpr int kDarkest = 80;
constexpr int kLightest = 200;
constexpr int kLine_px = 2;
// Of the way from a corner to the middle of its cell: neighbours do not draw over each other.
constexpr double kInset = 0.08;

Rgb Grey(std::uint8_t value) { return {value, value, value}; }

struct CellOutline {
  std::array<Vector3, 4> corners_R;
  Rgb colour;
  double range_m = 0.0;  // of its middle, from the camera
};

std::vector<CellOutline> OutlinesOf(const messages::NavigationView& view, const Vector3& eye_R) {
  const report::GridSurface surface(view);
  std::vector<CellOutline> outlines;
  for (int iy = 0; iy < view.map.ny; ++iy) {
    for (int ix = 0; ix < view.map.nx; ++ix) {
      const messages::MapCellView& cell = view.map.Cell(ix, iy);
      if (!cell.has_data) continue;
      CellOutline outline{surface.Corners(ix, iy),
                          cell.known ? report::ByteColour(cell.goodness) : kUnknownCell};
      Vector3 middle_R = Vector3::Zero();
      for (const Vector3& corner_R : outline.corners_R) middle_R += 0.25 * corner_R;
      for (Vector3& corner_R : outline.corners_R) corner_R += kInset * (middle_R - corner_R);
      outline.range_m = (middle_R - eye_R).norm();
      outlines.push_back(outline);
    }
  }
  std::stable_sort(
      outlines.begin(), outlines.end(),
      [](const CellOutline& a, const CellOutline& b) { return a.range_m > b.range_m; });
  return outlines;
}

Picture MutedPicture(const vision::GrayImage& left) {
  Picture picture(left.width(), left.height());
  for (int y = 0; y < left.height(); ++y) {
    for (int x = 0; x < left.width(); ++x) picture.At(x, y) = Grey(Muted(left.At(x, y)));
  }
  return picture;
}

}  // namespace

std::uint8_t Muted(std::uint8_t grey) {
  return static_cast<std::uint8_t>(kDarkest + (kLightest - kDarkest) * grey / 255);
}

Picture GridPicture(const CapturedLook& look, const messages::NavigationView& view) {
  const Picture left = MutedPicture(look.sight.left);
  const int factor = FactorToSee(left.width(), left.height());
  Picture picture = Enlarged(left, factor);
  // The middle of an enlarged pixel (0, 0) lies (factor - 1) / 2 from that of the first one.
  const vision::Cahv camera = vision::Mapped(
      look.pair.left, {static_cast<double>(factor), vision::Pixel::Constant(0.5 * (factor - 1))});
  for (const CellOutline& outline : OutlinesOf(view, camera.C)) {
    for (std::size_t i = 0; i < outline.corners_R.size(); ++i) {
      const Vector3& next_R = outline.corners_R[(i + 1) % outline.corners_R.size()];
      if (const auto line = ImageOfLine(camera, outline.corners_R[i], next_R)) {
        DrawLine(*line, outline.colour, kLine_px, picture);
      }
    }
  }
  return picture;
}

ElevationImage ElevationsOf(const messages::PointCloud& cloud) {
  const Vector3 away =
      cloud.direction == LookDirection::kAhead ? Vector3::UnitX() : Vector3(-Vector3::UnitX());
  ElevationImage image;
  image.grid = vision::GridOver(cloud.points_R, away, Vector3::UnitZ(), kElevationCell_m);
  image.heights_m = vision::ElevationMap(cloud.points_R, image.grid);
  return image;
}

std::vector<ColouredPoint> GreyPoints(const CapturedLook& look) {
  std::vector<ColouredPoint> points;
  points.reserve(look.cloud.points_R.size());
  for (const Vector3& p_RoP_R : look.cloud.points_R) {
    // It was triangulated from the middle of a pixel.
    const auto pixel = vision::Project(look.pair.left, p_RoP_R);
    if (!pixel) continue;
    points.push_back(
        {p_RoP_R, Grey(look.sight.left.At(static_cast<int>(std::lround(pixel->x())),
                                          static_cast<int>(std::lround(pixel->y()))))});
  }
  return points;
}

std::vector<ColouredPoint> HeightPoints(const messages::PointCloud& cloud, const HeightSpan& span) {
  std::vector<ColouredPoint> points;
  points.reserve(cloud.points_R.size());
  for (const Vector3& p_RoP_R : cloud.points_R) {
    points.push_back({p_RoP_R, HeightColour(p_RoP_R.z(), span)});
  }
  return points;
}

std::string_view CamerasOf(LookDirection direction) {
  return direction == LookDirection::kAhead ? "front" : "rear";
}

}  // namespace rockyard::campaign
