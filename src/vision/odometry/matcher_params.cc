#include "vision/odometry/matcher_params.h"

namespace rockyard::vision {

void FeatureMatcherParams::Visit(core::FieldVisitor& v) {
  using core::Origin;
  v.Integer("window_px", window_px,
            {.doc = "side of the windows that are compared; odd",
             .min = 3,
             .max = 15,
             .origin = Origin::kPublished,
             .source = "Howard 2012 sec. 2: 15 pixel by 15 pixel"});
  v.Require("window_px", window_px % 2 == 1, "must be odd", "use 15");
  v.Boolean(
      "mutual", mutual,
      {.doc = "a match is the best of both its features; else of the first one's only",
       .origin = Origin::kAssumed,
       .source = "Howard 2012 sec. 2 compares each with each and does not say which are kept"});
  v.Real(
      "ratio", ratio,
      {.doc = "a match's difference is at most so much of that of the second best; 1: whatever it "
              "is",
       .min = 0.01,
       .max = 1.0,
       .origin = Origin::kAssumed,
       .source = "not in Howard 2012; the consistent set follows anyway",
       .study_low = 0.7,
       .study_high = 1.0});
  v.Real("max_difference", max_difference,
         {.doc = "mean absolute difference of two windows up to which they are alike, grey levels",
          .min = 0.0,
          .max = 255.0,
          .origin = Origin::kAssumed,
          .source = "beyond what shadows and another view of a rock do",
          .study_low = 10.0,
          .study_high = 60.0});
  v.Choice("search", search,
           {.doc = "which features of the second image are compared: all, or those near where a "
                   "predicted motion puts the feature",
            .origin = Origin::kAssumed,
            .source = "Howard 2012 sec. 2 compares all; MER searches where wheels say (Maimone, "
                      "Cheng and Matthies 2007)"});
  v.Real("search_columns_px", search_columns_px,
         {.doc = "how many columns from there",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kAssumed,
          .source = "a heading wrong by 5 deg with a focal length of 600 px",
          .study_low = 20.0,
          .study_high = 120.0});
  v.Real("search_rows_px", search_rows_px,
         {.doc = "how many rows from there",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kAssumed,
          .source = "a pitch wrong by 4 deg with a focal length of 600 px",
          .study_low = 10.0,
          .study_high = 80.0});
  v.Choice("warp", warp,
           {.doc = "whether windows are turned and scaled by the predicted motion before",
            .origin = Origin::kAssumed,
            .source = "after 75 cm a rock 3 m away is a third larger"});
}

}  // namespace rockyard::vision
