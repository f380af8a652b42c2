#include "vision/cylinder/published_finder_params.h"

namespace rockyard::vision {
namespace {

using core::Assumed;
using core::Published;

constexpr std::string_view kRatioSource =
    "Matthies 1995 A.3 calls the ranges experimentally determined and does not tell them; chosen "
    "about the surface colours of published_finder_params.h";

void VisitRatio(core::FieldVisitor& v, std::string_view name, double& value, std::string_view doc) {
  v.Real(name, value, Assumed(doc, kRatioSource, {0.0, 255.0}, {0.0, 1.5}));
}

}  // namespace

void ColourRatioParams::Visit(core::FieldVisitor& v) {
  v.Choice("over", over,
           Published("the primary that the two others are divided by",
                     "Matthies 1995 A.3: over red for red and magenta, over blue for blue"));
  VisitRatio(v, "first_low", first_low, "least ratio of the first of the two other primaries");
  VisitRatio(v, "first_high", first_high, "largest ratio of the first of the two other primaries");
  VisitRatio(v, "second_low", second_low, "least ratio of the second of the two other primaries");
  VisitRatio(v, "second_high", second_high,
             "largest ratio of the second of the two other primaries");
  v.Require("first_high", first_high >= first_low, "is below first_low", "give a larger one");
  v.Require("second_high", second_high >= second_low, "is below second_low", "give a larger one");
}

void ColourClassParams::Visit(core::FieldVisitor& v) {
  v.Group("blue", blue, "the class blue");
  v.Group("magenta", magenta, "the class magenta: pink");
  v.Group("red", red, "the third class: orange, or green in its place");
  v.Real("darkest", darkest,
         Assumed("grey levels of the primary below which a pixel is background",
                 "not in Matthies 1995; noise of 2 grey levels moves a ratio by 0.1 there",
                 {1.0, 255.0}, {5.0, 40.0}));
}

ColourRatioParams GreenRatios() { return {PrimaryColour::kGreen, 0.0, 0.50, 0.0, 0.60}; }

void PublishedFinderParams::Visit(core::FieldVisitor& v) {
  v.Group("classes", classes, "the classes of colours");
  v.Integer("longest_gap_px", longest_gap_px,
            Published("background pixels between two colours in a row that are filled from both",
                      "Matthies 1995 A.3: one to four", {0, 100}));
  v.Real("sky_share", sky_share,
         Assumed("share of the image, from its top, outside of the area of interest",
                 "Matthies 1995 A.3 leaves the sky out and does not say how; where the horizon is "
                 "depends on the cameras",
                 {0.0, 0.95}, {0.0, 0.6}));
  v.Choice("measure", measure,
           Assumed("what is seen of a quadrant: pixels, or the columns of its bounding box",
                   "Matthies 1995 A.3 ends with both"));
  v.Integer("least_whole_px", least_whole_px,
            Assumed("pixels of the largest region below which there is no cylinder",
                    "a quarter of the cylinder at 15 m", {1, 1000000}, {5, 100}));
  v.Integer("least_quadrant_px", least_quadrant_px,
            Assumed("pixels of a region beside the middle one below which it is not seen",
                    "more than stray pixels at the rim", {1, 1000000}, {1, 20}));
  v.Real("box_difference_px", box_difference_px,
         Assumed("difference of the sides of both eyes' bounding boxes, and of their upper and "
                 "lower rows, that is allowed at any size",
                 "a pixel of either rim", {0.0, 1000.0}, {1.0, 5.0}));
  v.Real("box_difference_share", box_difference_share,
         Assumed("the same as a share of the larger side, in addition",
                 "Matthies 1995 A.3: the boxes are similar to each other", {0.0, 1.0}, {0.1, 0.5}));
  v.Angle("largest_turn_between_eyes_deg", largest_turn_between_eyes_rad,
          Assumed("difference of both eyes' orientations up to which they are consistent",
                  "four times the coarsest step at 10 m, less than a quadrant and a half",
                  {0.0, 180.0}, {20.0, 90.0}));
  v.Real("pixel_error_px", pixel_error_px,
         Published("standard deviation of boundary, width and disparity, for the covariance",
                   "Matthies 1995 sec. 5: usually less than one or two pixels", {0.01, 10.0},
                   {0.5, 2.0}));
}

}  // namespace rockyard::vision
