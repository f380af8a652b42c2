#include "sensing/stripe_detection_params.h"

#include <algorithm>

#include "core/sources.h"
#include "sensing/stripe_layout_params.h"

namespace rockyard::sensing {
namespace {

using core::Origin;

using core::kMatthiesSection6;

void VisitSearch(LightStripeParams& p, core::FieldVisitor& v) {
  v.Real("search_low_m", p.search_low_m,
         {.doc = "lowest elevation whose column is searched for a stripe",
          .min = -5.0,
          .max = -0.01,
          .origin = Origin::kAssumed,
          .source = "deeper than any drop that the rover could enter",
          .study_low = -0.5,
          .study_high = -0.15});
  v.Real("search_high_m", p.search_high_m,
         {.doc = "highest elevation whose column is searched for a stripe",
          .min = 0.01,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "just below cameras and emitters",
          .study_low = 0.13,
          .study_high = 0.22});
  v.Require("search_high_m",
            p.datum_z_m + p.search_high_m < std::min(p.emitter_height_m, p.camera_height_m),
            "reaches the height of the cameras or emitters, where a scanline holds no point",
            "use a value below camera_height_m and emitter_height_m, counted from datum_z_m");
  v.Real("max_range_m", p.max_range_m,
         {.doc = "largest distance from the camera at which a stripe is bright enough (geometric "
                 "level); images show rocks that far",
          .min = 0.05,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "twice what flat ground needs",
          .study_low = 0.7,
          .study_high = 2.0});
}

void VisitErrors(LightStripeParams& p, core::FieldVisitor& v) {
  v.Real("wrong_place_probability", p.wrong_place_probability,
         {.doc = "chance that a point is detected in the wrong place of its scanline (geometric "
                 "level only)",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kPublished,
          .source = kMatthiesSection6});
  v.Choice("wrong_place", p.wrong_place,
           {.doc = "where such a point appears (geometric level only)",
            .origin = Origin::kAssumed,
            .source = "a wrong peak is found where a peak is looked for"});
  v.Real("missed_probability", p.missed_probability,
         {.doc = "chance that a visible point is not detected (geometric level only)",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = kMatthiesSection6,
          .study_low = 0.0,
          .study_high = 0.01});
  v.Reals(
      "missed_at", p.missed_at,
      {.doc = "the same for each point, row by row from the nearest, left to right, in place of "
              "missed_probability (geometric level only); empty: the same for all. Faint light "
              "misses the farthest and outermost points first: fit_stripe_errors.py fits them "
              "to images",
       .min = 0.0,
       .max = 1.0,
       .origin = Origin::kSetting});
  const messages::StripeArraySize size = ArraySize(p);
  v.Require("missed_at", p.missed_at.empty() || p.missed_at.size() == size.rows * size.stripes,
            "does not have one value for each point of the array",
            "give rows times stripes values, or none");
  v.Real("outlier_persistence", p.outlier_persistence,
         {.doc = "chance that a point keeps from one scan to the next whether and where it is "
                 "misplaced; 0: scans are independent (geometric level only)",
          .min = 0.0,
          .max = 0.99,
          .origin = Origin::kAssumed,
          .source = "Matthies 1995 sec. 6: two scans make false alarms vanish, which takes "
                    "independence; figure 8 shows one that two scans must have agreed on",
          .study_low = 0.0,
          .study_high = 0.5});
  v.Real("column_noise_px", p.column_noise_px,
         {.doc = "standard deviation by which found columns are off, before rounding to pixels "
                 "(geometric level only)",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "Matthies 1995 sec. 6: detected to pixel resolution",
          .study_low = 0.0,
          .study_high = 1.0});
}

}  // namespace

void VisitStripeDetection(LightStripeParams& p, core::FieldVisitor& v) {
  VisitSearch(p, v);
  VisitErrors(p, v);
}

}  // namespace rockyard::sensing
