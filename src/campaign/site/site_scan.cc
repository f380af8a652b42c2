#include "campaign/site/site_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "campaign/site/height_unit.h"
#include "campaign/site/site_place.h"
#include "core/error.h"

namespace rockyard::campaign {
namespace {

using image_files::RasterWindow;

constexpr std::int64_t kFewestScanned = 10;

bool Holds(const std::optional<Range>& range, double value) {
  return !range || (value >= range->low && value <= range->high);
}

bool Overlap(const RasterWindow& a, const RasterWindow& b) {
  return a.row < b.row + b.rows && b.row < a.row + a.rows && a.column < b.column + b.columns &&
         b.column < a.column + a.columns;
}

// Distance from what is wanted, in thousandths of a degree, so that last bits decide nothing.
double OffOf(const ScanRequest& request, const ScannedSite& site) {
  const double wanted_deg =
      request.median ? 0.5 * (request.median->low + request.median->high) : 0.0;
  return std::round(1000.0 * std::abs(site.slopes.median_deg - wanted_deg));
}

class SiteScanner {
 public:
  explicit SiteScanner(const ScanRequest& request)
      : request_(request),
        raster_(image_files::OpenElevation(request.file)),
        plane_(*raster_, request.cell_m, request.by_map) {
    const auto& info = raster_->info();
    plane_.TouchPixel(
        {0.5 * static_cast<double>(info.columns - 1), 0.5 * static_cast<double>(info.rows - 1)});
    scan_.cell_m = plane_.CellsAt(0.5 * request.size_m).side_m;
    std::vector<std::string> notes;
    unit_m_ = HeightUnit_m(info, raster_->name(), request.height_scale, notes);
    const double cells = std::floor(request.size_m / scan_.cell_m + 1e-6) + 1.0;
    // Written so that what is no number fails too.
    if (!(cells >= kFewestScanned)) {
      throw core::UserError(
          "--size", fmt::format("takes windows of {:.0f} cells of {:.3g} m", cells, scan_.cell_m),
          "use ten cells at least");
    }
    if (!(cells <= static_cast<double>(std::min(info.rows, info.columns)))) {
      throw core::UserError("--size",
                            fmt::format("is larger than {}: {} x {} cells of {:.3g} m",
                                        raster_->name(), info.rows, info.columns, scan_.cell_m),
                            "use a smaller one");
    }
    side_ = static_cast<std::int64_t>(cells);
    if (side_ > image_files::kMostWindowCells / info.columns) {
      throw core::UserError("--size", "takes windows that are too large to be looked at",
                            "use a smaller one");
    }
  }

  SiteScan Scan() {
    const auto& info = raster_->info();
    const std::int64_t step = side_ / 2;
    for (std::int64_t row = 0; row + side_ <= info.rows; row += step) {
      const std::vector<double> strip = raster_->Read({row, 0, side_, info.columns});
      for (std::int64_t column = 0; column + side_ <= info.columns; column += step) {
        LookAt(strip, {row, column, side_, side_});
      }
    }
    Pick();
    return std::move(scan_);
  }

 private:
  void LookAt(const std::vector<double>& strip, const RasterWindow& window) {
    ++scan_.windows;
    HeightGrid grid{scan_.cell_m, side_, side_, {}};
    grid.heights_m.reserve(static_cast<std::size_t>(side_ * side_));
    for (std::int64_t r = 0; r < side_; ++r) {
      const auto first = strip.begin() + (r * raster_->info().columns + window.column);
      std::transform(first, first + side_, std::back_inserter(grid.heights_m),
                     [&](double height) { return unit_m_ * height; });
    }
    if (CountMissing(grid.heights_m) > 0) {
      ++scan_.incomplete;
      return;
    }
    const auto [lowest, highest] = std::ranges::minmax(grid.heights_m);
    ScannedSite site{window, "", SlopesOf(grid), highest - lowest};
    if (Holds(request_.median, site.slopes.median_deg) &&
        Holds(request_.high, site.slopes.high_deg)) {
      found_.push_back(std::move(site));
    }
  }

  void Pick() {
    std::ranges::stable_sort(found_, {}, [&](const ScannedSite& site) {
      return std::pair(OffOf(request_, site), site.slopes.high_deg);
    });
    for (ScannedSite& site : found_) {
      if (std::ssize(scan_.sites) >= request_.count) return;
      const bool taken = std::ranges::any_of(scan_.sites, [&](const ScannedSite& other) {
        return Overlap(site.window, other.window);
      });
      if (taken) continue;
      const std::int64_t before = (side_ - 1) / 2;
      plane_.TouchPixel({static_cast<double>(site.window.column + before),
                         static_cast<double>(site.window.row + before)});
      site.place = plane_.PlaceOption();
      scan_.sites.push_back(std::move(site));
    }
  }

  const ScanRequest& request_;
  std::unique_ptr<image_files::ElevationRaster> raster_;
  SitePlane plane_;
  double unit_m_ = 1.0;
  std::int64_t side_ = 0;
  std::vector<ScannedSite> found_;
  SiteScan scan_;
};

}  // namespace

SiteScan ScanSites(const ScanRequest& request) { return SiteScanner(request).Scan(); }

}  // namespace rockyard::campaign
