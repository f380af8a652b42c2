#include "vision/cylinder/colour_class_params.h"

namespace rockyard::vision {
namespace {

constexpr std::string_view kRatioSource =
    "Matthies 1995 A.3 calls the ranges experimentally determined and does not tell them; chosen "
    "about the surface colours of colour_class_params.h";

void VisitRatio(core::FieldVisitor& v, std::string_view name, double& value, std::string_view doc) {
  v.Real(name, value,
         {.doc = doc,
          .min = 0.0,
          .max = 255.0,
          .origin = core::Origin::kAssumed,
          .source = kRatioSource,
          .study_low = 0.0,
          .study_high = 1.5});
}

}  // namespace

void ColourRatioParams::Visit(core::FieldVisitor& v) {
  v.Choice("over", over,
           {.doc = "the primary that the two others are divided by",
            .origin = core::Origin::kPublished,
            .source = "Matthies 1995 A.3: over red for red and magenta, over blue for blue"});
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
         {.doc = "grey levels of the primary below which a pixel is background",
          .min = 1.0,
          .max = 255.0,
          .origin = core::Origin::kAssumed,
          .source = "not in Matthies 1995; noise of 2 grey levels moves a ratio by 0.1 there",
          .study_low = 5.0,
          .study_high = 40.0});
}

ColourRatioParams GreenRatios() { return {PrimaryColour::kGreen, 0.0, 0.50, 0.0, 0.60}; }

}  // namespace rockyard::vision
