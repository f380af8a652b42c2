#include "vision/odometry/feature_params.h"

#include <algorithm>

namespace rockyard::vision {

using core::Origin;

std::int64_t FeatureDetectorParams::min_of_region() const {
  return counted_in == CountedIn::kRegion ? min_features : min_features / regions();
}

std::int64_t FeatureDetectorParams::max_of_region() const {
  return counted_in == CountedIn::kRegion
             ? max_features
             : std::max<std::int64_t>(max_features / regions(), std::int64_t{1});
}

void FeatureDetectorParams::Visit(core::FieldVisitor& v) {
  v.Integer("regions_across", regions_across,
            {.doc = "regions in which features are looked for, side by side; as wide as each other "
                    "within a pixel",
             .min = 1,
             .max = 64,
             .origin = Origin::kPublished,
             .source = "Howard 2012 sec. 3: 16 regions of 512 x 384; as 4 x 4 is assumed"});
  v.Integer("regions_down", regions_down,
            {.doc = "and one above the other",
             .min = 1,
             .max = 64,
             .origin = Origin::kPublished,
             .source = "as regions_across"});
  v.Integer("min_features", min_features,
            {.doc = "features of a region (counted_in) that weaker corners are taken for",
             .min = 0,
             .max = 100000,
             .origin = Origin::kPublished,
             .source = "Howard 2012 sec. 3: 10 to 100 features"});
  v.Integer(
      "max_features", max_features,
      {.doc = "most features of a region; only the strongest are kept",
       .min = 1,
       .max = 100000,
       .origin = Origin::kAssumed,
       .source = "16 regions of 25 are the 400 features an image of Howard 2012 sec. 3, which "
                 "allows up to 100",
       .study_low = 4,
       .study_high = 100});
  v.Choice(
      "counted_in", counted_in,
      {.doc = "whether min_features and max_features are those of every region or of the image, "
              "whose regions share them alike",
       .origin = Origin::kAssumed,
       .source = "Howard 2012 sec. 2 says: in each local region; sec. 3 leaves it open"});
  v.Choice("adapted", adapted,
           {.doc = "what is changed until a region has between min_features and max_features: the "
                   "threshold of the response, or the weight of the trace in it",
            .origin = Origin::kAssumed,
            .source = "Howard 2012 sec. 2: the weights of the feature detector are iteratively "
                      "modified; that of the trace is Harris' only one"});
  v.Real(
      "weight", weight,
      {.doc = "k of the response det - k trace^2 (Harris and Stephens 1988); where it is adapted, "
              "what it begins with",
       .min = 0.0,
       .max = 0.24,
       .origin = Origin::kAssumed,
       .source = "the usual one; 0.25 leaves no corner",
       .study_low = 0.04,
       .study_high = 0.15});
  v.Real(
      "threshold", threshold,
      {.doc = "response from which on a corner is a feature; where the threshold is adapted, what "
              "it begins with",
       .min = 0.0,
       .max = 6e8,
       .origin = Origin::kAssumed,
       .source = "slopes of 0.6 grey levels a pixel in both directions",
       .study_low = 100.0,
       .study_high = 1e5});
  v.Real("min_threshold", min_threshold,
         {.doc = "it is not lowered below this: what is weaker is noise of pixels",
          .min = 0.0,
          .max = 6e8,
          .origin = Origin::kAssumed,
          .source = "slopes of 0.3 grey levels a pixel in both directions",
          .study_low = 10.0,
          .study_high = 1000.0});
  v.Require("min_threshold", min_threshold <= threshold, "is above threshold",
            "use a value up to threshold");
  v.Integer("suppression_px", suppression_px,
            {.doc = "a feature is the strongest corner within so many columns and rows",
             .min = 1,
             .max = 32,
             .origin = Origin::kAssumed,
             .source = "smaller than half a window of matching, so that windows differ",
             .study_low = 1,
             .study_high = 8});
  v.Integer("border_px", border_px,
            {.doc = "columns and rows at the edges of the image without features: windows of "
                    "matching and what refines them have to lie inside",
             .min = 4,
             .max = 64,
             .origin = Origin::kAssumed,
             .source = "half the 15 pixels of a window, and one",
             .study_low = 8,
             .study_high = 16});
  v.Require("min_features", min_features <= max_features, "is above max_features",
            "use a value up to max_features");
}

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
