#include "navigation/gestalt/planes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rockyard::navigation {
namespace {

// A cell whose mean is no farther from a plane is no outlier: this is the resolution of
// coordinates.
constexpr double kInPlane_m = 1e-6;

struct Farthest {
  std::size_t index = 0;
  double distance_m = -1.0;
};

Farthest FarthestFrom(const math::Vector3& normal, const math::Vector3& mean_m,
                      const std::vector<PatchCell>& cells) {
  Farthest farthest;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    // |n . (mean of the cell - mean of the patch)|: the plane passes through the patch's mean.
    const double distance_m = std::abs(normal.dot(cells[i].spread->mean_m - mean_m));
    // The first of equals is taken, so that trials repeat to the bit.
    if (distance_m > farthest.distance_m) farthest = {i, distance_m};
  }
  return farthest;
}

// Tolerance for shares such as 0.56 of 25 cells that should be whole numbers.
constexpr double kRounding = 1e-6;

// Smallest upward part of a normal that a rise is divided by; steeper planes (89 deg) count as so
// steep.
constexpr double kOnEnd = 0.0175;

// Returns how many cells on one side of the middle cell a square touches that is centred on it:
// ceil((side - step) / (2 step)). A side that ends at a cell's border does not touch the next cell.
int Reach(double side_m, double step_m) {
  return std::max(0, static_cast<int>(std::ceil(0.5 * (side_m - step_m) / step_m - kRounding)));
}

int AtLeast(double share, int count) {
  return static_cast<int>(std::ceil(share * count - kRounding));
}

}  // namespace

math::PointSpread SpreadOf(const std::vector<PatchCell>& cells, const math::PointMoments& sum) {
  // Exact sums where they cannot have run over, else cell by cell in floating point.
  if (sum.count() <= math::kExactPoints) return math::Spread(sum);
  std::vector<math::PointSpread> spreads;
  spreads.reserve(cells.size());
  for (const PatchCell& cell : cells) spreads.push_back(*cell.spread);
  return math::Merged(spreads);
}

math::PlaneFit FitWithoutOutliers(std::vector<PatchCell> cells, math::PointMoments sum,
                                  std::int64_t outliers) {
  for (std::int64_t left_out = 0;; ++left_out) {
    const math::PointSpread spread = SpreadOf(cells, sum);
    math::PlaneFit fit = math::FitPlane(spread.covariance_m2);
    if (left_out == outliers) return fit;
    // The last cell lies in its own plane.
    const Farthest worst = FarthestFrom(fit.normal, spread.mean_m, cells);
    // Leaving it out would change nothing but the number of points.
    if (worst.distance_m < kInPlane_m) return fit;
    // Whole numbers: taking a cell back is exact.
    sum -= *cells[worst.index].moments;
    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(worst.index));
  }
}

PatchReach ReachOf(const GestaltMapParams& params) {
  return {Reach(params.PatchSide_m(), params.grid.xstep_m),
          Reach(params.PatchSide_m(), params.grid.ystep_m)};
}

PatchPlanes::PatchPlanes(const GestaltMapParams& params)
    : params_(params), reach_(ReachOf(params)) {
  const int columns = 2 * reach_.x + 1;
  const int rows = 2 * reach_.y + 1;
  // Shares of table 1 as numbers of cells, columns and rows of a full patch, rounded up.
  needed_cells_ = static_cast<std::uint64_t>(AtLeast(params.min_patch_share, columns * rows));
  needed_columns_ = AtLeast(params.min_cell_coverage, columns);
  needed_rows_ = AtLeast(params.min_cell_coverage, rows);
}

PatchPlanes::Sums& PatchPlanes::Sums::operator+=(const Sums& other) {
  moments += other.moments;
  filled += other.filled;
  marked += other.marked;
  return *this;
}

PatchPlanes::Sums& PatchPlanes::Sums::operator-=(const Sums& other) {
  moments -= other.moments;
  filled -= other.filled;
  marked -= other.marked;
  return *this;
}

std::uint64_t PatchPlanes::IsFilled(const MapCell& cell) const {
  return cell.moments.count() >= params_.min_cell_points ? 1U : 0U;
}

