#include "campaign/site/elevation_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "campaign/site/height_unit.h"
#include "core/error.h"
#include "core/numbers.h"
#include "math/functions.h"

namespace rockyard::campaign {
namespace {

using image_files::ElevationRaster;
using image_files::LocalPoint;
using image_files::RasterWindow;

constexpr std::int64_t kFewestNodes = 4;

std::string WindowText(const RasterWindow& window) {
  return fmt::format("{},{},{},{}", window.row, window.column, window.rows, window.columns);
}

bool LiesWithin(const RasterWindow& window, const ElevationRaster& raster) {
  return window.row >= 0 && window.column >= 0 && window.rows > 0 && window.columns > 0 &&
         window.rows <= raster.info().rows && window.columns <= raster.info().columns &&
         window.row <= raster.info().rows - window.rows &&
         window.column <= raster.info().columns - window.columns;
}

// The cell in the middle, or before it.
PixelPoint MiddleOf(const RasterWindow& window) {
  const std::int64_t rows_before = (window.rows - 1) / 2;
  const std::int64_t columns_before = (window.columns - 1) / 2;
  return {static_cast<double>(window.column + columns_before),
          static_cast<double>(window.row + rows_before)};
}

// The part of the file that a site comes from, and how.
class SiteReader {
 public:
  explicit SiteReader(const ElevationRequest& request)
      : request_(request),
        raster_(image_files::OpenElevation(request.file)),
        plane_(*raster_, request.cell_m, request.by_map) {}

  SiteElevation Read() {
    LayPlane();
    const double unit_m =
        HeightUnit_m(raster_->info(), raster_->name(), request_.height_scale, site_.notes);
    if (cells_.aligned) {
      TakeNodes();
    } else {
      Resample();
    }
    if (CountMissing(site_.grid.heights_m) > 0) CureMissing();
    Finish(unit_m);
    return std::move(site_);
  }

 private:
  void LayPlane() {
    if (request_.crop && request_.at) {
      throw core::UserError("--at", "and --crop both name a part", "leave one of them out");
    }
    window_ =
        request_.crop.value_or(RasterWindow{0, 0, raster_->info().rows, raster_->info().columns});
    if (!LiesWithin(window_, *raster_)) {
      throw core::UserError(
          "--crop",
          fmt::format("is not within the {} rows and {} columns of {}", raster_->info().rows,
                      raster_->info().columns, raster_->name()),
          "use ROW,COLUMN,ROWS,COLUMNS, rows and columns from 0");
    }
    if (request_.at) {
      CheckPlace();
      plane_.Touch(*request_.at);
    } else {
      plane_.TouchPixel(MiddleOf(window_));
    }
    cells_ = plane_.CellsAt(0.5 * request_.size_m);
    if (!(cells_.side_m > 0.0) || !std::isfinite(cells_.side_m)) {
      throw core::UserError(request_.at ? "--at" : raster_->name(),
                            "names a place with no cells of any size", "check the place");
    }
    if (request_.at) WindowAround();
    if (std::min(window_.rows, window_.columns) < kFewestNodes) {
      throw core::UserError(request_.at ? "--size" : "--crop",
                            fmt::format("takes {} x {} nodes of {:.3g} m", window_.rows,
                                        window_.columns, cells_.side_m),
                            "take at least 4 x 4");
    }
    if (window_.rows > kMostNodes / window_.columns) {
      throw core::UserError(
          raster_->name(),
          fmt::format("has {} x {} cells in that part, more than {} in all", window_.rows,
                      window_.columns, kMostNodes),
          "name a smaller part: --at with --size 60, --crop, or find one by --scan-sites");
    }
  }

  void CheckPlace() const {
    const auto& [first, second] = *request_.at;
    if (plane_.frame() == SiteFrame::kGeographic &&
        !(std::abs(first) <= 90.0 && std::abs(second) <= 360.0)) {
      throw core::UserError("--at", "is no latitude and longitude",
                            "give degrees, the latitude first, or --crs map with x and y");
    }
  }

  // As many nodes as a square of that size has, an odd number, around the place.
  void WindowAround() {
    const PixelPoint middle = plane_.Pixels(std::array{LocalPoint{}}).front();
    const double half = std::floor(0.5 * request_.size_m / cells_.side_m + 1e-6);
    // Written so that what is no number fails too.
    if (!(std::abs(middle.row) < 1e9 && std::abs(middle.column) < 1e9 && half < 1e6)) {
      FailOutside();
    }
    const auto each_way = static_cast<std::int64_t>(half);
    window_ = {std::llround(middle.row) - each_way, std::llround(middle.column) - each_way,
               2 * each_way + 1, 2 * each_way + 1};
    if (cells_.aligned && !LiesWithin(window_, *raster_)) FailOutside();
  }

