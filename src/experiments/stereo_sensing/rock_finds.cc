#include "experiments/stereo_sensing/rock_finds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "experiments/stereo_sensing/look_map.h"

namespace rockyard::experiments {
namespace {

using math::Vector3;

// Of a rock, what both eyes see.
struct VisiblePart {
  std::int64_t pixels = 0;
  Vector3 sum_R = Vector3::Zero();
  double range_sum_m = 0.0;
};

std::vector<VisiblePart> VisibleParts(std::size_t rocks, const sensing::StereoTruth& truth,
                                      const sensing::StereoView& view_R) {
  std::vector<VisiblePart> parts(rocks);
  const double scale_px_m = view_R.focal_px * view_R.baseline_m;
  for (int row = 0; row < view_R.rows; ++row) {
    for (int column = 0; column < view_R.columns; ++column) {
      const int rock = truth.rocks(row, column);
      const double disparity_px = truth.both_px(row, column);
      if (rock < 0 || disparity_px <= 0.0) continue;
      const Vector3 p_EP_R = view_R.Ray(column, row) * (scale_px_m / disparity_px);
      VisiblePart& part = parts[static_cast<std::size_t>(rock)];
      ++part.pixels;
      part.sum_R += view_R.eye + p_EP_R;
      part.range_sum_m += p_EP_R.norm();
    }
  }
  return parts;
}

// The class of a height, in halves of the hazard's; none below one half.
RockSums* ClassOf(double height_m, double hazard_height_m, StereoSums& sums) {
  const auto halves = static_cast<std::int64_t>(std::floor(2.0 * height_m / hazard_height_m));
  if (halves < 1) return nullptr;
  const auto last = static_cast<std::int64_t>(kRockHeights.size());
  return &sums.rocks[static_cast<std::size_t>(std::min(halves, last) - 1)];
}

}  // namespace

void AddRocksInView(const StereoSensingParams& params, const terrain::Terrain& terrain,
                    const sensing::StereoTruth& truth, const sensing::StereoView& view_R,
                    const LookMaps& maps, const DistanceBin& bin, StereoSums& sums) {
  const auto rocks = terrain.rocks();
  const std::vector<VisiblePart> parts = VisibleParts(rocks.size(), truth, view_R);
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    if (parts[i].pixels < params.min_rock_pixels) continue;
    RockSums* counted = ClassOf(rocks[i].height_m, params.hazard_height_m, sums);
    const auto pixels = static_cast<double>(parts[i].pixels);
    if (counted == nullptr || !bin.Holds(parts[i].range_sum_m / pixels)) continue;
    const Vector3 middle_R = parts[i].sum_R / pixels;
    const auto finds = [&](const messages::MapView& map) {
      return VerdictAt(map, middle_R.x(), middle_R.y(), params.hazard_goodness) == Verdict::kHazard;
    };
    counted->rocks += 1.0;
    if (finds(maps.perfect)) counted->perfect += 1.0;
    if (finds(maps.seen)) counted->found += 1.0;
  }
}

void AddCellsOfMap(const StereoSensingParams& params, const sensing::StereoView& view_R,
                   const LookMaps& maps, const DistanceBin& bin, StereoSums& sums) {
  const messages::MapView& grid = maps.perfect;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const Vector3 middle_R(grid.x0_m + (ix + 0.5) * grid.xstep_m,
                             grid.y0_m + (iy + 0.5) * grid.ystep_m, 0.0);
      if (!bin.Holds((middle_R - view_R.eye).norm())) continue;
      const auto verdict = [&](const messages::MapView& map) {
        return VerdictAt(map, middle_R.x(), middle_R.y(), params.hazard_goodness);
      };
      const Verdict perfect = verdict(maps.perfect);
      if (perfect == Verdict::kUnknown) continue;
      const Verdict seen = verdict(maps.seen);
      if (perfect == Verdict::kHazard) {
        sums.hazard_cells += 1.0;
        if (seen == Verdict::kHazard) sums.hazard_found += 1.0;
        continue;
      }
      sums.clear_cells += 1.0;
      if (seen != Verdict::kUnknown) sums.clear_known += 1.0;
      if (seen == Verdict::kHazard) sums.imagined += 1.0;
    }
  }
}

}  // namespace rockyard::experiments
