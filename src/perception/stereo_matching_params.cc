#include "perception/stereo_matching_params.h"

namespace rockyard::perception {

using core::Published;

void StereoMatchingParams::Visit(core::FieldVisitor& v) {
  v.Group("dog", dog, "difference of Gaussians");
  v.Integer("window_side_px", window_side_px,
            Published("side of the window that is compared; the pixel is at side / 2, rounded down",
                      "Goldberg 2002 sec. 2 stage 4: 7 x 7; sec. 3 times 8 x 8", {1, 21}));
  v.Group("filters", filters, "sub-pixel interpolation and the checks that drop pixels");
  vision::CorrelatorParams correlator;
  correlator.window_side_px = window_side_px;
  v.Require("window_side_px", vision::ScoresFit(dog, correlator),
            "squared, times twice dog.limit, is 2^14 or more, so that scores do not fit 16 bits",
            "use a smaller window or a lower limit");
}

}  // namespace rockyard::perception
