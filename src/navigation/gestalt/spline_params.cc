#include "navigation/gestalt/spline_params.h"

namespace rockyard::navigation {

using core::Assumed;
using core::Published;

void SpeedLawParams::Visit(core::FieldVisitor& v) {
  v.Real(
      "full_speed_curvature_per_m", full_speed_curvature_per_m,
      Assumed(
          "curvature up to which the rover drives at full speed",
          "Howard 2012 sec. 3: speed \"is reduced only for high-curvature maneuvers\"; half of the "
          "largest knot, where the outer wheels have to be a fifth faster than the rover's centre",
          {0.0, 20.0}, {0.25, 0.9}));
  v.Real("slow_curvature_per_m", slow_curvature_per_m,
         Assumed("curvature from which the rover drives at min_speed_share; between the two the "
                 "share is linear in the curvature",
                 "the largest knot of Howard 2012 sec. 3", {0.001, 20.0}, {1.0, 2.0}));
  v.Require("slow_curvature_per_m", slow_curvature_per_m > full_speed_curvature_per_m,
            "is not larger than full_speed_curvature_per_m, so that there is no curvature between "
            "the two over which the rover could slow down",
            "use a larger slow_curvature_per_m or a smaller full_speed_curvature_per_m");
  v.Real("min_speed_share", min_speed_share,
         Assumed("share of the full speed in the tightest curves; 1 never slows down",
                 "Howard 2012 sec. 3 slows down and does not say by how much; half speed gives the "
                 "steering motors twice the time for the same path",
                 {0.05, 1.0}, {0.25, 1.0}));
}

namespace {

constexpr std::string_view kHowardSection3 = "Howard 2012 sec. 3";

void VisitShape(GestaltSplineParams& p, core::FieldVisitor& v) {
  v.Real("length_m", p.length_m,
         Published("length of a spline; its knots lie after half of it and after all of it",
                   kHowardSection3, {0.1, 20.0}));
  v.Integer(
      "num_first_knots", p.num_first_knots,
      Assumed("curvatures in the middle of a spline, spaced evenly",
              "Howard 2012 sec. 3 has 225 splines, not how many knots each", {1, 51}, {5, 45}));
  v.Integer(
      "num_second_knots", p.num_second_knots,
      Assumed("curvatures at the end of a spline, spaced evenly, for each in the middle",
              "Howard 2012 sec. 3 has 225 splines, not how many knots each", {1, 51}, {5, 45}));
  v.Real("max_curvature_per_m", p.max_curvature_per_m,
         Published("curvature of the tightest knots", kHowardSection3, {0.01, 20.0}));
}

}  // namespace

double GestaltSplineParams::LeastRate_per_m2() const {
  if (num_first_knots < 2) return 0.0;
  const double spacing_per_m = 2.0 * max_curvature_per_m / static_cast<double>(num_first_knots - 1);
  return spacing_per_m / (0.5 * length_m);
}

void GestaltSplineParams::Visit(core::FieldVisitor& v) {
  VisitShape(*this, v);
  v.Real("max_curvature_rate_per_m_s", max_curvature_rate_per_m_s,
         Assumed("change of curvature a second at the commanded speed above which a spline is "
                 "infeasible and never chosen",
                 "steering motors of 20 deg/s turn the wheels of Athena, 0.42 m before and 0.36 m "
                 "beside its centre, by 0.49 / (m s) at 1 / m, and faster in wider curves; less a "
                 "tenth. The study range is that of motors of 2 to 40 deg/s",
                 {0.001, 100.0}, {0.045, 0.9}));
  v.Choice("law", law,
           Assumed("in what the curvature between two knots is linear",
                   "Howard 2012 sec. 2: \"linearly with distance or time\""));
  v.Real("waypoint_m", waypoint_m,
         Assumed("distance along a spline, or that to the goal if it is less, after which its "
                 "heading is compared with the direction of the goal; what it misses that by costs "
                 "as much as of an arc after drive.step_m",
                 "the whole spline", {0.01, 20.0}, {0.35, 3.0}));
  v.Require("waypoint_m", waypoint_m <= length_m,
            "is beyond the end of the splines (length_m): they say nothing of where the rover "
            "would head there",
            "use a smaller waypoint_m or a larger length_m");
}

}  // namespace rockyard::navigation
