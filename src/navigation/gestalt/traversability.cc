#include "navigation/gestalt/traversability.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "navigation/gestalt/step_lanes.h"

namespace rockyard::navigation {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// Replaces value i by the extreme of the `span` values from it on with the given stride, for all i
// below `count`; values behind must exist. Works upwards in place, as it only looks ahead. It
// doubles: a span of 2 k is two spans of k, a span of k + m two overlapping spans of k.
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

// Returns a goodness in [0, 255] as 8 bits: to the nearest, halves up. The paper does not say how
// it rounds; cutting off would give up to one less.
std::int64_t ToGoodness(double goodness) { return std::lround(goodness); }

constexpr std::int64_t kBestGoodness = 255;

// Returns the goodness for the largest difference e of elevation in a patch: 127 (1 - min(1, e/h))
// from e = h/3 on, and not below `obstacle`; below h/3 there is no hazard.
std::int64_t StepGoodness(double step_m, double h_m, std::int64_t obstacle) {
  if (step_m < h_m / 3.0) return kBestGoodness;
  return std::max(obstacle, ToGoodness(127.0 * (1.0 - std::min(1.0, step_m / h_m))));
}

// Returns the goodness for the residual r of a patch's plane, with the fraction f: from r = f h/3
// on 255 (1 - min(1, f r/h)) as printed, or 255 (1 - min(1, r/(f h))), and not below `obstacle`.
std::int64_t RoughnessGoodness(double residual_m, double h_m, double fraction,
                               RoughnessFormula formula, std::int64_t obstacle) {
  if (residual_m < fraction * h_m / 3.0) return kBestGoodness;
  const double ratio = formula == RoughnessFormula::kAsPrinted ? fraction * residual_m / h_m
                                                               : residual_m / (fraction * h_m);
  return std::max(obstacle, ToGoodness(255.0 * (1.0 - std::min(1.0, ratio))));
}

// Returns the goodness for the slope s of a patch's plane: 255 (1 - min(1, s/max_pitch)), at every
// slope, and not below `obstacle`.
std::int64_t PitchGoodness(double slope_rad, double max_pitch_rad, std::int64_t obstacle) {
  return std::max(obstacle, ToGoodness(255.0 * (1.0 - std::min(1.0, slope_rad / max_pitch_rad))));
}

constexpr std::int64_t kFullCertainty = 255;

CellValue ToCell(const GoodnessPair& pair, bool known) {
  return {static_cast<std::uint8_t>(pair.goodness), static_cast<std::uint8_t>(pair.certainty),
          known};
}

// Returns whether one of the neighbours of cell (ix, iy) is unknown; neighbours outside the grid
// are.
bool BordersUnknown(const GoodnessGrid& grid, int ix, int iy, BorderNeighbours neighbours) {
  if (ix == 0 || iy == 0 || ix == grid.nx - 1 || iy == grid.ny - 1) return true;
  const std::size_t width = static_cast<std::size_t>(grid.nx);
  const CellValue* cell = &grid.Cell(ix, iy);
  const CellValue* above = cell - width;
  const CellValue* below = cell + width;
  const bool four = cell[-1].known && cell[1].known && above->known && below->known;
  if (neighbours == BorderNeighbours::kFour) return !four;
  return !(four && above[-1].known && above[1].known && below[-1].known && below[1].known);
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

void PatchSteps::LoadMeans(const CellWindow& cells, const CellBox& box, PatchReach reach) {
  constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();
  const std::size_t size = CellIndex(0, height_, width_) + kRoom;
  for (std::vector<double>& means : means_m_) means.assign(size, kNoData);
  for (int iy = box.y; iy < box.y_end; ++iy) {
    std::size_t i = CellIndex(2 * reach.x, iy - box.y + 2 * reach.y, width_);
    for (int ix = box.x; ix < box.x_end; ++ix, ++i) {
      const math::PointMoments& moments = cells.At(ix, iy).moments;
      if (moments.empty()) continue;
      const math::Vector3 mean_m = math::Spread(moments).mean_m;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        means_m_[axis][i] = mean_m[static_cast<Eigen::Index>(axis)];
      }
    }
  }
}

void PatchSteps::FindFromPlanes(const CellWindow& cells, const CellBox& box, PatchReach reach,
                                const std::vector<PatchPlane>& planes) {
  Find(cells, box, reach);
  if (box.empty()) return;
  LoadMeans(cells, box, reach);
  const CellBox out = box.Grown(reach.x, reach.y, cells.nx(), cells.ny());
  const auto count = static_cast<std::size_t>(out.x_end - out.x);
  for (std::vector<double>* row : {&rise_x_, &rise_y_, &row_steps_m_}) row->resize(count + kRoom);
  for (int iy = out.y; iy < out.y_end; ++iy) {
    const std::size_t at = CellIndex(out.x, iy, cells.nx());
    const PatchPlane* row_planes = &planes[at];
    for (std::size_t i = 0; i < count; ++i) {
      rise_x_[i] = row_planes[i].rise_x;
      rise_y_[i] = row_planes[i].rise_y;
    }
    const std::size_t first = CellIndex(out.x - box.x + reach.x, iy - box.y + reach.y, width_);
    FindSteps({.means_m = {&means_m_[0][first], &means_m_[1][first], &means_m_[2][first]},
               .stride = static_cast<std::size_t>(width_),
               .columns = static_cast<std::size_t>(2 * reach.x + 1),
               .rows = static_cast<std::size_t>(2 * reach.y + 1),
               .rise_x = rise_x_.data(),
               .rise_y = rise_y_.data()},
              count, row_steps_m_.data());
    for (std::size_t i = 0; i < count; ++i) {
      if (row_planes[i].plane_valid) steps_[at + i] = row_steps_m_[i];
    }
  }
}

CellValue Traversability::Unknown() const {
  return ToCell(params_.rover.modelled ? params_.pairs.unknown : params_.pairs.unknown_rovers,
                false);
}

// The step hazard: 127 (1 - min(1, e/h)) from e = h/3 on. A mark of what the rover felt is a step
// obstacle.
std::int64_t Traversability::FromSteps(const PatchPlane& plane, double step_m) const {
  const std::int64_t obstacle = params_.pairs.step_obst.goodness;
  if (plane.marked) return obstacle;
  if (!params_.tests.step) return kBestGoodness;
  return StepGoodness(step_m, params_.HazardHeight_m(), obstacle);
}

// Returns whether anything could be said of the patch: enough data, and a plane or what FailedFit
// allows instead.
bool Traversability::IsKnown(const PatchPlane& plane, bool step_hazard) const {
  if (plane.marked) return true;
  if (!plane.enough) return false;
  if (plane.plane_valid) return true;
  if (params_.failed_fit == FailedFit::kUnknown) return false;
  if (params_.failed_fit == FailedFit::kStepOrUnknown) return step_hazard;
  const bool plane_tests = params_.tests.rough || params_.tests.pitch;
  return params_.tests.step || !plane_tests;
}

// Returns the least goodness of all hazards of the patch, with the certainty of that hazard's pair
// or full certainty.
CellValue Traversability::Value(const PatchPlane& plane, double step_m) const {
  // Whatever its steps, nothing is known of a patch with too little data.
  if (!plane.enough && !plane.marked) return Unknown();
  const GestaltPairParams& pairs = params_.pairs;
  const double h_m = params_.HazardHeight_m();
  GoodnessPair value{kBestGoodness, kFullCertainty};
  // The least goodness decides; of equals the first, in the order step, roughness, pitch.
  const auto apply = [&value](std::int64_t goodness, const GoodnessPair& pair) {
    if (goodness < value.goodness) value = {goodness, pair.certainty};
  };
  apply(FromSteps(plane, step_m), pairs.step_obst);
  if (!IsKnown(plane, value.goodness < kBestGoodness)) return Unknown();
  if (params_.tests.rough && plane.plane_valid) {
    apply(RoughnessGoodness(plane.residual_m, h_m, params_.roughness_fraction,
                            params_.roughness_formula, pairs.rough_obst.goodness),
          pairs.rough_obst);
  }
  if (params_.tests.pitch && plane.plane_valid) {
    apply(PitchGoodness(plane.slope_rad, params_.rover.max_pitch_rad, pairs.pitch_obst.goodness),
          pairs.pitch_obst);
  }
  if (params_.certainty == CellCertainty::kFull) value.certainty = kFullCertainty;
  return ToCell(value, true);
}

void Traversability::AddBorders(GoodnessGrid& grid) const {
  const GoodnessPair& border = params_.pairs.border;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      CellValue& cell = grid.cells[CellIndex(ix, iy, grid.nx)];
      // The border's goodness counts only where it is the least.
      if (!cell.known || cell.goodness <= border.goodness) continue;
      if (!BordersUnknown(grid, ix, iy, params_.border_neighbours)) continue;
      const bool full = params_.certainty == CellCertainty::kFull;
      cell = ToCell({border.goodness, full ? kFullCertainty : border.certainty}, true);
    }
  }
}

void Traversability::Assess(const std::vector<PatchPlane>& planes,
                            const std::vector<double>& steps_m, GoodnessGrid& grid) const {
  grid.unknown = Unknown();
  grid.cells.resize(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    // Without a model of the rover nothing can be judged (table 1's unknown-rovers pair).
    grid.cells[i] = params_.rover.modelled ? Value(planes[i], steps_m[i]) : grid.unknown;
  }
  if (params_.tests.border) AddBorders(grid);
}

}  // namespace rockyard::navigation
