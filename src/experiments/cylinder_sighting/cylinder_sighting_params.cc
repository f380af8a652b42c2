#include "experiments/cylinder_sighting/cylinder_sighting_params.h"

#include <algorithm>
#include <string_view>

#include "math/functions.h"

namespace rockyard::experiments {
namespace {

using core::Published;
using core::Setting;

void VisitCells(CylinderSightingParams& p, core::FieldVisitor& v) {
  v.Reals(
      "distances_m", p.distances_m,
      Published("from the cameras' centre of rotation along the ground to the cylinder's axis",
                "Matthies 1995 sec. 5: 0.914, 1.829, 4.572 and 10.058 m, and 15 m", {0.5, 25.0}));
  v.Reals("orientations_deg", p.orientations_deg,
          Setting("theta of app. A.1; an empty list: each view has one of its own, of all alike",
                  {-360.0, 360.0}));
  v.Reals("sun_elevations_deg", p.sun_elevations_deg,
          Setting("values of picture.light.elevation_deg", {1.0, 90.0}));
  v.Reals("clutter_levels", p.clutter_levels,
          Setting("factors of picture.clutter.rocks and hardware", {0.0, 10.0}));
  v.Reals("third_colours", p.third_colours,
          Setting("the quadrant opposite to blue: 0 orange, 1 green", {0.0, 1.0}));
}

void VisitDraws(CylinderSightingParams& p, core::FieldVisitor& v) {
  v.Boolean("any_sun_azimuth", p.any_sun_azimuth,
            Setting("each view has a sun's azimuth of its own, of all alike, in place of "
                    "picture.light.azimuth_deg"));
  v.Angle(
      "largest_bearing_deg", p.largest_bearing_rad,
      Setting(
          "the cylinder stands to the left or right of the line of sight by up to this, uniformly",
          {0.0, 60.0}));
  v.Real(
      "distance_spread", p.distance_spread,
      Setting("distances are drawn uniformly within this share of that of the cell", {0.0, 0.5}));
  v.Boolean("present", p.present,
            Setting("the cylinder is there; without it every finding is wrong"));
}

}  // namespace

std::vector<CellFactor> CylinderSightingParams::Factors() const {
  std::vector<CellFactor> factors{{"distance_m", distances_m}};
  const auto add = [&](std::string_view column, const std::vector<double>& values) {
    if (!values.empty()) factors.push_back({column, values});
  };
  add("orientation_deg", orientations_deg);
  add("sun_elevation_deg", sun_elevations_deg);
  add("clutter_level", clutter_levels);
  add("third_colour", third_colours);
  return factors;
}

void CylinderSightingParams::Visit(core::FieldVisitor& v) {
  v.Integer("views_per_run", views_per_run,
            Setting("views of one run, all of one cell, each with surroundings of its own; run i "
                    "belongs to cell i modulo their number",
                    {1, 100000}));
  v.Integer("measurements_per_view", measurements_per_view,
            Published("pairs of images of one view, which differ in their noise",
                      "Matthies 1995 sec. 5: ten measurements at each position and orientation",
                      {1, 10000}));
  VisitCells(*this, v);
  VisitDraws(*this, v);
  v.Group("picture", picture, "what the cameras see");
  v.Group("published", published, "the finder of Matthies 1995 app. A");
  v.Group("robust", robust, "rockyard's own finder");
  v.Require("distances_m", !distances_m.empty(), "is empty", "list at least one, e.g. 5");
  v.Require("distances_m", Cells() <= kMaxCells, "and the other lists name more than 2000 cells",
            "shorten the lists");
  v.Require("distances_m", picture.clutter.farthest_m < picture.backdrop.horizon_distance_m,
            "cannot be seen: clutter lies behind the hills (picture.backdrop.horizon_distance_m)",
            "move the hills away");
}

// The cylinder's far edge lies half a baseline, a radius and d tan(bearing) off a camera's axis.
void RequireSightable(const CylinderSightingParams& study, const trial::DriveParams& /*drive*/,
                      core::FieldVisitor& v) {
  const rendering::CylinderPictureParams& picture = study.picture;
  const double half_view = math::Tan(0.5 * picture.cameras.field_of_view_rad);
  const auto holds = [&](double distance_m) {
    const double nearest_m = (1.0 - study.distance_spread) * distance_m;
    const double depth_m = nearest_m * math::Cos(study.largest_bearing_rad) -
                           picture.cameras.front_m - picture.target.diameter_m;
    const double aside_m = nearest_m * math::Sin(study.largest_bearing_rad) +
                           0.5 * (picture.cameras.baseline_m + picture.target.diameter_m);
    return depth_m > 0.0 && aside_m <= depth_m * half_view;
  };
  v.Require("cylinder_sighting.distances_m",
            std::all_of(study.distances_m.begin(), study.distances_m.end(), holds),
            "names a distance at which the cylinder may leave an image",
            "use longer distances or a smaller largest_bearing_deg");
}

}  // namespace rockyard::experiments