  [[noreturn]] void FailOutside() {
    const auto& info = raster_->info();
    SitePlane middle(*raster_, request_.cell_m, request_.by_map);
    middle.TouchPixel(
        {0.5 * static_cast<double>(info.columns - 1), 0.5 * static_cast<double>(info.rows - 1)});
    throw core::UserError(
        request_.at ? "--at" : "--crop",
        fmt::format("asks for {:g} m around {}, not all of which lies in {}", request_.size_m,
                    plane_.PlaceText(), raster_->name()),
        fmt::format("use a smaller --size, or a place nearer to the middle of the file: --at {}",
                    middle.PlaceOption()));
  }

  void TakeNodes() {
    std::vector<double> heights = raster_->Read(window_);
    site_.grid = {cells_.side_m, window_.rows, window_.columns, std::move(heights)};
    if (cells_.north_up) {  // rows of the file go south
      for (std::int64_t r = 0; r < window_.rows / 2; ++r) {
        std::swap_ranges(&site_.grid.At(0, r), &site_.grid.At(0, r) + window_.columns,
                         &site_.grid.At(0, window_.rows - 1 - r));
      }
    }
    site_.origin_column = (window_.columns - 1) / 2;
    const std::int64_t row_in_window = (window_.rows - 1) / 2;
    site_.origin_row = cells_.north_up ? window_.rows - 1 - row_in_window : row_in_window;
    source_window_ = window_;
    origin_ = {static_cast<double>(window_.column + site_.origin_column),
               static_cast<double>(window_.row + row_in_window)};
  }

  void Resample() {
    site_.resampled = true;
    site_.grid = {cells_.side_m, window_.rows, window_.columns, {}};
    site_.origin_column = (window_.columns - 1) / 2;
    site_.origin_row = (window_.rows - 1) / 2;
    std::vector<LocalPoint> nodes;
    for (std::int64_t r = 0; r < window_.rows; ++r) {
      for (std::int64_t c = 0; c < window_.columns; ++c) {
        nodes.push_back({static_cast<double>(c - site_.origin_column) * cells_.side_m,
                         static_cast<double>(r - site_.origin_row) * cells_.side_m});
      }
    }
    const std::vector<PixelPoint> pixels = plane_.Pixels(nodes);
    origin_ = plane_.Pixels(std::array{LocalPoint{}}).front();
    source_window_ = WindowOf(pixels);
    const std::vector<double> heights = raster_->Read(source_window_);
    site_.grid.heights_m.reserve(pixels.size());
    for (const PixelPoint& pixel : pixels) {
      site_.grid.heights_m.push_back(
          CubicAt(heights, source_window_.columns,
                  pixel.column - static_cast<double>(source_window_.column),
                  pixel.row - static_cast<double>(source_window_.row)));
    }
    site_.notes.push_back(
        fmt::format("the file's cells are no squares of east and north there ({:.4g} x {:.4g} "
                    "cells per m): its "
                    "heights were interpolated (cubic) to nodes of {:.4g} m",
                    math::Hypot(cells_.columns_east, cells_.rows_east),
                    math::Hypot(cells_.columns_north, cells_.rows_north), cells_.side_m));
  }

  // The part of the file that nodes are interpolated from.
  RasterWindow WindowOf(const std::vector<PixelPoint>& pixels) {
    double rows[2] = {core::kInfinity, -core::kInfinity};
    double columns[2] = {core::kInfinity, -core::kInfinity};
    for (const PixelPoint& pixel : pixels) {
      rows[0] = std::min(rows[0], pixel.row);
      rows[1] = std::max(rows[1], pixel.row);
      columns[0] = std::min(columns[0], pixel.column);
      columns[1] = std::max(columns[1], pixel.column);
    }
    const auto last_row = static_cast<double>(raster_->info().rows - 1);
    const auto last_column = static_cast<double>(raster_->info().columns - 1);
    constexpr double kOnEdge = 1e-6;
    if (!(rows[0] >= -kOnEdge && columns[0] >= -kOnEdge && rows[1] <= last_row + kOnEdge &&
          columns[1] <= last_column + kOnEdge)) {
      FailOutside();
    }
    const double top = std::max(0.0, std::floor(rows[0]) - 1.0);
    const double left = std::max(0.0, std::floor(columns[0]) - 1.0);
    const double bottom = std::min(last_row, std::floor(rows[1]) + 2.0);
    const double right = std::min(last_column, std::floor(columns[1]) + 2.0);
    const RasterWindow window{static_cast<std::int64_t>(top), static_cast<std::int64_t>(left),
                              static_cast<std::int64_t>(bottom - top) + 1,
                              static_cast<std::int64_t>(right - left) + 1};
    if (window.rows > image_files::kMostWindowCells / window.columns) {
      throw core::UserError(raster_->name(), "would have to be read in too large a part",
                            "use a smaller --size or --crop");
    }
    return window;
  }

