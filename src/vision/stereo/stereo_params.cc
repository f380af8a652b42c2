#include "vision/stereo/stereo_params.h"

#include <cmath>

#include "core/check.h"
#include "core/error.h"

namespace rockyard::vision {
namespace {

using core::Origin;

constexpr std::string_view kSynthetic =
    "Goldberg 2002 sec. 2 names the filter and no number; chosen on synthetic pairs alone "
    "(src/vision/README.md, \"Why these defaults\")";

constexpr double kMostDisparities = 512.0;
constexpr double kLargest_px = 480.0;

}  // namespace

void DogParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "kind", kind,
      {.doc = "how the two Gaussians lie: laplacian, a narrow one on a wide one; row_gradient, "
              "two side by side along the row",
       .origin = Origin::kAssumed,
       .source = "Goldberg 2002 sec. 2 stage 3 has the Laplacian; row_gradient halves the "
                 "wrong matches of rendered pairs (src/vision/README.md, \"Why these "
                 "defaults\")"});
  v.Integer(
      "narrow_side_px", narrow_side_px,
      {.doc = "side of the square whose mean stands for the narrow Gaussian of a Laplacian; odd",
       .min = 1,
       .max = 5,
       .origin = Origin::kAssumed,
       .source = kSynthetic,
       .study_low = 1,
       .study_high = 5});
  v.Integer(
      "wide_side_px", wide_side_px,
      {.doc = "side of the square whose mean stands for the wide Gaussian of a Laplacian; odd",
       .min = 3,
       .max = 15,
       .origin = Origin::kAssumed,
       .source = kSynthetic,
       .study_low = 7,
       .study_high = 15});
  v.Real("gain", gain,
         {.doc = "steps of the filtered image a grey level of difference",
          .min = 0.125,
          .max = 4.0,
          .origin = Origin::kAssumed,
          .source = kSynthetic,
          .study_low = 1.0,
          .study_high = 4.0});
  v.Integer("limit", limit,
            {.doc = "largest step of the filtered image to either side of 0",
             .min = 1,
             .max = 127,
             .origin = Origin::kAssumed,
             .source = kSynthetic,
             .study_low = 4,
             .study_high = 40});
  v.Require("narrow_side_px", narrow_side_px % 2 == 1, "must be odd", "use 1, 3 or 5");
  v.Require("wide_side_px", wide_side_px % 2 == 1, "must be odd", "use 7, 9, 11, 13 or 15");
  v.Require("wide_side_px", wide_side_px > narrow_side_px, "must be above narrow_side_px",
            "use a square that is two to four times as wide");
}

void CorrelatorParams::Visit(core::FieldVisitor& v) {
  v.Integer("window_side_px", window_side_px,
            {.doc = "side of the window that is compared; the pixel is at side / 2, rounded down",
             .min = 1,
             .max = 21,
             .origin = Origin::kPublished,
             .source = "Goldberg 2002 sec. 2 stage 4: 7 x 7; sec. 3 times 8 x 8"});
  v.Integer("min_disparity_px", min_disparity_px,
            {.doc = "smallest disparity that is tried; may be negative",
             .min = -480,
             .max = 480,
             .origin = Origin::kSetting});
  v.Integer("disparities", disparities,
            {.doc = "disparities that are tried, from the smallest one on",
             .min = 1,
             .max = 512,
             .origin = Origin::kPublished,
             .source = "Goldberg 2002 sec. 3: 256 x 240 pixels over 32 disparities"});
}

void StereoFilterParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "interpolation", interpolation,
      {.doc = "what the sub-pixel disparity is the lowest point of",
       .origin = Origin::kAssumed,
       .source = "Goldberg 2002 sec. 3 has \"integer-based quadratic peak finding\"; two lines "
                 "draw less to whole pixels, as measured on synthetic pairs "
                 "(src/vision/README.md)"});
  v.Real(
      "line_of_sight_px", line_of_sight_px,
      {.doc = "largest difference between the disparities of a pixel and of its match, searched "
              "in the other direction; its whole part counts",
       .min = 0.0,
       .max = 1000.0,
       .origin = Origin::kAssumed,
       .source = "Goldberg 2002 sec. 2 stage 5: \"fails to match\" without a number; 1 px lets a "
                 "slant through that is seen from two sides",
       .study_low = 0.0,
       .study_high = 2.0});
  v.Real("min_curvature", min_curvature,
         {.doc = "smallest curvature of the scores at the best match, in steps of the filtered "
                 "image a pixel of the window",
          .min = 0.0,
          .max = 500.0,
          .origin = Origin::kAssumed,
          .source = kSynthetic,
          .study_low = 0.0,
          .study_high = 4.0});
  v.Real("min_curvature_ratio", min_curvature_ratio,
         {.doc = "smallest curvature over the score of the best match itself",
          .min = 0.0,
          .max = 16.0,
          .origin = Origin::kAssumed,
          .source = kSynthetic,
          .study_low = 0.0,
          .study_high = 0.5});
  v.Integer("blob_min_px", blob_min_px,
            {.doc = "pixels of the smallest region that is kept",
             .min = 0,
             .max = 1000000,
             .origin = Origin::kAssumed,
             .source = kSynthetic,
             .study_low = 0,
             .study_high = 400});
  v.Real("blob_max_step_px", blob_max_step_px,
         {.doc = "largest step of disparity between neighbours of one region",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = kSynthetic,
          .study_low = 0.25,
          .study_high = 2.0});
}

void StereoPipelineParams::Visit(core::FieldVisitor& v) {
  v.Integer("pyramid_level", pyramid_level,
            {.doc = "images are reduced by 2^level before anything else",
             .min = 0,
             .max = 6,
             .origin = Origin::kSetting,
             .source = "Goldberg 2002 sec. 2 stage 1: 1024 x 1024 down to 256 x 256 is level 2"});
  v.Group("dog", dog, "difference of Gaussians");
  v.Group("correlator", correlator, "what is compared, and over which range");
  v.Group("filters", filters, "what drops a match");
  v.Require("correlator.window_side_px", ScoresFit(dog, correlator),
            "is too large for sums in 16 bits: side^2 * 2 dog.limit must stay below 16383",
            "a limit of 127 takes windows up to 8 x 8, 36 up to 15 x 15, 18 up to 21 x 21");
}

bool ScoresFit(const DogParams& dog, const CorrelatorParams& correlator) {
  return correlator.window_side_px * correlator.window_side_px * 2 * dog.limit < (1 << 14) - 1;
}

CorrelatorParams SearchDepths(const StereoGeometry& pair, double nearest_m, double farthest_m,
                              CorrelatorParams correlator) {
  EXPECT(pair.focal_px > 0.0 && pair.baseline_m > 0.0);
  EXPECT(0.0 < nearest_m && nearest_m <= farthest_m);
  const double strength = pair.focal_px * pair.baseline_m;
  const double smallest = std::floor(strength / farthest_m + pair.offset_px) - 1.0;
  const double largest = std::ceil(strength / nearest_m + pair.offset_px) + 1.0;
  const double count = largest - smallest + 1.0;
  if (!(count <= kMostDisparities && std::abs(smallest) <= kLargest_px)) {
    throw core::UserError("depths",
                          "ask for disparities from " + std::to_string(smallest) + " to " +
                              std::to_string(largest) + " px, more than is searched",
                          "begin farther away, or use a higher level of the pyramid");
  }
  correlator.min_disparity_px = static_cast<std::int64_t>(smallest);
  correlator.disparities = static_cast<std::int64_t>(count);
  return correlator;
}

}  // namespace rockyard::vision
