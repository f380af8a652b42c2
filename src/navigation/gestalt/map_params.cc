#include "navigation/gestalt/map_params.h"

#include <algorithm>
#include <cmath>

#include "core/sources.h"

namespace rockyard::navigation {
namespace {

using core::FieldInfo;
using core::Origin;

using core::kGoldbergTable1;
// Keeps the memory of a map below 10 MB, whatever is set.
constexpr double kMaxCells = 40000.0;
// Distances of cells from planes in the search for outliers, in one evaluation: a fifth of a
// second.
constexpr double kMaxDistances = 2e7;

// Cells that cover `extent_m`; a hair of tolerance for extents such as 9 m in steps of 0.1 m.
int Cells(double extent_m, double step_m) {
  return static_cast<int>(std::ceil(extent_m / step_m - 1e-6));
}

FieldInfo Published(std::string_view doc, double min, double max) {
  return {
      .doc = doc, .min = min, .max = max, .origin = Origin::kPublished, .source = kGoldbergTable1};
}

FieldInfo PublishedFlag(std::string_view doc) {
  return {.doc = doc, .origin = Origin::kPublished, .source = kGoldbergTable1};
}

void VisitValidity(GestaltMapParams& p, core::FieldVisitor& v) {
  v.Integer("outliers_per_cell", p.outliers_per_cell,
            Published("cells of a patch left out of its plane, one after the other, the farthest "
                      "from the plane first; coverage and data are tested before",
                      0, 8));
  v.Real("eigen_ratio", p.eigen_ratio,
         Published("ratio of the middle to the smallest eigenvalue of a patch's covariance from "
                   "which its plane is valid",
                   1.0, 1e9));
  v.Real("min_cell_coverage", p.min_cell_coverage,
         Published("share of the columns of a patch, and of its rows, that must hold range data "
                   "for its plane to be valid: the reading here of the fraction of a cell in each "
                   "of X and Y; up to min_patch_share it is always met",
                   0.0, 1.0));
  v.Real("min_patch_share", p.min_patch_share,
         {.doc = "share of the cells of a patch that must hold min_cell_points; below it the cell "
                 "is unknown",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kPublished,
          .source = "Goldberg 2002 sec. 4 step 3: at least half the cells, as an example"});
  v.Integer("min_cell_points", p.min_cell_points,
            {.doc = "points with which a cell counts for min_patch_share",
             .min = 1,
             .max = 1000,
             .origin = Origin::kPublished,
             .source = "Goldberg 2002 sec. 4 step 3: more than 1 point"});
}

// Cells that a patch has at most, with a cell more on every side than the square of the vehicle.
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
           {.doc = "the height h of the step and roughness formulas",
            .origin = Origin::kAssumed,
            .source = "Goldberg 2002 sec. 4 says clearance, table 1 has obst-height alone"});
  v.Choice("step_reference", p.step_reference,
           {.doc = "what the elevations of the step test count from: the level, or the patch's "
                   "plane; with the latter nothing but tests.pitch keeps the rover from a slope",
            .origin = Origin::kAssumed,
            .source = "Goldberg 2002 sec. 4 step 3 prints differences of elevation, which make an "
                      "obstacle of a smooth slope of 14 deg; max-pitch of table 1 is 25 deg"});
  v.Choice("roughness_formula", p.roughness_formula,
           {.doc = "how the roughness fraction f enters the goodness: 255 (1 - f r/h) as printed, "
                   "or 255 (1 - r/(f h)) divided",
            .origin = Origin::kPublished,
            .source = "Goldberg 2002 sec. 4 step 3 prints the product"});
  v.Real("roughness_fraction", p.roughness_fraction,
         {.doc = "residual above roughness_fraction h/3 is a hazard",
          .min = 0.01,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "Goldberg 2002 gives no value; at 1 both formulas agree",
          .study_low = 0.25,
          .study_high = 1.0});
  v.Choice("patch", p.patch,
           {.doc = "side of the square of cells that stands for the vehicle",
            .origin = Origin::kPublished,
            .source = "Goldberg 2002 sec. 4: obstacles grow by half the vehicle width"});
  v.Choice(
      "failed_fit", p.failed_fit,
      {.doc = "what a plane that fails min_cell_coverage or eigen_ratio leads to",
       .origin = Origin::kAssumed,
       .source = "without a plane nothing is known, but unknown cells may be crossed: a step must "
                 "not become unknown because it fits no plane; the paper says neither"});
  v.Choice("certainty", p.certainty,
           {.doc = "certainty of an evaluated cell: always 255, or that of the hazard that decides",
            .origin = Origin::kPublished,
            .source = "Goldberg 2002 sec. 4 step 3: 255; table 1 has certainties by hazard"});
  v.Choice("border_neighbours", p.border_neighbours,
           {.doc = "which cells a cell borders",
            .origin = Origin::kAssumed,
            .source = "the cautious reading of bordering"});
}

}  // namespace

