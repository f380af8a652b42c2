#include "trial/lander_map_params.h"

namespace rockyard::trial {

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
