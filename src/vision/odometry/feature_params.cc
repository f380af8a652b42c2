#include "vision/odometry/feature_params.h"

#include <algorithm>

namespace rockyard::vision {

using core::Assumed;
using core::Published;

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
            Published("regions in which features are looked for, side by side; as wide as each "
                      "other within a pixel",
                      "Howard 2012 sec. 3: 16 regions of 512 x 384; as 4 x 4 is assumed", {1, 64}));
  v.Integer("regions_down", regions_down,
            Published("and one above the other", "as regions_across", {1, 64}));
  v.Integer("min_features", min_features,
            Published("features of a region (counted_in) that weaker corners are taken for",
                      "Howard 2012 sec. 3: 10 to 100 features", {0, 100000}));
  v.Integer("max_features", max_features,
            Assumed("most features of a region; only the strongest are kept",
                    "16 regions of 25 are the 400 features an image of Howard 2012 sec. 3, which "
                    "allows up to 100",
                    {1, 100000}, {4, 100}));
  v.Choice("counted_in", counted_in,
           Assumed("whether min_features and max_features are those of every region or of the "
                   "image, whose regions share them alike",
                   "Howard 2012 sec. 2 says: in each local region; sec. 3 leaves it open"));
  v.Choice("adapted", adapted,
           Assumed("what is changed until a region has between min_features and max_features: the "
                   "threshold of the response, or the weight of the trace in it",
                   "Howard 2012 sec. 2: the weights of the feature detector are iteratively "
                   "modified; that of the trace is Harris' only one"));
  // The upper bound must be kLargestWeight of detect_features.cc.
  v.Real("weight", weight,
         Assumed("k of the response det - k trace^2 (Harris and Stephens 1988); where it is "
                 "adapted, what it begins with",
                 "the usual one; 0.25 leaves no corner", {0.0, 0.24}, {0.04, 0.15}));
  v.Real("threshold", threshold,
         Assumed("response from which on a corner is a feature; where the threshold is adapted, "
                 "what it begins with",
                 "slopes of 0.6 grey levels a pixel in both directions", {0.0, 6e8}, {100.0, 1e5}));
  v.Real(
      "min_threshold", min_threshold,
      Assumed("it is not lowered below this: what is weaker is noise of pixels",
              "slopes of 0.3 grey levels a pixel in both directions", {0.0, 6e8}, {10.0, 1000.0}));
  v.Require("min_threshold", min_threshold <= threshold, "is above threshold",
            "use a value up to threshold");
  v.Integer(
      "suppression_px", suppression_px,
      Assumed("a feature is the strongest corner within so many columns and rows",
              "smaller than half a window of matching, so that windows differ", {1, 32}, {1, 8}));
  v.Integer("border_px", border_px,
            Assumed("columns and rows at the edges of the image without features: windows of "
                    "matching and what refines them have to lie inside",
                    "half the 15 pixels of a window, and one", {4, 64}, {8, 16}));
  v.Require("min_features", min_features <= max_features, "is above max_features",
            "use a value up to max_features");
}

void FeatureMatcherParams::Visit(core::FieldVisitor& v) {
  v.Integer("window_px", window_px,
            Published("side of the windows that are compared; odd",
                      "Howard 2012 sec. 2: 15 pixel by 15 pixel", {3, 15}));
  v.Require("window_px", window_px % 2 == 1, "must be odd", "use 15");
  v.Boolean("mutual", mutual,
            Assumed("a match is the best of both its features; else of the first one's only",
                    "Howard 2012 sec. 2 compares each with each and does not say which are kept"));
  v.Real(
      "ratio", ratio,
      Assumed(
          "a match's difference is at most so much of that of the second best; 1: whatever it is",
          "not in Howard 2012; the consistent set follows anyway", {0.01, 1.0}, {0.7, 1.0}));
  v.Real("max_difference", max_difference,
         Assumed("mean absolute difference of two windows up to which they are alike, grey levels",
                 "beyond what shadows and another view of a rock do", {0.0, 255.0}, {10.0, 60.0}));
  v.Choice("search", search,
           Assumed("which features of the second image are compared: all, or those near where a "
                   "predicted motion puts the feature",
                   "Howard 2012 sec. 2 compares all; MER searches where wheels say (Maimone, Cheng "
                   "and Matthies 2007)"));
  v.Real(
      "search_columns_px", search_columns_px,
      Assumed("how many columns from there",
              "a heading wrong by 5 deg with a focal length of 600 px", {0.0, 1e4}, {20.0, 120.0}));
  v.Real("search_rows_px", search_rows_px,
         Assumed("how many rows from there", "a pitch wrong by 4 deg with a focal length of 600 px",
                 {0.0, 1e4}, {10.0, 80.0}));
  v.Choice("warp", warp,
           Assumed("whether windows are turned and scaled by the predicted motion before",
                   "after 75 cm a rock 3 m away is a third larger"));
}

}  // namespace rockyard::vision