int GestaltGridParams::nx() const { return Cells(xN_m - x0_m, xstep_m); }
int GestaltGridParams::ny() const { return Cells(yN_m - y0_m, ystep_m); }

void GestaltGridParams::Visit(core::FieldVisitor& v) {
  constexpr double kFar_m = 1000.0;
  v.Real("x0_m", x0_m,
         Published("lower bound in x: cells end at multiples of xstep_m from it", -kFar_m, kFar_m));
  v.Real("y0_m", y0_m,
         Published("lower bound in y: cells end at multiples of ystep_m from it", -kFar_m, kFar_m));
  v.Real("xN_m", xN_m,
         Published("upper bound in x; only its distance from x0_m matters, as the grid follows the "
                   "rover",
                   -kFar_m, kFar_m));
  v.Real("yN_m", yN_m,
         Published("upper bound in y; only its distance from y0_m matters, as the grid follows the "
                   "rover",
                   -kFar_m, kFar_m));
  v.Real("xstep_m", xstep_m, Published("size of a cell in x", 0.05, 2.0));
  v.Real("ystep_m", ystep_m, Published("size of a cell in y", 0.05, 2.0));
  const double columns = (xN_m - x0_m) / xstep_m;
  const double rows = (yN_m - y0_m) / ystep_m;
  v.Require("xN_m", columns >= 2.0, "leaves less than two cells in x", "enlarge xN_m - x0_m");
  v.Require("yN_m", rows >= 2.0, "leaves less than two cells in y", "enlarge yN_m - y0_m");
  v.Require("xstep_m", !(columns > 0.0 && rows > 0.0 && columns * rows > kMaxCells),
            "makes more than 40000 cells", "use larger cells or closer bounds");
}

void GestaltTestParams::Visit(core::FieldVisitor& v) {
  v.Boolean("step", step, PublishedFlag("whether steps are hazards"));
  v.Boolean("rough", rough, PublishedFlag("whether roughness is a hazard"));
  v.Boolean("pitch", pitch, PublishedFlag("whether slopes are hazards"));
  v.Boolean("border", border, PublishedFlag("whether bordering an unknown cell is a hazard"));
}

void GoodnessPair::Visit(core::FieldVisitor& v) {
  v.Integer("goodness", goodness, Published("how safe; 255 is best", 0, 255));
  v.Integer("certainty", certainty, Published("how sure that is; 255 is best", 0, 255));
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
            {.doc = "whether there is a rover model; without one every cell has unknown_rovers",
             .origin = Origin::kSetting});
  v.Real("length_m", length_m, Published("length of the vehicle", 0.1, 3.0));
  v.Real("width_m", width_m, Published("width of the vehicle", 0.1, 3.0));
  v.Real("obst_height_m", obst_height_m,
         Published("tallest obstacle that the vehicle traverses", 0.01, 2.0));
  v.Real("wheel_radius_m", wheel_radius_m,
         Published("radius of a wheel; read where hazard_height is wheel_diameter", 0.01, 1.0));
  v.Angle("max_pitch_deg", max_pitch_rad, Published("slope that is a pitch obstacle", 1.0, 80.0));
  v.Real("clearance_m", clearance_m,
         {.doc = "height of the vehicle's underside; read where hazard_height is clearance",
          .min = 0.01,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "as obst-height; Goldberg 2002 gives none",
          .study_low = 0.13,
          .study_high = 0.3});
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
  v.Integer("max_idles", max_idles,
            Published("cycles without data after which a cell is zeroed", 1, 1e9));
  v.Real("grid_dist_timeout_m", grid_dist_timeout_m,
         Published("cells whose centre is farther from the rover are thrown out", 0.1, 1000.0));
  v.Group("tests", tests, "traversability tests that run");
  VisitValidity(*this, v);
  VisitFormulas(*this, v);
  v.Group("pairs", pairs, "goodness and certainty of hazards");
  v.Group("rover", rover, "what the navigator believes of its vehicle");
  RequireUse(*this, v);
}

}  // namespace rockyard::navigation
