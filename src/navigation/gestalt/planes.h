// Planes through vehicle-sized patches of the map (Goldberg 2002, section 4, step 3). The map fits
// them; roughness, pitch and, where steps count from planes, steps are judged by them. Records
// depend on the bits of residuals, slopes and rises; sums of whole numbers may be made in any
// order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/plane_batch.h"
#include "math/plane_fit.h"
#include "math/point_moments.h"
#include "navigation/gestalt/cells.h"
#include "navigation/gestalt/map_params.h"

namespace rockyard::navigation {

// A cell with data, for the plane of one patch where the sums of PatchPlanes do not do.
struct PatchCell {
  const math::PointMoments* moments;
  const math::PointSpread* spread;  // of the points of `moments`
};

// Returns the spread of all points of `cells`, whose moments add up to `sum`: from the sum, which
// is exact, up to math::kExactPoints points; merged in floating point above, where it may have run
// over. Cost: O(1) or O(cells).
math::PointSpread SpreadOf(const std::vector<PatchCell>& cells, const math::PointMoments& sum);

// Returns the plane without up to `outliers` cells. They are left out one after the other, each
// time the cell whose mean lies farthest from the plane of what is left (Goldberg 2002, section 4,
// step 3, names no rule). Records depend on the choice: of equally far cells it takes the first; it
// takes none that lies within a micrometre of the plane, and never the last cell. Cost: O(cells
// times outliers).
math::PlaneFit FitWithoutOutliers(std::vector<PatchCell> cells, math::PointMoments sum,
                                  std::int64_t outliers);

// What is known of the patch around a cell.
struct PatchPlane {
  double residual_m = 0.0;  // where plane_valid
  double slope_rad = 0.0;   // where plane_valid and the pitch test runs
  // dz/dx and dz/dy of the plane, where plane_valid and steps are measured from it.
  double rise_x = 0.0;
  double rise_y = 0.0;
  bool enough = false;  // min_patch_share of the cells hold min_cell_points
  bool plane_valid = false;
  bool marked = false;  // holds a cell where the rover felt an obstacle
};

// The cells on either side of a patch's middle cell: as many as a square of that side touches when
// its centre is the cell's.
struct PatchReach {
  int x = 0;
  int y = 0;
};
PatchReach ReachOf(const GestaltMapParams& params);

// Merges the moments of all patches and fits their planes. Sums of whole numbers slide over the
// map: O(cells) whatever the size of the patch, and exact. Cells outside the window count as empty.
// Sums of whole numbers could run over in patches of more than math::kExactPoints points: these are
// merged from the means and covariances of their cells instead.
//
// With outliers_per_cell each patch is searched that often for the cell whose mean lies farthest
// from the plane, which is then left out: O(cells times cells of a patch times outliers_per_cell).
// Data and coverage of a patch are tested before, so that what is left may have too little.
class PatchPlanes {
 public:
  explicit PatchPlanes(const GestaltMapParams& params);

  // Fits the patch around every cell of `cells`; `box` holds those that are not empty.
  void Fit(const CellWindow& cells, const CellBox& box);

  // Returns the planes of all cells, row by row, as of the last Fit.
  const std::vector<PatchPlane>& planes() const { return planes_; }
  PatchReach reach() const { return reach_; }

 private:
  // What adds up over the cells of a patch.
  struct Sums {
    math::PointMoments moments;
    std::uint64_t filled = 0;  // cells with min_cell_points
    std::uint64_t marked = 0;

    Sums& operator+=(const Sums& other);
    Sums& operator-=(const Sums& other);
  };
  struct Cell {
    int ix;
    int iy;
  };

  // Returns 1 where the cell has min_cell_points, else 0.
  std::uint64_t IsFilled(const MapCell& cell) const;
  // Moves the sums over columns from the patches of row iy - 1 to those of row iy.
  void SlideDown(const CellWindow& cells, const CellBox& box, const CellBox& out, int iy);
  // Adds row iy of the cells to the sums over columns, and finds where it holds data.
  void AddRow(const CellWindow& cells, const CellBox& box, const CellBox& out, int iy);
  // Takes row iy from the sums over columns.
  void TakeRow(const CellWindow& cells, const CellBox& box, int iy);
  // Slides along row iy.
  void FitRow(const CellWindow& cells, const CellBox& box, const CellBox& out, int iy);
  // Tests the patch around `middle` and fits its plane. `columns_with_data` of its columns hold
  // data.
  void Assess(const CellWindow& cells, const Sums& patch, int columns_with_data, Cell middle);
  // Fits the plane of the patch around `middle`, whose points have `moments`, or puts it off until
  // a batch is full.
  void FitPatch(const CellWindow& cells, const math::PointMoments& moments, Cell middle,
                PatchPlane& plane);
  void FitWaiting();
  void Store(double residual_m, double eigen_ratio, PatchPlane& plane) const;
  // Stores what tests ask of the normal: slope, and rise along x and y.
  void StoreNormal(const math::Vector3& normal, PatchPlane& plane) const;
  void FindSpreads(const CellWindow& cells);
  // Returns the cells with data of the patch around `middle`. Finds the spreads of all cells when
  // it is first called in a Fit.
  std::vector<PatchCell> CellsOf(const CellWindow& cells, Cell middle);

  GestaltMapParams params_;
  PatchReach reach_;
  std::uint64_t needed_cells_;
  int needed_columns_;
  int needed_rows_;
  int width_ = 0;  // of planes_
  std::vector<PatchPlane> planes_;
  std::vector<Sums> columns_;                  // over the rows of a patch
  std::vector<std::uint8_t> cell_holds_data_;  // of the row that was added last
  std::vector<std::uint8_t> row_holds_data_;   // among the columns of the patch around a cell
  math::PlaneBatch waiting_;                   // patches whose planes are put off
  std::array<PatchPlane*, math::PlaneBatch::kSize> waiting_planes_{};
  std::vector<std::int32_t> rows_with_data_;  // of the patches of the row at hand
  std::vector<math::PointSpread> spreads_;    // of all cells, or nothing where not needed
};

}  // namespace rockyard::navigation
