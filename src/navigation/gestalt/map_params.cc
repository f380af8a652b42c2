#include "navigation/gestalt/map_params.h"

#include <algorithm>
#include <cmath>

#include "core/sources.h"

namespace rockyard::navigation {
namespace {

using core::Assumed;
using core::kGoldbergTable1;
using core::Published;
using core::Setting;

// Most cells of a map: keeps its memory below 10 MB.
constexpr double kMaxCells = 40000.0;
// Most distances of cells from planes in the search for outliers of one evaluation: a fifth of a
// second.
constexpr double kMaxDistances = 2e7;

// Returns the number of cells that cover `extent_m`; the tolerance is for extents such as 9 m in
// steps of 0.1 m.
int Cells(double extent_m, double step_m) {
  return static_cast<int>(std::ceil(extent_m / step_m - 1e-6));
}

void VisitValidity(GestaltMapParams& p, core::FieldVisitor& v) {
  v.Integer("outliers_per_cell", p.outliers_per_cell,
            Published("cells of a patch left out of its plane, one after the other, the farthest "
                      "from the plane first; coverage and data are tested before",
                      kGoldbergTable1, {0, 8}));
  v.Real("eigen_ratio", p.eigen_ratio,
         Published("ratio of the middle to the smallest eigenvalue of a patch's covariance from "
                   "which its plane is valid",
                   kGoldbergTable1, {1.0, 1e9}));
  v.Real("min_cell_coverage", p.min_cell_coverage,
         Published("share of the columns of a patch, and of its rows, that must hold range data "
                   "for its plane to be valid: the reading here of the fraction of a cell in each "
                   "of X and Y; up to min_patch_share it is always met",
                   kGoldbergTable1, {0.0, 1.0}));
  v.Real(
      "min_patch_share", p.min_patch_share,
      Published("share of the cells of a patch that must hold min_cell_points; below it the cell "
                "is unknown",
                "Goldberg 2002 sec. 4 step 3: at least half the cells, as an example", {0.0, 1.0}));
  v.Integer("min_cell_points", p.min_cell_points,
            Published("points with which a cell counts for min_patch_share",
                      "Goldberg 2002 sec. 4 step 3: more than 1 point", {1, 1000}));
}

// Returns how many cells a patch has at most, with a cell more on every side than the square of the
// vehicle.
double MostPatchCells(const GestaltMapParams& p) {
  return (p.PatchSide_m() / p.grid.xstep_m + 2.0) * (p.PatchSide_m() / p.grid.ystep_m + 2.0);
}

// Conditions across groups.
void RequireUse(GestaltMapParams& p, core::FieldVisitor& v) {
  const double size_m = std::max(p.rover.length_m, p.rover.width_m);
  constexpr std::string_view kTooNear =
      "ends the map within a vehicle's length of the rover: hardly any of the ground ahead could "
      "be known, and what the rover felt would be forgotten as it backs off";
  const GestaltGridParams& grid = p.grid;
  v.Require("grid", std::min(grid.xN_m - grid.x0_m, grid.yN_m - grid.y0_m) >= 2.0 * size_m,
            kTooNear, "set bounds at least two vehicle lengths apart, better those of table 1");
  v.Require("grid_dist_timeout_m", p.grid_dist_timeout_m >= size_m, kTooNear,
            "use at least the vehicle's length, better plan_max_dist_m");
  const double cells =
      (grid.xN_m - grid.x0_m) / grid.xstep_m * ((grid.yN_m - grid.y0_m) / grid.ystep_m);
  v.Require(
      "outliers_per_cell",
      cells * MostPatchCells(p) * static_cast<double>(p.outliers_per_cell) <= kMaxDistances,
      "makes more than 2e7 distances of cells from planes, cells times cells of a patch times "
      "outliers_per_cell: seconds for every look",
      "use fewer outliers, larger cells or closer bounds");
}

void VisitFormulas(GestaltMapParams& p, core::FieldVisitor& v) {
  v.Choice("hazard_height", p.hazard_height,
           Assumed("the height h of the step and roughness formulas",
                   "Goldberg 2002 sec. 4 says clearance, table 1 has obst-height alone"));
  v.Choice("step_reference", p.step_reference,
           Assumed("what the elevations of the step test count from: the level, or the patch's "
                   "plane; with the latter nothing but tests.pitch keeps the rover from a slope",
                   "Goldberg 2002 sec. 4 step 3 prints differences of elevation, which make an "
                   "obstacle of a smooth slope of 14 deg; max-pitch of table 1 is 25 deg"));
  v.Choice("roughness_formula", p.roughness_formula,
           Published("how the roughness fraction f enters the goodness: 255 (1 - f r/h) as "
                     "printed, or 255 (1 - r/(f h)) divided",
                     "Goldberg 2002 sec. 4 step 3 prints the product"));
  v.Real(
      "roughness_fraction", p.roughness_fraction,
      Assumed("residual above roughness_fraction h/3 is a hazard",
              "Goldberg 2002 gives no value; at 1 both formulas agree", {0.01, 10.0}, {0.25, 1.0}));
  v.Choice("patch", p.patch,
           Published("side of the square of cells that stands for the vehicle",
                     "Goldberg 2002 sec. 4: obstacles grow by half the vehicle width"));
  v.Choice("failed_fit", p.failed_fit,
           Assumed("what a plane that fails min_cell_coverage or eigen_ratio leads to",
                   "without a plane nothing is known, but unknown cells may be crossed: a step "
                   "must not become unknown because it fits no plane; the paper says neither"));
  v.Choice(
      "certainty", p.certainty,
      Published("certainty of an evaluated cell: always 255, or that of the hazard that decides",
                "Goldberg 2002 sec. 4 step 3: 255; table 1 has certainties by hazard"));
  v.Choice("border_neighbours", p.border_neighbours,
           Assumed("which cells a cell borders", "the cautious reading of bordering"));
}

}  // namespace

int GestaltGridParams::nx() const { return Cells(xN_m - x0_m, xstep_m); }
int GestaltGridParams::ny() const { return Cells(yN_m - y0_m, ystep_m); }

void GestaltGridParams::Visit(core::FieldVisitor& v) {
  constexpr double kFar_m = 1000.0;
  v.Real("x0_m", x0_m,
         Published("lower bound in x: cells end at multiples of xstep_m from it", kGoldbergTable1,
                   {-kFar_m, kFar_m}));
  v.Real("y0_m", y0_m,
         Published("lower bound in y: cells end at multiples of ystep_m from it", kGoldbergTable1,
                   {-kFar_m, kFar_m}));
  v.Real("xN_m", xN_m,
         Published("upper bound in x; only its distance from x0_m matters, as the grid follows the "
                   "rover",
                   kGoldbergTable1, {-kFar_m, kFar_m}));
  v.Real("yN_m", yN_m,
         Published("upper bound in y; only its distance from y0_m matters, as the grid follows the "
                   "rover",
                   kGoldbergTable1, {-kFar_m, kFar_m}));
  v.Real("xstep_m", xstep_m, Published("size of a cell in x", kGoldbergTable1, {0.05, 2.0}));
  v.Real("ystep_m", ystep_m, Published("size of a cell in y", kGoldbergTable1, {0.05, 2.0}));
  const double columns = (xN_m - x0_m) / xstep_m;
  const double rows = (yN_m - y0_m) / ystep_m;
  v.Require("xN_m", columns >= 2.0, "leaves less than two cells in x", "enlarge xN_m - x0_m");
  v.Require("yN_m", rows >= 2.0, "leaves less than two cells in y", "enlarge yN_m - y0_m");
  v.Require("xstep_m", !(columns > 0.0 && rows > 0.0 && columns * rows > kMaxCells),
            "makes more than 40000 cells", "use larger cells or closer bounds");
}

void GestaltTestParams::Visit(core::FieldVisitor& v) {
  v.Boolean("step", step, Published("whether steps are hazards", kGoldbergTable1));
  v.Boolean("rough", rough, Published("whether roughness is a hazard", kGoldbergTable1));
  v.Boolean("pitch", pitch, Published("whether slopes are hazards", kGoldbergTable1));
  v.Boolean("border", border,
            Published("whether bordering an unknown cell is a hazard", kGoldbergTable1));
}

void GoodnessPair::Visit(core::FieldVisitor& v) {
  v.Integer("goodness", goodness, Published("how safe; 255 is best", kGoldbergTable1, {0, 255}));
  v.Integer("certainty", certainty,
            Published("how sure that is; 255 is best", kGoldbergTable1, {0, 255}));
}

void GestaltPairParams::Visit(core::FieldVisitor& v) {
  v.Group("unknown", unknown, "of an unknown cell");
  v.Group("unknown_rovers", unknown_rovers, "of every cell where there is no rover model");
  v.Group("border", border, "of a cell that borders an unknown one");
  v.Group("step_obst", step_obst, "of a step obstacle (e >= h), and of what the rover felt");
  v.Group("pitch_obst", pitch_obst, "of a pitch obstacle (slope >= max_pitch_deg)");
  v.Group("rough_obst", rough_obst, "of a roughness obstacle (formula at 0)");
}

void GestaltRoverParams::Visit(core::FieldVisitor& v) {
  v.Boolean("modelled", modelled,
            Setting("whether there is a rover model; without one every cell has unknown_rovers"));
  v.Real("length_m", length_m, Published("length of the vehicle", kGoldbergTable1, {0.1, 3.0}));
  v.Real("width_m", width_m, Published("width of the vehicle", kGoldbergTable1, {0.1, 3.0}));
  v.Real("obst_height_m", obst_height_m,
         Published("tallest obstacle that the vehicle traverses", kGoldbergTable1, {0.01, 2.0}));
  v.Real("wheel_radius_m", wheel_radius_m,
         Published("radius of a wheel; read where hazard_height is wheel_diameter", kGoldbergTable1,
                   {0.01, 1.0}));
  v.Angle("max_pitch_deg", max_pitch_rad,
          Published("slope that is a pitch obstacle", kGoldbergTable1, {1.0, 80.0}));
  v.Real("clearance_m", clearance_m,
         Assumed("height of the vehicle's underside; read where hazard_height is clearance",
                 "as obst-height; Goldberg 2002 gives none", {0.01, 2.0}, {0.13, 0.3}));
}

double GestaltMapParams::HazardHeight_m() const {
  switch (hazard_height) {
    case HazardHeight::kClearance:
      return rover.clearance_m;
    case HazardHeight::kWheelDiameter:
      return 2.0 * rover.wheel_radius_m;
    case HazardHeight::kObstHeight:
      break;
  }
  return rover.obst_height_m;
}

double GestaltMapParams::PatchSide_m() const {
  return patch == PatchSize::kLength ? rover.length_m : rover.width_m;
}

double GestaltMapParams::Reach_m() const {
  return std::min(
      {0.5 * (grid.xN_m - grid.x0_m), 0.5 * (grid.yN_m - grid.y0_m), grid_dist_timeout_m});
}

void GestaltMapParams::Visit(core::FieldVisitor& v) {
  v.Group("grid", grid, "bounds and resolution of the map");
  v.Integer(
      "max_idles", max_idles,
      Published("cycles without data after which a cell is zeroed", kGoldbergTable1, {1, 1e9}));
  v.Real("grid_dist_timeout_m", grid_dist_timeout_m,
         Published("cells whose centre is farther from the rover are thrown out", kGoldbergTable1,
                   {0.1, 1000.0}));
  v.Group("tests", tests, "traversability tests that run");
  VisitValidity(*this, v);
  VisitFormulas(*this, v);
  v.Group("pairs", pairs, "goodness and certainty of hazards");
  v.Group("rover", rover, "what the navigator believes of its vehicle");
  RequireUse(*this, v);
}

}  // namespace rockyard::navigation