  void CureMissing() {
    const std::int64_t missing = CountMissing(site_.grid.heights_m);
    const std::string what = fmt::format("has no data at {} of the {} nodes of that part", missing,
                                         site_.grid.heights_m.size());
    if (!request_.fill) {
      throw core::UserError(raster_->name(), what, NearestText() + ", or fill small gaps: --fill");
    }
    const std::optional<std::int64_t> filled = FillGaps(site_.grid);
    if (!filled) {
      throw core::UserError(
          raster_->name(),
          what + fmt::format(", in gaps of more than {} cells or more than {:.0f} % in all",
                             kWidestGap_cells, 100.0 * kMostMissingShare),
          NearestText());
    }
    site_.filled = *filled;
    site_.notes.push_back(fmt::format(
        "{} nodes without data were filled, each with the mean of its neighbours (Laplace's "
        "equation)",
        *filled));
  }

  // Says where the nearest part of this size lies that has all its data.
  std::string NearestText() {
    const auto& info = raster_->info();
    RasterWindow around = source_window_;
    const std::int64_t reach = std::max(around.rows, around.columns);
    const auto widen = [](std::int64_t& first, std::int64_t& count, std::int64_t by,
                          std::int64_t all) {
      const std::int64_t last = std::min(all, first + count + by);
      first = std::max<std::int64_t>(0, first - by);
      count = last - first;
    };
    for (int i = 0; i < 3; ++i) {
      RasterWindow wider = around;
      widen(wider.row, wider.rows, reach, info.rows);
      widen(wider.column, wider.columns, reach, info.columns);
      if (wider.rows > image_files::kMostWindowCells / wider.columns) break;
      around = wider;
    }
    // Between cells a part of this size may take a cell more on either side.
    RasterWindow wanted = source_window_;
    if (!cells_.aligned) {
      wanted = {wanted.row - 1, wanted.column - 1, wanted.rows + 2, wanted.columns + 2};
    }
    const auto clean = NearestClean(raster_->Read(around), around, wanted);
    if (!clean) {
      return fmt::format("take a smaller part: none of this size within {} cells has all its data",
                         3 * reach);
    }
    if (cells_.aligned) {
      return fmt::format("take the nearest part with all its data: --crop {}", WindowText(*clean));
    }
    SitePlane there(*raster_, request_.cell_m, request_.by_map);
    there.TouchPixel(
        {static_cast<double>(clean->column) + 0.5 * static_cast<double>(clean->columns),
         static_cast<double>(clean->row) + 0.5 * static_cast<double>(clean->rows)});
    return fmt::format("take the nearest part with all its data: --at {} --size {:.4g}",
                       there.PlaceOption(),
                       cells_.side_m * static_cast<double>(site_.grid.rows - 1));
  }

  void Finish(double unit_m) {
    constexpr double kSteps_per_m = 1e4;
    HeightGrid& grid = site_.grid;
    site_.origin_height_m = unit_m * grid.At(site_.origin_column, site_.origin_row);
    double highest_m = 0.0;
    for (double& height : grid.heights_m) {
      height =
          std::round((unit_m * height - site_.origin_height_m) * kSteps_per_m) / kSteps_per_m + 0.0;
      highest_m = std::max(highest_m, std::abs(height));
    }
    constexpr double kHighest_m = 10000.0;
    if (!(highest_m <= kHighest_m)) {
      throw core::UserError(raster_->name(),
                            fmt::format("has heights that differ by {:.3g} m", highest_m),
                            "check the unit of its heights: --height-scale gives metres per unit");
    }
    site_.from_map = plane_.FromMap(origin_, 0.5 * request_.size_m);
    if (raster_->HasFrame()) {
      site_.from_geographic = plane_.FromGeographic(origin_, 0.5 * request_.size_m);
    }
    site_.notes.emplace_back("heights are rounded to 0.1 mm and relative to that at the origin");
    site_.source =
        fmt::format("{} ({}): rows {} to {}, columns {} to {}; origin at {}, height {:.3f} m",
                    request_.file.filename().string(), raster_->info().format, source_window_.row,
                    source_window_.row + source_window_.rows - 1, source_window_.column,
                    source_window_.column + source_window_.columns - 1, plane_.PlaceText(),
                    site_.origin_height_m);
  }

  const ElevationRequest& request_;
  std::unique_ptr<ElevationRaster> raster_;
  SitePlane plane_;
  SitePlane::Cells cells_;
  RasterWindow window_;         // of the size of the grid
  RasterWindow source_window_;  // of the file, that the grid comes from
  PixelPoint origin_;           // of the world
  SiteElevation site_;
};

}  // namespace

SiteElevation ReadElevation(const ElevationRequest& request) { return SiteReader(request).Read(); }

}  // namespace rockyard::campaign
