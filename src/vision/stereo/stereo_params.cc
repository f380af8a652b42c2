#include "vision/stereo/stereo_params.h"

#include <cmath>

#include "core/check.h"
#include "core/error.h"

namespace rockyard::vision {
namespace {

using core::Assumed;
using core::Published;
using core::Setting;

constexpr std::string_view kSynthetic =
    "Goldberg 2002 sec. 2 names the filter and no number; chosen on synthetic pairs alone "
    "(src/vision/README.md, \"Why these defaults\")";

// Must be the bounds in CorrelatorParams::Visit. The largest disparity, 480 + 511 px, in 1/32 px
// fits 16 bits, and all disparities lie above kLowestValid (disparity.h).
constexpr double kMostDisparities = 512.0;
constexpr double kLargest_px = 480.0;

}  // namespace

void DogParams::Visit(core::FieldVisitor& v) {
  v.Choice("kind", kind,
           Assumed("how the two Gaussians lie: laplacian, a narrow one on a wide one; "
                   "row_gradient, two side by side along the row",
                   "Goldberg 2002 sec. 2 stage 3 has the Laplacian; row_gradient halves the wrong "
                   "matches of rendered pairs (src/vision/README.md, \"Why these defaults\")"));
  v.Integer(
      "narrow_side_px", narrow_side_px,
      Assumed("side of the square whose mean stands for the narrow Gaussian of a Laplacian; odd",
              kSynthetic, {1, 5}, {1, 5}));
  v.Integer(
      "wide_side_px", wide_side_px,
      Assumed("side of the square whose mean stands for the wide Gaussian of a Laplacian; odd",
              kSynthetic, {3, 15}, {7, 15}));
  v.Real("gain", gain,
         Assumed("steps of the filtered image a grey level of difference", kSynthetic, {0.125, 4.0},
                 {1.0, 4.0}));
  v.Integer("limit", limit,
            Assumed("largest step of the filtered image to either side of 0", kSynthetic, {1, 127},
                    {4, 40}));
  v.Require("narrow_side_px", narrow_side_px % 2 == 1, "must be odd", "use 1, 3 or 5");
  v.Require("wide_side_px", wide_side_px % 2 == 1, "must be odd", "use 7, 9, 11, 13 or 15");
  v.Require("wide_side_px", wide_side_px > narrow_side_px, "must be above narrow_side_px",
            "use a square that is two to four times as wide");
}

void CorrelatorParams::Visit(core::FieldVisitor& v) {
  v.Integer("window_side_px", window_side_px,
            Published("side of the window that is compared; the pixel is at side / 2, rounded down",
                      "Goldberg 2002 sec. 2 stage 4: 7 x 7; sec. 3 times 8 x 8", {1, 21}));
  // The bounds must be kLargest_px and kMostDisparities; odometer_params.cc has its own 479 px.
  v.Integer("min_disparity_px", min_disparity_px,
            Setting("smallest disparity that is tried; may be negative", {-480, 480}));
  v.Integer("disparities", disparities,
            Published("disparities that are tried, from the smallest one on",
                      "Goldberg 2002 sec. 3: 256 x 240 pixels over 32 disparities", {1, 512}));
}

void StereoFilterParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "interpolation", interpolation,
      Assumed("what the sub-pixel disparity is the lowest point of",
              "Goldberg 2002 sec. 3 has \"integer-based quadratic peak finding\"; two lines draw "
              "less to whole pixels, as measured on synthetic pairs (src/vision/README.md)"));
  v.Real("line_of_sight_px", line_of_sight_px,
         Assumed("largest difference between the disparities of a pixel and of its match, searched "
                 "in the other direction; its whole part counts",
                 "Goldberg 2002 sec. 2 stage 5: \"fails to match\" without a number; 1 px lets a "
                 "slant through that is seen from two sides",
                 {0.0, 1000.0}, {0.0, 2.0}));
  v.Real("min_curvature", min_curvature,
         Assumed("smallest curvature of the scores at the best match, in steps of the filtered "
                 "image a pixel of the window",
                 kSynthetic, {0.0, 500.0}, {0.0, 4.0}));
  v.Real("min_curvature_ratio", min_curvature_ratio,
         Assumed("smallest curvature of the scores at the best match, divided by its score",
                 kSynthetic, {0.0, 16.0}, {0.0, 0.5}));
  v.Integer(
      "blob_min_px", blob_min_px,
      Assumed("pixels of the smallest region that is kept", kSynthetic, {0, 1000000}, {0, 400}));
  v.Real("blob_max_step_px", blob_max_step_px,
         Assumed("largest step of disparity between neighbours of one region", kSynthetic,
                 {0.0, 100.0}, {0.25, 2.0}));
}

void StereoPipelineParams::Visit(core::FieldVisitor& v) {
  v.Integer("pyramid_level", pyramid_level,
            Setting("images are reduced by 2^level before anything else", {0, 6},
                    "Goldberg 2002 sec. 2 stage 1: 1024 x 1024 down to 256 x 256 is level 2"));
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
