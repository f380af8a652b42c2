// Differences of elevation within vehicle-sized patches of the map (Goldberg 2002, section 4,
// step 3, step hazard).
#pragma once

#include <vector>

#include "math/pose.h"
#include "navigation/gestalt/cells.h"
#include "navigation/gestalt/planes.h"

namespace rockyard::navigation {

// Finds the largest difference of elevation between any two cells of each patch. The elevation of a
// cell is the mean height of its points (the paper does not say): the ten moments hold no other,
// and a single bad point does not make a step. Minima and maxima over windows go by doubling. Cost:
// O(cells log reach).
class PatchSteps {
 public:
  // Works on the same cells and box as PatchPlanes::Fit.
  void Find(const CellWindow& cells, const CellBox& box, PatchReach reach);

  // As Find, but elevations count from the patch's own plane where it has one:
  //   e = max - min over the cells of  z - (dz/dx x + dz/dy y),
  // with the means of their points. Cost: O(cells times cells of a patch).
  void FindFromPlanes(const CellWindow& cells, const CellBox& box, PatchReach reach,
                      const std::vector<PatchPlane>& planes);

  // Returns the differences, m, row by row; 0 where a patch holds no points.
  const std::vector<double>& steps_m() const { return steps_; }

 private:
  void LoadElevations(const CellWindow& cells, const CellBox& box, PatchReach reach);
  double StepFrom(const PatchPlane& plane, const CellBox& patch) const;

  int width_ = 0;  // of the padded maps below
  int height_ = 0;
  std::vector<double> highest_;  // padded by the reach on all sides
  std::vector<double> lowest_;
  std::vector<double> steps_;
  int columns_ = 0;                   // of means_
  std::vector<math::Vector3> means_;  // of the points of each cell with data, m
  std::vector<bool> has_data_;
};

}  // namespace rockyard::navigation