void PatchPlanes::Fit(const CellWindow& cells, const CellBox& box) {
  width_ = cells.nx();
  planes_.assign(CellIndex(0, cells.ny(), width_), {});
  spreads_.clear();
  if (box.empty()) return;
  const CellBox out = box.Grown(reach_.x, reach_.y, cells.nx(), cells.ny());
  row_holds_data_.assign(planes_.size(), 0);
  cell_holds_data_.assign(static_cast<std::size_t>(cells.nx()), 0);
  columns_.assign(static_cast<std::size_t>(cells.nx()), {});
  rows_with_data_.assign(static_cast<std::size_t>(cells.nx()), 0);
  // Begins above the box, where every sum is zero.
  for (int iy = box.y - reach_.y; iy < out.y_end; ++iy) {
    SlideDown(cells, box, out, iy);
    if (iy >= out.y) FitRow(cells, box, out, iy);
  }
  FitWaiting();
}

void PatchPlanes::SlideDown(const CellWindow& cells, const CellBox& box, const CellBox& out,
                            int iy) {
  // Row iy + reach enters the patches of row iy, row iy - reach - 1 leaves them. Sums are whole
  // numbers, so taking back leaves no residue.
  const int in = iy + reach_.y;
  const int gone = iy - reach_.y - 1;
  const bool adds = in < box.y_end;
  const bool takes = gone >= box.y && gone < box.y_end;
  if (adds) AddRow(cells, box, out, in);
  if (takes) TakeRow(cells, box, gone);
  for (int ix = out.x; ix < out.x_end; ++ix) {
    std::int32_t& rows = rows_with_data_[static_cast<std::size_t>(ix)];
    if (adds) rows += row_holds_data_[CellIndex(ix, in, width_)];
    if (takes) rows -= row_holds_data_[CellIndex(ix, gone, width_)];
  }
}

void PatchPlanes::AddRow(const CellWindow& cells, const CellBox& box, const CellBox& out, int iy) {
  for (int ix = box.x; ix < box.x_end; ++ix) {
    const MapCell& cell = cells.At(ix, iy);
    Sums& column = columns_[static_cast<std::size_t>(ix)];
    column.moments += cell.moments;
    column.filled += IsFilled(cell);
    column.marked += cell.marked ? 1U : 0U;
    cell_holds_data_[static_cast<std::size_t>(ix)] = cell.moments.empty() ? 0 : 1;
  }
  const auto holds = [&](int ix) {
    return ix >= box.x && ix < box.x_end ? cell_holds_data_[static_cast<std::size_t>(ix)] : 0;
  };
  int count = 0;
  for (int ix = box.x - reach_.x; ix < out.x_end; ++ix) {
    // A window of 2 reach + 1 cells slides along the row: one cell enters, one leaves.
    count += holds(ix + reach_.x) - holds(ix - reach_.x - 1);
    if (ix >= out.x) row_holds_data_[CellIndex(ix, iy, width_)] = count > 0;
  }
}

void PatchPlanes::TakeRow(const CellWindow& cells, const CellBox& box, int iy) {
  for (int ix = box.x; ix < box.x_end; ++ix) {
    const MapCell& cell = cells.At(ix, iy);
    Sums& column = columns_[static_cast<std::size_t>(ix)];
    column.moments -= cell.moments;
    column.filled -= IsFilled(cell);
    column.marked -= cell.marked ? 1U : 0U;
  }
}

// Along row iy: the sums of a patch gain a column and lose one.
void PatchPlanes::FitRow(const CellWindow& cells, const CellBox& box, const CellBox& out, int iy) {
  Sums patch;
  int columns_with_data = 0;
  for (int ix = box.x - reach_.x; ix < out.x_end; ++ix) {
    const int in = ix + reach_.x;
    const int gone = ix - reach_.x - 1;
    if (in < box.x_end) {
      const Sums& column = columns_[static_cast<std::size_t>(in)];
      patch += column;
      columns_with_data += column.moments.empty() ? 0 : 1;
    }
    if (gone >= box.x && gone < box.x_end) {
      const Sums& column = columns_[static_cast<std::size_t>(gone)];
      patch -= column;
      columns_with_data -= column.moments.empty() ? 0 : 1;
    }
    if (ix >= out.x) Assess(cells, patch, columns_with_data, {ix, iy});
  }
}

