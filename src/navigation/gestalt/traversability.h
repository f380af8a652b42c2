// Differences of elevation within vehicle-sized patches of the map, and the goodness of cells from
// what their patches hold (Goldberg 2002, section 4, step 3). The map calls both when it is
// evaluated. Records depend on the rounding to 8 bits and, of equally bad hazards, on the first
// (step, roughness, pitch): its pair gives the certainty.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "navigation/gestalt/cells.h"
#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/map_params.h"
#include "navigation/gestalt/planes.h"

namespace rockyard::navigation {

// Finds the largest difference of elevation between any two cells of each patch. The elevation of a
// cell is the mean height of its points (the paper does not say): the ten moments hold no other
// height, and a single bad point does not make a step. Minima and maxima over windows are found by
// doubling. Cost: O(cells log reach).
class PatchSteps {
 public:
  // Works on the same cells and box as PatchPlanes::Fit.
  void Find(const CellWindow& cells, const CellBox& box, PatchReach reach);

  // Does as Find, but elevations count from the patch's own plane where it has one:
  //   e = max - min over the cells of  z - (dz/dx x + dz/dy y),
  // with the means of their points. Cost: O(cells times cells of a patch).
  void FindFromPlanes(const CellWindow& cells, const CellBox& box, PatchReach reach,
                      const std::vector<PatchPlane>& planes);

  // Returns the differences of all patches, m, row by row; 0 where a patch holds no points.
  const std::vector<double>& steps_m() const { return steps_; }

 private:
  void LoadElevations(const CellWindow& cells, const CellBox& box, PatchReach reach);
  void LoadMeans(const CellWindow& cells, const CellBox& box, PatchReach reach);

  static constexpr std::size_t kRoom = 8;  // what FindSteps asks for

  int width_ = 0;  // of the padded maps below
  int height_ = 0;
  std::vector<double> highest_;  // padded by the reach on all sides
  std::vector<double> lowest_;
  std::vector<double> steps_;
  // The means of the points of each cell, padded as above, m; not a number where it has no data.
  std::array<std::vector<double>, 3> means_m_;
  // Of the row at hand.
  std::vector<double> rise_x_;
  std::vector<double> rise_y_;
  std::vector<double> row_steps_m_;
};

// Gives every cell the least of the goodnesses of its hazards:
//   step       127 (1 - min(1, e/h))    from e = h/3 on
//   roughness  255 (1 - min(1, f r/h))  from r = f h/3 on; see RoughnessFormula
//   pitch      255 (1 - min(1, s/max_pitch))
//   border     border.goodness          where a neighbour is unknown
// and 255 where there is none (traversability.cc). A cell is unknown where its patch has not
// enough data, where no enabled test could run, and where a failed plane says so (FailedFit);
// outside the window all is unknown. A patch with a cell where the rover felt an obstacle is a step
// obstacle, whatever its points.
class Traversability {
 public:
  explicit Traversability(const GestaltMapParams& params) : params_(params) {}

  // Fills the cells of `grid`, whose nx and ny say how many: planes and steps row by row.
  void Assess(const std::vector<PatchPlane>& planes, const std::vector<double>& steps_m,
              GoodnessGrid& grid) const;

  // Returns the value of a cell that was not evaluated.
  CellValue Unknown() const;

 private:
  CellValue Value(const PatchPlane& plane, double step_m) const;
  // Returns the goodness for the steps of a patch and for what the rover felt there.
  std::int64_t FromSteps(const PatchPlane& plane, double step_m) const;
  bool IsKnown(const PatchPlane& plane, bool step_hazard) const;
  void AddBorders(GoodnessGrid& grid) const;

  GestaltMapParams params_;
};

}  // namespace rockyard::navigation
