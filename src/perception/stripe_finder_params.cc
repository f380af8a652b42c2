#include "perception/stripe_finder_params.h"

#include "core/sources.h"

namespace rockyard::perception {

using core::Assumed;
using core::kMatthiesSection6;
using core::Published;

namespace {}  // namespace

void StripeFinderParams::Visit(core::FieldVisitor& v) {
  v.Integer("averaging_px", averaging_px,
            Published("rows and columns over which the difference of the images is averaged",
                      kMatthiesSection6, {1, 15}));
  v.Require("averaging_px", averaging_px % 2 == 1, "is even, so that no pixel is in the middle",
            "use 1, 3, 5 or 7");
  v.Real("threshold_counts", threshold_counts,
         Assumed("averaged difference, in digital numbers, below which nothing is a stripe",
                 "Matthies 1995 sec. 6: thresholding, without a value; one count keeps out the "
                 "steps of the converter",
                 {0.0, 65535.0}, {0.5, 4.0}));
  v.Real("noise_multiple", noise_multiple,
         Assumed("the same in multiples of the noise that the scanline itself shows (mean size of "
                 "its averaged differences, as the deviation of a normal variable); the larger of "
                 "both holds. 0: counts alone",
                 "Matthies 1995 sec. 6: thresholding, without a value; some tens of independent "
                 "averages are searched for each point",
                 {0.0, 100.0}, {3.0, 8.0}));
  v.Choice("peak", peak,
           Assumed("which of several peaks is taken for the stripe",
                   "the stripe is the brightest difference unless the Sun moves"));
  v.Choice("column", column,
           Published("how finely a peak is located",
                     "Matthies 1995 sec. 6: detected to pixel resolution"));
}

}  // namespace rockyard::perception
