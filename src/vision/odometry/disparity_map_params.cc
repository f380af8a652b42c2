#include "vision/odometry/disparity_map_params.h"

namespace rockyard::vision {

using core::Origin;

void DisparityMapParams::Visit(core::FieldVisitor& v) {
  v.Group("dog", dog, "difference of Gaussians");
  v.Integer("window_side_px", window_side_px,
            {.doc = "side of the window that is compared, about its pixel; odd",
             .min = 1,
             .max = 21,
             .origin = Origin::kPublished,
             .source = "Goldberg 2002 sec. 2 stage 4: 7 x 7"});
  v.Group("filters", filters, "sub-pixel interpolation and the checks that drop pixels");
  v.Real("noise_px", noise_px,
         {.doc = "standard deviation of a disparity of the map",
          .min = 1e-3,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "rendered rocks and soil at level 0: root mean square of 0.14 to 0.17 px from "
                    "1.5 to 4.5 m (results/studies/pyramid_error.csv)",
          .study_low = 0.05,
          .study_high = 0.3});
  v.Real("max_step_px", max_step_px,
         {.doc = "largest difference between neighbours of the map of which one disparity is "
                 "interpolated: a feature on an edge of depth has no place",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "as the blob filter's blob_max_step_px; ground that is seen flat has up to a "
                    "third of a pixel",
          .study_low = 0.25,
          .study_high = 2.0});
  v.Require("window_side_px", window_side_px % 2 == 1, "must be odd",
            "a window of even side lies half a pixel beside its pixel; use 5, 7 or 9");
  CorrelatorParams correlator;
  correlator.window_side_px = window_side_px;
  v.Require("window_side_px", ScoresFit(dog, correlator),
            "squared, times twice dog.limit, is 2^14 or more, so that scores do not fit 16 bits",
            "use a smaller window or a lower limit");
}

}  // namespace rockyard::vision
