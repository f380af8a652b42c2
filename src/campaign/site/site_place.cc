#include "campaign/site/site_place.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "math/functions.h"

namespace rockyard::campaign {
namespace {

using image_files::GeoPoint;
using image_files::LocalPoint;
using image_files::MapPoint;

// Largest deviation from squares along the axes with which nodes are taken as they are: 6 cm over
// 60 m, less than a model's cell.
constexpr double kAlignedWithin = 1e-3;

std::array<double, 6> TransformFor(const image_files::ElevationRaster& raster,
                                   std::optional<double> cell_m) {
  const auto& info = raster.info();
  if (info.transform) {
    if (cell_m) {
      throw core::UserError("--cell", "is given for a file that tells its own cells",
                            "leave it out");
    }
    const auto& t = *info.transform;
    const double area = t[1] * t[5] - t[2] * t[4];
    // Written so that what is no number fails too.
    if (!(std::abs(area) > 0.0 && std::isfinite(area))) {
      throw core::UserError(raster.name(), "has cells of no area by what it says of its place",
                            "write it anew with its geotransform");
    }
    return t;
  }
  if (!cell_m) {
    throw core::UserError(raster.name(), "does not say how large its cells are",
                          "give the side of a cell in metres: --cell 1");
  }
  // The middle of the last row's first cell lies at 0, 0.
  const double side_m = *cell_m;
  return {-0.5 * side_m, side_m, 0.0, (static_cast<double>(info.rows) - 0.5) * side_m,
          0.0,           -side_m};
}

}  // namespace

SitePlane::SitePlane(const image_files::ElevationRaster& raster, std::optional<double> cell_m,
                     bool by_map)
    : raster_(raster),
      frame_(raster.HasFrame() && !by_map ? SiteFrame::kGeographic : SiteFrame::kMap),
      transform_(TransformFor(raster, cell_m)) {}

void SitePlane::Touch(const std::array<double, 2>& place) { place_ = place; }

void SitePlane::TouchPixel(const PixelPoint& pixel) {
  const MapPoint map = MapOf(pixel);
  place_ = {map.x, map.y};
  if (frame_ == SiteFrame::kMap) return;
  const GeoPoint geo = raster_.ToGeographic(std::array{map}).front();
  place_ = {geo.latitude_deg, geo.longitude_deg};
}

std::string SitePlane::PlaceText() const {
  if (frame_ == SiteFrame::kMap) {
    return fmt::format("x {:.2f} m, y {:.2f} m", place_[0], place_[1]);
  }
  return fmt::format("latitude {:.6f}, longitude {:.6f}", place_[0], place_[1]);
}

std::string SitePlane::PlaceOption() const {
  const int digits = frame_ == SiteFrame::kMap ? 2 : 6;
  return fmt::format("{:.{}f},{:.{}f}", place_[0], digits, place_[1], digits);
}

PixelPoint SitePlane::PixelOf(const MapPoint& point) const {
  const auto& t = transform_;
  const double x = point.x - t[0];
  const double y = point.y - t[3];
  const double area = t[1] * t[5] - t[2] * t[4];
  return {(x * t[5] - y * t[2]) / area - 0.5, (y * t[1] - x * t[4]) / area - 0.5};
}

MapPoint SitePlane::MapOf(const PixelPoint& pixel) const {
  const auto& t = transform_;
  const double column = pixel.column + 0.5;
  const double row = pixel.row + 0.5;
  return {t[0] + t[1] * column + t[2] * row, t[3] + t[4] * column + t[5] * row};
}

std::vector<PixelPoint> SitePlane::Pixels(std::span<const LocalPoint> points) const {
  std::vector<MapPoint> map;
  if (frame_ == SiteFrame::kGeographic) {
    map = raster_.ToMap({place_[0], place_[1]}, points);
  } else {
    map.reserve(points.size());
    for (const LocalPoint& point : points) {
      map.push_back({place_[0] + point.east_m, place_[1] + point.north_m});
    }
  }
  std::vector<PixelPoint> pixels;
  pixels.reserve(map.size());
  for (const MapPoint& point : map) pixels.push_back(PixelOf(point));
  return pixels;
}

double LinearPlaces::TurnedRad() const { return math::Atan2(y_first, x_first); }

template <typename Tell>
LinearPlaces SitePlane::PlacesBy(const PixelPoint& origin, double reach_m, const Tell& tell) const {
  const Cells cells = CellsAt(reach_m);
  const double step = reach_m / cells.side_m;
  const std::array<MapPoint, 3> points{MapOf(origin), MapOf({origin.column + step, origin.row}),
                                       MapOf({origin.column, origin.row + step})};
  const std::array<std::array<double, 2>, 3> told = tell(points);
  // Steps along columns and rows in the world: the inverse of cells per metre.
  const double area = cells.columns_east * cells.rows_north - cells.columns_north * cells.rows_east;
  const double column_x = step * cells.rows_north / area;
  const double column_y = -step * cells.rows_east / area;
  const double row_x = -step * cells.columns_north / area;
  const double row_y = step * cells.columns_east / area;
  // The same steps in the two numbers.
  const double column_a = told[1][0] - told[0][0];
  const double column_b = told[1][1] - told[0][1];
  const double row_a = told[2][0] - told[0][0];
  const double row_b = told[2][1] - told[0][1];
  const double turn = column_a * row_b - column_b * row_a;
  return {told[0][0],
          told[0][1],
          (column_x * row_b - row_x * column_b) / turn,
          (row_x * column_a - column_x * row_a) / turn,
          (column_y * row_b - row_y * column_b) / turn,
          (row_y * column_a - column_y * row_a) / turn};
}

LinearPlaces SitePlane::FromMap(const PixelPoint& origin, double reach_m) const {
  return PlacesBy(origin, reach_m, [](const std::array<MapPoint, 3>& points) {
    return std::array<std::array<double, 2>, 3>{
        {{points[0].x, points[0].y}, {points[1].x, points[1].y}, {points[2].x, points[2].y}}};
  });
}

LinearPlaces SitePlane::FromGeographic(const PixelPoint& origin, double reach_m) const {
  return PlacesBy(origin, reach_m, [&](const std::array<MapPoint, 3>& points) {
    const std::vector<GeoPoint> geo = raster_.ToGeographic(points);
    return std::array<std::array<double, 2>, 3>{{{geo[0].longitude_deg, geo[0].latitude_deg},
                                                 {geo[1].longitude_deg, geo[1].latitude_deg},
                                                 {geo[2].longitude_deg, geo[2].latitude_deg}}};
  });
}

SitePlane::Cells SitePlane::CellsAt(double reach_m) const {
  const std::array<LocalPoint, 4> around{LocalPoint{-reach_m, 0.0}, LocalPoint{reach_m, 0.0},
                                         LocalPoint{0.0, -reach_m}, LocalPoint{0.0, reach_m}};
  const std::vector<PixelPoint> pixels = Pixels(around);
  const double per_m = 0.5 / reach_m;
  Cells cells;
  cells.columns_east = per_m * (pixels[1].column - pixels[0].column);
  cells.rows_east = per_m * (pixels[1].row - pixels[0].row);
  cells.columns_north = per_m * (pixels[3].column - pixels[2].column);
  cells.rows_north = per_m * (pixels[3].row - pixels[2].row);
  const double per_m2 =
      cells.columns_east * cells.rows_north - cells.columns_north * cells.rows_east;
  // Without the last bits, which the way there leaves.
  constexpr double kPerNanometre = 1e9;
  cells.side_m = std::round(kPerNanometre / std::sqrt(std::abs(per_m2))) / kPerNanometre;
  cells.north_up = cells.rows_north < 0.0;
  const auto is = [&](double cells_per_m, double wanted) {
    return std::abs(cells_per_m * cells.side_m - wanted) <= kAlignedWithin;
  };
  cells.aligned = is(cells.columns_east, 1.0) && is(cells.rows_east, 0.0) &&
                  is(cells.columns_north, 0.0) && is(cells.rows_north, cells.north_up ? -1.0 : 1.0);
  return cells;
}

}  // namespace rockyard::campaign
