#include "vision/cylinder/robust_finder_params.h"

#include <string_view>

namespace rockyard::vision {
namespace {

using core::Assumed;
using core::Calibrated;

void VisitSurface(core::FieldVisitor& v, std::string_view name, SurfaceColour& colour,
                  std::string_view doc) {
  v.FixedReals(
      name, colour,
      Assumed(
          doc,
          "Matthies 1995 sec. 5 names the colours of fluorescent cardboard and tells no numbers",
          {0.01, 2.0}));
}

}  // namespace

void SurfaceColourParams::Visit(core::FieldVisitor& v) {
  VisitSurface(v, "blue", blue, "red, green and blue of quadrant A in white light");
  VisitSurface(v, "magenta", magenta, "of quadrants B and D");
  VisitSurface(v, "third", third, "of quadrant C: orange, or green in its place");
  VisitSurface(v, "ground", ground, "of the ground, which most of the image shows");
}

void ColourModelParams::Visit(core::FieldVisitor& v) {
  v.Real("light_sd", light_sd,
         Assumed("standard deviation of the logarithm of the light's red/green and blue/green",
                 "after the ground of the image has told the light", {0.01, 2.0}, {0.1, 0.5}));
  v.Real("saturation", saturation,
         Assumed("how far colours are from grey in images, 1: as the surfaces are",
                 "crosstalk of a tenth between the channels of one chip", {0.1, 2.0}, {0.5, 1.0}));
  v.Real("saturation_sd", saturation_sd,
         Assumed("standard deviation of the saturation", "cameras with crosstalk of 0 to 0.2",
                 {0.01, 1.0}, {0.1, 0.3}));
  v.Real("surface_sd", surface_sd,
         Assumed("standard deviation of the logarithms of a surface's ratios",
                 "cardboard of one name differs so", {0.01, 1.0}, {0.05, 0.3}));
  v.Real("pixel_sd", pixel_sd,
         Assumed("the same of single pixels of the cylinder, when regions are sought",
                 "mixed pixels and noise", {0.05, 2.0}, {0.2, 0.5}));
  v.Real("ground_sd", ground_sd,
         Assumed("the same of single pixels of the ground", "rocks and soil of Mars differ so",
                 {0.05, 2.0}, {0.1, 0.4}));
  v.Real("neutral_sd", neutral_sd,
         Assumed("the same of single pixels of what is about grey: a rover's metal and solar cells",
                 "solar cells are bluish by up to a half", {0.05, 2.0}, {0.15, 0.4}));
  v.Real("darkest", darkest,
         Assumed("grey levels of the brightest primary below which a pixel has no colour",
                 "five times the noise of a pixel", {1.0, 255.0}, {5.0, 30.0}));
}

void CandidateParams::Visit(core::FieldVisitor& v) {
  v.Integer("longest_gap_px", longest_gap_px,
            Assumed("background pixels between two colours in a row that are filled",
                    "mixed pixels of a sharp boundary", {0, 20}, {0, 4}));
  v.Integer("least_whole_px", least_whole_px,
            Assumed("pixels of the smallest region that is looked at",
                    "a quarter of the cylinder at 17 m", {4, 1000000}, {8, 60}));
  v.Real("least_fill", least_fill,
         Assumed("share of its bounding box that a region fills",
                 "a cylinder seen level fills its box", {0.1, 1.0}, {0.4, 0.8}));
  v.Real("size_tolerance", size_tolerance,
         Assumed("how far the width of a region may be from the cylinder's at its depth by stereo",
                 "before the fit: the depth of a region is known to a fifth at 15 m", {0.01, 1.0},
                 {0.2, 0.5}));
  v.Real("height_tolerance", height_tolerance,
         Assumed("the same of its height", "10 deg of elevation add a third", {0.01, 1.0},
                 {0.2, 0.6}));
  v.Real("box_error_px", box_error_px,
         Assumed("error of a bounding box, added to the tolerances of sizes and to differences "
                 "between the eyes",
                 "a pixel of either rim", {0.0, 20.0}, {1.0, 4.0}));
}

void CylinderFitParams::Visit(core::FieldVisitor& v) {
  v.Real(
      "noise_grey", noise_grey,
      Assumed("noise of a pixel, grey levels",
              "read noise, quantization and shot noise of 8-bit cameras", {0.1, 30.0}, {1.0, 5.0}));
  v.Real(
      "surface_noise", surface_noise,
      Assumed("share of its level by which the wall differs from its model, not averaged over rows",
              "texture of cardboard and what the shading leaves", {0.0, 0.5}, {0.01, 0.05}));
  v.Real(
      "shading_sd", shading_sd,
      Assumed("share of a quadrant's level by which it gets brighter towards one side and towards "
              "the middle",
              "diffuse light and a sun from any side", {0.01, 5.0}, {0.3, 1.0}));
  v.Real("tint_sd", tint_sd,
         Assumed("share of a quadrant's level by which its colour changes towards one side and "
                 "towards the middle, brightness apart",
                 "the sun's light is white and the sky's is not", {0.01, 5.0}, {0.03, 0.5}));
  v.Real("brightness_sd", brightness_sd,
         Assumed(
             "share of its level by which a column of the wall is brighter or darker beside that",
             "where the sun's light ends on the wall it gets darker by a half, and is no edge of a "
             "quadrant: colours tell those",
             {0.0, 5.0}, {0.1, 0.6}));
  v.Real(
      "edge_blur_px", edge_blur_px,
      Assumed("where the fit of the blur of edges starts, as a standard deviation, the pixel's own "
              "0.29 included",
              "between a lens of half a pixel and the colours of a camera of one chip, a pixel",
              {0.29, 3.0}, {0.3, 1.2}));
  v.Real(
      "edge_blur_spread", edge_blur_spread,
      Assumed("standard deviation of the logarithm of the fitted blur over that start",
              "half a pixel to a pixel; strips narrower than their blur look as a wider, paler one "
              "where the blur is taken as too small",
              {0.01, 2.0}, {0.1, 0.8}));
  v.Angle("roll_sd_deg", roll_sd_rad,
          Assumed("standard deviation of the cylinder's lean to a side of the image",
                  "a rover on level ground among rocks", {0.1, 45.0}, {1.0, 15.0}));
  v.Real("model_error_px", model_error_px,
         Calibrated("systematic error of a fitted boundary, added to the covariance",
                    "1305 views of 7 to 15 m, seed 3: with 0.3 two orientations were off by 3.0 "
                    "deviations and 11 and 17 deg, and the mean squared error over the stated one "
                    "was 4.4 at 15 m where 4 is right",
                    {0.0, 2.0}, {0.1, 0.6}));
  v.Real(
      "usual_misfit", usual_misfit,
      Calibrated("mean squared residual over its variance beyond which model_error_px grows with "
                 "it",
                 "the median of 900 views of 7 to 15 m, seed 3; of those of twice as much an "
                 "orientation in ten is three pixels off",
                 {0.01, 10.0}, {0.2, 0.6}));
  v.Real("row_error_px", row_error_px,
         Assumed("error of the row of the centre", "upper and lower rim against textured ground",
                 {0.01, 5.0}, {0.2, 1.0}));
  v.Real("largest_misfit", largest_misfit,
         Assumed("mean squared residual over its variance up to which it is a cylinder",
                 "1 if the model of the noise were right", {1.0, 1000.0}, {2.0, 10.0}));
  v.Real(
      "largest_colour_misfit", largest_colour_misfit,
      Calibrated("squared residuals of the quadrants' colours, against the surfaces' and between "
                 "the eyes, up to which they are its own",
                 "5 % of chi-squared of 6 + 3 numbers: of 5188 views of seed 7 all three wrong "
                 "poses had 16 to 20, "
                 "two of them beside things of other colours that they took for a quadrant",
                 {1.0, 1000.0}, {15.0, 40.0}));
  v.Real("least_margin", least_margin,
         Calibrated("squared residuals by which any other orientation has to be worse",
                    "900 views of 7 to 15 m, seed 3: of 9 with less, 5 were wrong", {0.0, 1000.0},
                    {12.0, 45.0}));
  // "Four" is kRadiusSigmas of robust_finder.cc.
  v.Real(
      "radius_tolerance", radius_tolerance,
      Assumed("how far the size at the depth by stereo may be from the cylinder's, or four of its "
              "standard deviations",
              "calibration of the cameras", {0.01, 1.0}, {0.05, 0.2}));
}

void RobustFinderParams::Visit(core::FieldVisitor& v) {
  v.Group("surfaces", surfaces, "colours of the cylinder and of the ground");
  v.Group("colours", colours, "how light and camera change them");
  v.Group("candidates", candidates, "which regions are looked at");
  v.Group("fit", fit, "the least squares over both eyes");
}

}  // namespace rockyard::vision
