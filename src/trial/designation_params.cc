#include "trial/designation_params.h"

#include <cmath>
#include <numbers>

namespace rockyard::trial {

using core::Origin;

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
  v.Boolean("enabled", enabled,
            {.doc = "the rover is told a goal with errors; else the true one",
             .origin = Origin::kSetting});
  v.Real("lander_ahead_m", lander_ahead_m,
         {.doc = "where the lander's cameras stand: ahead of the start, towards the goal",
          .min = -1000.0,
          .max = 1000.0,
          .origin = Origin::kSetting});
  v.Real("lander_left_m", lander_left_m,
         {.doc = "and left of the line from start to goal",
          .min = -1000.0,
          .max = 1000.0,
          .origin = Origin::kSetting});
  v.Real("pixel_sd_px", pixel_sd_px,
         {.doc = "standard deviation with which an operator picks the goal in an image",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 4: one pixel"});
  v.Real("disparity_sd_px", disparity_sd_px,
         {.doc = "standard deviation of the stereo disparity of the goal",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 4: 0.1 pixel"});
  v.Real("pixel_rad", pixel_rad,
         {.doc = "angle that one pixel of the lander's cameras covers",
          .min = 1e-6,
          .max = 0.1,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 2.1.1: 0.001 rad"});
  v.Real("baseline_m", baseline_m,
         {.doc = "stereo baseline of the lander's cameras",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 2.1.1: 15 cm"});
  v.Choice("pan_kind", pan_kind,
           {.doc = "how the systematic error of the pan angle goes from trial to trial",
            .origin = Origin::kPublished,
            .source = "Matthies 1995 fig. 4: fixed; the bound of sec. 4 leaves the sign open"});
  v.Angle("pan_error_deg", pan_error_rad,
          {.doc = "systematic error of the pan angle, positive to the left; with pan_kind uniform "
                  "the bound of its size",
           .min = -45.0,
           .max = 45.0,
           .origin = Origin::kPublished,
           .source = "Matthies 1995 sec. 4: orientation known to within one degree"});
}

using core::Origin;

void LanderMapParams::Visit(core::FieldVisitor& v) {
  v.Real("mast_height_m", mast_height_m,
         {.doc = "height of the lander's cameras above the ground under them",
          .min = 0.1,
          .max = 100.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 2.1.1: a mast 1.5 m above the ground"});
  v.Real("edge_sd_px", edge_sd_px,
         {.doc = "standard deviation with which each edge of a rock is found in an image",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "as an operator picks a goal (Matthies 1995 sec. 4: one pixel)",
          .study_low = 0.3,
          .study_high = 2.0});
  v.Real("disparity_sd_px", disparity_sd_px,
         {.doc = "standard deviation of the stereo disparity of a rock",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 4: 0.1 pixel, of waypoints"});
  v.Real("resolved_px", resolved_px,
         {.doc = "what is seen of a rock is as wide and as high as this, or the rock is not known",
          .min = 0.0,
          .max = 1000.0,
          .origin = Origin::kAssumed,
          .source = "less than three pixels look like any patch of soil",
          .study_low = 1.0,
          .study_high = 10.0});
  v.Real("reach_m", reach_m,
         {.doc = "range from the lander beyond which nothing is known",
          .min = 0.1,
          .max = 1000.0,
          .origin = Origin::kAssumed,
          .source = "as far as a rover drives from the lander in a day (Matthies 1995 sec. 8)",
          .study_low = 10.0,
          .study_high = 60.0});
}

}  // namespace rockyard::trial
