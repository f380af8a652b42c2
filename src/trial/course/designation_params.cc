#include "trial/course/designation_params.h"

#include <cmath>
#include <numbers>

namespace rockyard::trial {

using core::Assumed;
using core::Published;
using core::Setting;

double DesignationParams::PanSd_rad() const {
  if (stated_pan_sd_rad) return *stated_pan_sd_rad;
  return pan_kind == PanError::kFixed ? std::abs(pan_error_rad)
                                      : std::abs(pan_error_rad) / std::numbers::sqrt3;
}

DesignationErrors DesignationParams::ErrorsAt(double range_m) const {
  return {pixel_sd_px * pixel_rad * range_m,
          disparity_sd_px * pixel_rad * range_m * range_m / baseline_m, pan_error_rad * range_m};
}

void DesignationParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled, Setting("the rover is told a goal with errors; else the true one"));
  v.Real("lander_ahead_m", lander_ahead_m,
         Setting("where the lander's cameras stand: ahead of the start, towards the goal",
                 {-1000.0, 1000.0}));
  v.Real("lander_left_m", lander_left_m,
         Setting("and left of the line from start to goal", {-1000.0, 1000.0}));
  v.Real("pixel_sd_px", pixel_sd_px,
         Published("standard deviation with which an operator picks the goal in an image",
                   "Matthies 1995 sec. 4: one pixel", {0.0, 100.0}));
  v.Real("disparity_sd_px", disparity_sd_px,
         Published("standard deviation of the stereo disparity of the goal",
                   "Matthies 1995 sec. 4: 0.1 pixel", {0.0, 100.0}));
  v.Real("pixel_rad", pixel_rad,
         Published("angle that one pixel of the lander's cameras covers",
                   "Matthies 1995 sec. 2.1.1: 0.001 rad", {1e-6, 0.1}));
  v.Real("baseline_m", baseline_m,
         Published("stereo baseline of the lander's cameras", "Matthies 1995 sec. 2.1.1: 15 cm",
                   {0.001, 10.0}));
  v.Choice("pan_kind", pan_kind,
           Published("how the systematic error of the pan angle goes from trial to trial",
                     "Matthies 1995 fig. 4: fixed; the bound of sec. 4 leaves the sign open"));
  v.Angle("pan_error_deg", pan_error_rad,
          Published("systematic error of the pan angle, positive to the left; with pan_kind "
                    "uniform the bound of its size",
                    "Matthies 1995 sec. 4: orientation known to within one degree", {-45.0, 45.0}));
}

void LanderMapParams::Visit(core::FieldVisitor& v) {
  v.Real("mast_height_m", mast_height_m,
         Published("height of the lander's cameras above the ground under them",
                   "Matthies 1995 sec. 2.1.1: a mast 1.5 m above the ground", {0.1, 100.0}));
  v.Real("edge_sd_px", edge_sd_px,
         Assumed("standard deviation with which each edge of a rock is found in an image",
                 "as an operator picks a goal (Matthies 1995 sec. 4: one pixel)", {0.0, 100.0},
                 {0.3, 2.0}));
  v.Real("disparity_sd_px", disparity_sd_px,
         Published("standard deviation of the stereo disparity of a rock",
                   "Matthies 1995 sec. 4: 0.1 pixel, of waypoints", {0.0, 100.0}));
  v.Real("resolved_px", resolved_px,
         Assumed("what is seen of a rock is as wide and as high as this, or the rock is not known",
                 "less than three pixels look like any patch of soil", {0.0, 1000.0}, {1.0, 10.0}));
  v.Real("reach_m", reach_m,
         Assumed("range from the lander beyond which nothing is known",
                 "as far as a rover drives from the lander in a day (Matthies 1995 sec. 8)",
                 {0.1, 1000.0}, {10.0, 60.0}));
}

}  // namespace rockyard::trial
