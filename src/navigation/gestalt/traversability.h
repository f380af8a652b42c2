// Goodness of cells from what their patches hold (Goldberg 2002, section 4, step 3).
#pragma once

#include <cstdint>
#include <vector>

#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/map_params.h"
#include "navigation/gestalt/planes.h"

namespace rockyard::navigation {

// Gives every cell the least of the goodnesses of its hazards:
//   step       127 (1 - min(1, e/h))    from e = h/3 on
//   roughness  255 (1 - min(1, f r/h))  from r = f h/3 on; see RoughnessFormula
//   pitch      255 (1 - min(1, s/max_pitch))
//   border     border.goodness          where a neighbour is unknown
// and 255 where there is none (hazards.h). A cell is unknown where its patch has not
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
