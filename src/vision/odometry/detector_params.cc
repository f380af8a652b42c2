#include "vision/odometry/detector_params.h"

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

}  // namespace rockyard::vision
