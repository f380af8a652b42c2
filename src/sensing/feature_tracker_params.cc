#include "sensing/feature_tracker_params.h"

namespace rockyard::sensing {

using core::Origin;

void FeatureTrackerParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            {.doc = "the goal is a feature that the rover tracks: seen, it lies where the rover "
                    "sees it (Goldberg 2002 sec. 4, a waypoint that is specified dynamically)",
             .origin = Origin::kSetting});
  v.Real("range_m", range_m,
         {.doc = "horizontal distance up to which the feature is seen",
          .min = 0.1,
          .max = 1000.0,
          .origin = Origin::kAssumed,
          .source = "Goldberg 2002 names no tracker; a rock 30 cm wide covers 5 pixels of a stereo "
                    "image 128 pixels and 90 deg wide",
          .study_low = 2.0,
          .study_high = 10.0});
  v.Angle("half_field_of_view_deg", half_field_of_view_rad,
          {.doc = "largest bearing at which it is seen, to either side; 180 sees all round",
           .min = 1.0,
           .max = 180.0,
           .origin = Origin::kAssumed,
           .source = "a fixed camera with a wide-angle lens; a mast that pans sees more",
           .study_low = 20.0,
           .study_high = 180.0});
  v.Angle("bearing_sd_deg", bearing_sd_rad,
          {.doc = "standard deviation of a measured bearing",
           .min = 0.0,
           .max = 45.0,
           .origin = Origin::kAssumed,
           .source = "a pixel of an image 128 pixels and 90 deg wide is 0.7 deg",
           .study_low = 0.1,
           .study_high = 2.0});
  v.Real("range_sd_fraction", range_sd_fraction,
         {.doc = "standard deviation of a measured range over the range",
          .min = 0.0,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = "stereo over a few metres, to a few centimetres a metre",
          .study_low = 0.005,
          .study_high = 0.1});
  v.Real("period_s", period_s,
         {.doc = "simulated time from one measurement to the next",
          .min = 0.01,
          .max = 3600.0,
          .origin = Origin::kAssumed,
          .source = "one that always returns the feature's position (Goldberg 2002 sec. 4) is "
                    "quicker than looks and moves",
          .study_low = 0.1,
          .study_high = 30.0});
}

}  // namespace rockyard::sensing
