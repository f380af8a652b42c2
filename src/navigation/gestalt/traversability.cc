#include "navigation/gestalt/traversability.h"

#include <algorithm>
#include <cstddef>

#include "navigation/gestalt/hazards.h"

namespace rockyard::navigation {
namespace {

constexpr std::int64_t kFullCertainty = 255;

CellValue ToCell(const GoodnessPair& pair, bool known) {
  return {static_cast<std::uint8_t>(pair.goodness), static_cast<std::uint8_t>(pair.certainty),
          known};
}

// Whether one of the neighbours of cell (ix, iy) is unknown; those outside the grid are.
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

CellValue Traversability::Unknown() const {
  return ToCell(params_.rover.modelled ? params_.pairs.unknown : params_.pairs.unknown_rovers,
                false);
}

// Step hazard: 127 (1 - min(1, e/h)) from e = h/3 on. A mark of what the rover felt is a step
// obstacle.
std::int64_t Traversability::FromSteps(const PatchPlane& plane, double step_m) const {
  const std::int64_t obstacle = params_.pairs.step_obst.goodness;
  if (plane.marked) return obstacle;
  if (!params_.tests.step) return kBestGoodness;
  return StepGoodness(step_m, params_.HazardHeight_m(), obstacle);
}

// Whether anything could be said of the patch: enough data, and a plane or what FailedFit allows
// instead.
bool Traversability::IsKnown(const PatchPlane& plane, bool step_hazard) const {
  if (plane.marked) return true;
  if (!plane.enough) return false;
  if (plane.plane_valid) return true;
  if (params_.failed_fit == FailedFit::kUnknown) return false;
  if (params_.failed_fit == FailedFit::kStepOrUnknown) return step_hazard;
  const bool plane_tests = params_.tests.rough || params_.tests.pitch;
  return params_.tests.step || !plane_tests;
}

// The least goodness of all hazards of the patch, with that hazard's certainty or full certainty.
CellValue Traversability::Value(const PatchPlane& plane, double step_m) const {
  const GestaltPairParams& pairs = params_.pairs;
  const double h_m = params_.HazardHeight_m();
  GoodnessPair value{kBestGoodness, kFullCertainty};
  // The least goodness decides; of equal ones the first, in the order step, roughness, pitch.
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
