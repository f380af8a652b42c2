#include "trial/course/site_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "terrain/rock.h"

namespace rockyard::trial {
namespace {

constexpr int kSamplesPerSide = 5;  // along each side of a cell

// What the places of one cell show.
struct CellSum {
  double height_m = 0.0;
  int on_rock = 0;
};

// Returns the rocks that may reach into a cell and are large enough to be told apart.
std::vector<terrain::RockShape> RocksSeen(const terrain::Terrain& terrain, double x0_m, double y0_m,
                                          const SiteMapParams& params) {
  const double half_m = 0.5 * params.cell_m;
  std::vector<int> near;
  terrain.RocksNear(x0_m + half_m, y0_m + half_m, std::numbers::sqrt2 * half_m, near);
  std::vector<terrain::RockShape> seen;
  for (const int index : near) {
    const terrain::Rock& rock = terrain.rocks()[static_cast<std::size_t>(index)];
    if (rock.diameter_m >= params.min_rock_m) seen.emplace_back(rock);
  }
  return seen;
}

CellSum SampleCell(const terrain::Terrain& terrain, double x0_m, double y0_m,
                   const SiteMapParams& params) {
  CellSum sum;
  const double step_m = params.cell_m / kSamplesPerSide;
  const std::vector<terrain::RockShape> rocks = RocksSeen(terrain, x0_m, y0_m, params);
  for (int iy = 0; iy < kSamplesPerSide; ++iy) {
    for (int ix = 0; ix < kSamplesPerSide; ++ix) {
      const double x_m = x0_m + (ix + 0.5) * step_m;
      const double y_m = y0_m + (iy + 0.5) * step_m;
      const double height_m = terrain.Height(x_m, y_m);
      sum.height_m += height_m / (kSamplesPerSide * kSamplesPerSide);
      const double ground_m = terrain.ground().Height(x_m, y_m);
      if (std::any_of(rocks.begin(), rocks.end(), [&](const terrain::RockShape& rock) {
            return rock.Top(x_m, y_m) > ground_m;
          })) {
        ++sum.on_rock;
      }
    }
  }
  return sum;
}

}  // namespace

std::shared_ptr<const messages::SiteMap> MakeSiteMap(const CourseParams& course,
                                                     const terrain::Terrain& terrain,
                                                     core::TrialKey key) {
  const SiteMapParams& params = course.site_map;
  if (params.kind == SiteMapKind::kNone) return nullptr;
  std::vector<messages::Goal> places = course.Goals();
  places.push_back({course.start_x_m, course.start_y_m});
  const auto by_x = [](const auto& a, const auto& b) { return a.x_m < b.x_m; };
  const auto by_y = [](const auto& a, const auto& b) { return a.y_m < b.y_m; };
  const auto [west, east] = std::ranges::minmax(places, by_x);
  const auto [south, north] = std::ranges::minmax(places, by_y);
  core::RandomStream shifts(key, core::Purpose::kSiteMap, 0);
  const double shift_x_m = core::SampleNormal(shifts, 0.0, params.shift_sd_m);
  const double shift_y_m = core::SampleNormal(shifts, 0.0, params.shift_sd_m);
  auto map = std::make_shared<messages::SiteMap>();
  const auto cells = [&](double size_m) {
    const double count = std::ceil((size_m + 2.0 * params.margin_m) / params.cell_m);
    return std::max(1, static_cast<int>(count));
  };
  map->x0_m = west.x_m - params.margin_m;
  map->y0_m = south.y_m - params.margin_m;
  map->step_m = params.cell_m;
  map->nx = cells(east.x_m - west.x_m);
  map->ny = cells(north.y_m - south.y_m);
  map->height_sd_m = params.height_sd_m;
  const bool heights = params.kind != SiteMapKind::kRocks;
  const bool rocks = params.kind != SiteMapKind::kElevation;
  core::RandomStream errors(key, core::Purpose::kSiteMap, 1);
  for (int iy = 0; iy < map->ny; ++iy) {
    for (int ix = 0; ix < map->nx; ++ix) {
      // A map that lies off by the shift shows at a place what is truly a shift away.
      const CellSum sum = SampleCell(terrain, map->x0_m + ix * map->step_m - shift_x_m,
                                     map->y0_m + iy * map->step_m - shift_y_m, params);
      if (heights) {
        map->height_m.push_back(sum.height_m + core::SampleNormal(errors, 0.0, params.height_sd_m));
      }
      if (rocks)
        map->rock_share.push_back(sum.on_rock /
                                  static_cast<double>(kSamplesPerSide * kSamplesPerSide));
    }
  }
  return map;
}

}  // namespace rockyard::trial