// The preliminary tests of step 3, before a plane is fitted.
void PatchPlanes::Assess(const CellWindow& cells, const Sums& patch, int columns_with_data,
                         Cell middle) {
  PatchPlane& plane = planes_[CellIndex(middle.ix, middle.iy, width_)];
  plane.marked = patch.marked > 0;
  // "At least half the cells have more than 1 point" (Goldberg 2002, step 3): needed_cells_ of them
  // hold min_cell_points.
  plane.enough = patch.filled >= needed_cells_ && !patch.moments.empty();
  // min-cell-coverage of table 1: data in enough columns and in enough rows.
  const bool covered = columns_with_data >= needed_columns_ &&
                       rows_with_data_[static_cast<std::size_t>(middle.ix)] >= needed_rows_;
  if (plane.enough && covered) FitPatch(cells, patch.moments, middle, plane);
}

// Planes are fitted in batches, which cost a fraction of as many single ones (math/plane_batch.h).
void PatchPlanes::FitPatch(const CellWindow& cells, const math::PointMoments& moments, Cell middle,
                           PatchPlane& plane) {
  if (params_.outliers_per_cell > 0 || moments.count() > math::kExactPoints) {
    const math::PlaneFit fit =
        FitWithoutOutliers(CellsOf(cells, middle), moments, params_.outliers_per_cell);
    Store(fit.residual_m, fit.eigen_ratio, plane);
    StoreNormal(fit.normal, plane);
    return;
  }
  waiting_planes_[waiting_.size()] = &plane;
  waiting_.Add(moments);
  if (waiting_.full()) FitWaiting();
}

void PatchPlanes::FitWaiting() {
  // Only slopes, and steps from planes, ask for normals.
  const bool normals = params_.tests.pitch || params_.step_reference == StepReference::kPlane;
  waiting_.Fit(normals ? math::PlaneParts::kWithNormals : math::PlaneParts::kWithoutNormals);
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    PatchPlane& plane = *waiting_planes_[i];
    Store(waiting_.Residual_m(i), waiting_.EigenRatio(i), plane);
    if (normals) StoreNormal(waiting_.Normal(i), plane);
  }
  waiting_.Clear();
}

void PatchPlanes::Store(double residual_m, double eigen_ratio, PatchPlane& plane) const {
  // Middle over smallest eigenvalue: whether the points lie in a plane rather than along a line.
  plane.plane_valid = eigen_ratio >= params_.eigen_ratio;
  // r of the roughness hazard, m.
  plane.residual_m = residual_m;
}

void PatchPlanes::StoreNormal(const math::Vector3& normal, PatchPlane& plane) const {
  if (params_.tests.pitch) plane.slope_rad = math::Slope_rad(normal);
  if (params_.step_reference == StepReference::kLevel) return;
  // n . p = const: dz/dx = -n_x / n_z. A plane on end has no elevation to measure from.
  const double upright = std::max(normal.z(), kOnEnd);
  plane.rise_x = -normal.x() / upright;
  plane.rise_y = -normal.y() / upright;
}

void PatchPlanes::FindSpreads(const CellWindow& cells) {
  spreads_.resize(planes_.size());
  for (int iy = 0; iy < cells.ny(); ++iy) {
    for (int ix = 0; ix < cells.nx(); ++ix) {
      const math::PointMoments& moments = cells.At(ix, iy).moments;
      if (!moments.empty()) spreads_[CellIndex(ix, iy, width_)] = math::Spread(moments);
    }
  }
}

// Only patches with outliers to leave out, or with too many points for exact sums, ask for their
// cells.
std::vector<PatchCell> PatchPlanes::CellsOf(const CellWindow& cells, Cell middle) {
  if (spreads_.empty()) FindSpreads(cells);
  const CellBox patch = CellBox{middle.ix, middle.ix + 1, middle.iy, middle.iy + 1}.Grown(
      reach_.x, reach_.y, cells.nx(), cells.ny());
  std::vector<PatchCell> with_data;
  for (int iy = patch.y; iy < patch.y_end; ++iy) {
    for (int ix = patch.x; ix < patch.x_end; ++ix) {
      const math::PointMoments& moments = cells.At(ix, iy).moments;
      if (!moments.empty()) with_data.push_back({&moments, &spreads_[CellIndex(ix, iy, width_)]});
    }
  }
  return with_data;
}

}  // namespace rockyard::navigation
