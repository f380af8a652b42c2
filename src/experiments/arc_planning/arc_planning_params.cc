#include "experiments/arc_planning/arc_planning_params.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace rockyard::experiments {
namespace {

using core::Assumed;
using core::Published;
using core::Setting;

constexpr std::string_view kFigure6 = "Ghosh 2018 fig. 6(e), measured from the figure";

void VisitSearch(ArcPlanningParams& p, core::FieldVisitor& v) {
  v.Reals("curvatures_per_m", p.curvatures_per_m,
          Published("curvatures of the arcs that leave a node, left positive", kFigure6,
                    {-20.0, 20.0}));
  v.Real("arc_m", p.arc_m, Published("length of an arc", kFigure6, {0.1, 20.0}));
  v.Real(
      "check_spacing_m", p.check_spacing_m,
      Assumed("distance between two poses of an arc that are checked",
              "dots of Ghosh 2018 fig. 6(e) stand so, eight on an arc", {0.01, 5.0}, {0.1, 0.4}));
  v.Real("goal_tolerance_m", p.goal_tolerance_m,
         Assumed("distance from the goal at which an arc may end",
                 "half an arc: ends of arcs are what can be reached; not published", {0.01, 5.0},
                 {0.3, 1.5}));
  v.Real("place_bin_m", p.place_bin_m,
         Assumed("nodes are the same whose places lie in the same square of this side, and whose "
                 "headings in the same sector",
                 "a sixth of an arc; how the published search prunes is not told", {0.01, 5.0},
                 {0.1, 0.5}));
  v.Integer("heading_bins", p.heading_bins,
            Assumed("sectors of the heading",
                    "15 deg, two thirds of the least turn of an arc; no grid of headings is told",
                    {1, 3600}, {12, 48}));
  v.Integer(
      "max_nodes", p.max_nodes,
      Assumed("expanded nodes after which there is no path",
              "more than the map has places; no limit is told", {1, 10000000}, {1000, 100000}));
}

}  // namespace

std::vector<CellFactor> ArcPlanningParams::Factors() const {
  return {{"cover", covers}, {"risk", risks}};
}

void ArcPlanningParams::Visit(core::FieldVisitor& v) {
  v.Integer(
      "maps_per_run", maps_per_run,
      Setting("maps of one run, all of one cell, each with rocks of its own; run i belongs to "
              "cell i modulo their number",
              {1, 100000}));
  v.Reals("covers", covers,
          Published("values of terrain.rocks.cover; rocks are those of golombek, whatever the kind",
                    "Ghosh 2018 fig. 9", {0.0, 0.4}));
  v.Reals(
      "risks", risks,
      Published("values of navigation.enav.ace.risk; 0 is ACE", "Ghosh 2018 fig. 9", {0.0, 1.0}));
  v.Real("map_side_m", map_side_m,
         Published("side of the map, in whose middle the course lies", "Ghosh 2018 sec. IV-B",
                   {2.0, 200.0}));
  v.Real("map_cell_m", map_cell_m,
         Assumed("side of its cells, each with the ground's height in its middle",
                 "a pixel of Ghosh 2018 fig. 6; the model's resolution is not told", {0.005, 1.0},
                 {0.025, 0.1}));
  v.Integer("poses_per_map", poses_per_map,
            Setting("places at which a rover that heads along x is judged, uniform over the map "
                    "where it has room",
                    {0, 100000}));
  VisitSearch(*this, v);
  v.Require("covers", !covers.empty() && !risks.empty(), "or risks is empty",
            "list at least one of each");
  v.Require("covers", Cells() <= kMaxCells, "and risks name more than 2000 cells",
            "shorten the lists");
  v.Require("curvatures_per_m", !curvatures_per_m.empty(), "is empty", "list at least one, e.g. 0");
}

void RequireArcPlanning(const ArcPlanningParams& study, const trial::DriveParams& drive,
                        core::FieldVisitor& v) {
  v.Require("terrain.rocks.cover_reference",
            study.covers.empty() || *std::max_element(study.covers.begin(), study.covers.end()) <=
                                        drive.terrain.rocks.cover_reference,
            "is below a value of arc_planning.covers", "use a larger one, or smaller covers");
  const double half_x_m = 0.5 * std::abs(drive.course.goal_x_m - drive.course.start_x_m);
  const double half_y_m = 0.5 * std::abs(drive.course.goal_y_m - drive.course.start_y_m);
  const double room_m = 0.5 * study.map_side_m - drive.rover.geometry.length_m;
  v.Require("arc_planning.map_side_m", std::max(half_x_m, half_y_m) < room_m,
            "leaves no rover's length around course.start and course.goal",
            "use a larger map or a shorter course");
}

}  // namespace rockyard::experiments
