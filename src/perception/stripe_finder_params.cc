#include "perception/stripe_finder_params.h"

#include "core/sources.h"

namespace rockyard::perception {

using core::Origin;

namespace {
using core::kMatthiesSection6;
}  // namespace

void StripeFinderParams::Visit(core::FieldVisitor& v) {
  v.Integer("averaging_px", averaging_px,
            {.doc = "rows and columns over which the difference of the images is averaged",
             .min = 1,
             .max = 15,
             .origin = Origin::kPublished,
             .source = kMatthiesSection6});
  v.Require("averaging_px", averaging_px % 2 == 1, "is even, so that no pixel is in the middle",
            "use 1, 3, 5 or 7");
  v.Real("threshold_counts", threshold_counts,
         {.doc = "averaged difference, in digital numbers, below which nothing is a stripe",
          .min = 0.0,
          .max = 65535.0,
          .origin = Origin::kAssumed,
          .source = "Matthies 1995 sec. 6: thresholding, without a value; one count keeps out the "
                    "steps of the converter",
          .study_low = 0.5,
          .study_high = 4.0});
  v.Real("noise_multiple", noise_multiple,
         {.doc = "the same in multiples of the noise that the scanline itself shows (mean size of "
                 "its averaged differences, as the deviation of a normal variable); the larger of "
                 "both holds. 0: counts alone",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "Matthies 1995 sec. 6: thresholding, without a value; some tens of independent "
                    "averages are searched for each point",
          .study_low = 3.0,
          .study_high = 8.0});
  v.Choice("peak", peak,
           {.doc = "which of several peaks is taken for the stripe",
            .origin = Origin::kAssumed,
            .source = "the stripe is the brightest difference unless the Sun moves"});
  v.Choice("column", column,
           {.doc = "how finely a peak is located",
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 6: detected to pixel resolution"});
}

}  // namespace rockyard::perception
