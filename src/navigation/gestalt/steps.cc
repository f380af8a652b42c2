#include "navigation/gestalt/steps.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace rockyard::navigation {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// Replaces value i by the extreme of the `span` values from it on with the given stride, for all i
// below `count`; values behind must exist. Works upwards in place, as it only looks ahead.
// Doubling: a span of 2 k is two spans of k, a span of k + m two overlapping ones.
template <typename Better>
void SpanExtremes(std::vector<double>& values, std::size_t stride, int span, Better better) {
  int covered = 1;
  // Each value holds the extreme of `covered` values from it on; in the last round the two spans
  // overlap, which does an extreme no harm.
  while (covered < span) {
    const int step = std::min(covered, span - covered);
    const std::size_t ahead = stride * static_cast<std::size_t>(step);
    double* value = values.data();
    const std::size_t count = values.size() - ahead;
    for (std::size_t i = 0; i < count; ++i) value[i] = better(value[i], value[i + ahead]);
    covered += step;
  }
}

}  // namespace

void PatchSteps::LoadElevations(const CellWindow& cells, const CellBox& box, PatchReach reach) {
  // Padded by twice the reach: patches of cells around the box reach in, and spans look ahead only.
  width_ = box.x_end - box.x + 4 * reach.x;
  height_ = box.y_end - box.y + 4 * reach.y;
  const std::size_t size = CellIndex(0, height_, width_);
  highest_.assign(size, -kNone);
  lowest_.assign(size, kNone);
  for (int iy = box.y; iy < box.y_end; ++iy) {
    std::size_t i = CellIndex(2 * reach.x, iy - box.y + 2 * reach.y, width_);
    for (int ix = box.x; ix < box.x_end; ++ix, ++i) {
      const math::PointMoments& moments = cells.At(ix, iy).moments;
      if (moments.empty()) continue;
      highest_[i] = lowest_[i] = moments.MeanZ_m();
    }
  }
}

void PatchSteps::Find(const CellWindow& cells, const CellBox& box, PatchReach reach) {
  steps_.assign(CellIndex(0, cells.ny(), cells.nx()), 0.0);
  if (box.empty()) return;
  LoadElevations(cells, box, reach);
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  const auto smaller = [](double a, double b) { return a < b ? a : b; };
  const auto row = static_cast<std::size_t>(width_);
  SpanExtremes(highest_, row, 2 * reach.y + 1, larger);
  SpanExtremes(lowest_, row, 2 * reach.y + 1, smaller);
  SpanExtremes(highest_, 1, 2 * reach.x + 1, larger);
  SpanExtremes(lowest_, 1, 2 * reach.x + 1, smaller);
  // Value (i, j) now belongs to the patch whose middle is cell (i, j) - reach of the box.
  const CellBox out = box.Grown(reach.x, reach.y, cells.nx(), cells.ny());
  for (int iy = out.y; iy < out.y_end; ++iy) {
    for (int ix = out.x; ix < out.x_end; ++ix) {
      const std::size_t i = CellIndex(ix - box.x + reach.x, iy - box.y + reach.y, width_);
      // e of step 3, m. A patch without points has -infinity here.
      const double step = highest_[i] - lowest_[i];
      steps_[CellIndex(ix, iy, cells.nx())] = step > 0.0 ? step : 0.0;
    }
  }
}

double PatchSteps::StepFrom(const PatchPlane& plane, const CellBox& patch) const {
  double highest = -kNone;
  double lowest = kNone;
  for (int iy = patch.y; iy < patch.y_end; ++iy) {
    for (int ix = patch.x; ix < patch.x_end; ++ix) {
      const std::size_t i = CellIndex(ix, iy, columns_);
      if (!has_data_[i]) continue;
      const math::Vector3& p = means_[i];
      const double above = p.z() - plane.rise_x * p.x() - plane.rise_y * p.y();
      highest = std::max(highest, above);
      lowest = std::min(lowest, above);
    }
  }
  return highest > lowest ? highest - lowest : 0.0;
}

void PatchSteps::FindFromPlanes(const CellWindow& cells, const CellBox& box, PatchReach reach,
                                const std::vector<PatchPlane>& planes) {
  Find(cells, box, reach);
  columns_ = cells.nx();
  has_data_.assign(steps_.size(), false);
  means_.resize(steps_.size());
  for (int iy = box.y; iy < box.y_end; ++iy) {
    for (int ix = box.x; ix < box.x_end; ++ix) {
      const math::PointMoments& moments = cells.At(ix, iy).moments;
      if (moments.empty()) continue;
      const std::size_t i = CellIndex(ix, iy, columns_);
      has_data_[i] = true;
      means_[i] = math::Spread(moments).mean_m;
    }
  }
  const CellBox out = box.Grown(reach.x, reach.y, cells.nx(), cells.ny());
  for (int iy = out.y; iy < out.y_end; ++iy) {
    for (int ix = out.x; ix < out.x_end; ++ix) {
      const std::size_t i = CellIndex(ix, iy, columns_);
      if (!planes[i].plane_valid) continue;
      const CellBox patch =
          CellBox{ix, ix + 1, iy, iy + 1}.Grown(reach.x, reach.y, cells.nx(), cells.ny());
      steps_[i] = StepFrom(planes[i], patch);
    }
  }
}

}  // namespace rockyard::navigation
