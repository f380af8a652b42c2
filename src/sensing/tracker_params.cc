#include "sensing/tracker_params.h"

namespace rockyard::sensing {

using core::Assumed;
using core::Setting;

void FeatureTrackerParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("the goal is a feature that the rover tracks: seen, it lies where the rover "
                    "sees it (Goldberg 2002 sec. 4, a waypoint that is specified dynamically)"));
  v.Real("range_m", range_m,
         Assumed("horizontal distance up to which the feature is seen",
                 "Goldberg 2002 names no tracker; a rock 30 cm wide covers 5 pixels of a stereo "
                 "image 128 pixels and 90 deg wide",
                 {0.1, 1000.0}, {2.0, 10.0}));
  v.Angle("half_field_of_view_deg", half_field_of_view_rad,
          Assumed("largest bearing at which it is seen, to either side; 180 sees all round",
                  "a fixed camera with a wide-angle lens; a mast that pans sees more", {1.0, 180.0},
                  {20.0, 180.0}));
  v.Angle("bearing_sd_deg", bearing_sd_rad,
          Assumed("standard deviation of a measured bearing",
                  "a pixel of an image 128 pixels and 90 deg wide is 0.7 deg", {0.0, 45.0},
                  {0.1, 2.0}));
  v.Real(
      "range_sd_fraction", range_sd_fraction,
      Assumed("standard deviation of a measured range over the range",
              "stereo over a few metres, to a few centimetres a metre", {0.0, 0.5}, {0.005, 0.1}));
  v.Real("period_s", period_s,
         Assumed("simulated time from one measurement to the next",
                 "a tracker that always returns the feature's position (Goldberg 2002 sec. 4) "
                 "measures more often than the rover looks or moves",
                 {0.01, 3600.0}, {0.1, 30.0}));
}

}  // namespace rockyard::sensing
