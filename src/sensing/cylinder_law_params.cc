#include "sensing/cylinder_law_params.h"

#include <string_view>

namespace rockyard::sensing {
namespace {

using core::Origin;

constexpr const char* kCylinderFit =
    "fitted to rendered views (fit_lander_fix.py; 2,000 of scenarios/cylinder/views.json, "
    "seed 1)";

}  // namespace

void CylinderChanceParams::Visit(core::FieldVisitor& v) {
  const auto field = [&](std::string_view name, double& value, std::string_view doc) {
    v.Real(name, value,
           {.doc = doc,
            .min = -1000.0,
            .max = 1000.0,
            .origin = Origin::kCalibrated,
            .source = kCylinderFit});
  };
  field("intercept", intercept,
        "log odds at 20 pixels of width with blue in view and the sun in the horizon");
  field("width", width, "what they grow by with the logarithm of the width");
  field("no_blue", no_blue, "what is added where no blue is seen (theta in -180 to -90 deg)");
  field(
      "pink_aside", pink_aside,
      "what is added where a panel that is not pink stands in the middle, taken away where a pink "
      "one does: times sin(2 theta)");
  field("light", light, "what is added under a sun in the zenith, times the sine of its elevation");
}

void CylinderAngleDeviationParams::Visit(core::FieldVisitor& v) {
  v.Angle("least_deg", least,
          {.doc = "deviation of a cylinder of any width",
           .min = 0.0,
           .max = 180.0,
           .origin = Origin::kCalibrated,
           .source = kCylinderFit});
  v.Real("pixels", pixels,
         {.doc = "deviation in pixels, each worth what equations 18 to 23 of Matthies 1995 say",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kCalibrated,
          .source = kCylinderFit});
}

void CylinderRangeDeviationParams::Visit(core::FieldVisitor& v) {
  v.Real("least", least,
         {.doc = "deviation of a cylinder of any width, over the range",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kCalibrated,
          .source = kCylinderFit});
  v.Real("pixels", pixels,
         {.doc = "deviation in pixels of width (equation 22 of Matthies 1995)",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kCalibrated,
          .source = kCylinderFit});
}

void CylinderLawParams::Visit(core::FieldVisitor& v) {
  v.Real("image_width_px", image_width_px,
         {.doc = "width of the lander's images",
          .min = 16.0,
          .max = 1e5,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 app. A: 512 x 480"});
  v.Angle("field_of_view_deg", field_of_view_rad,
          {.doc = "angle of view of that width",
           .min = 1.0,
           .max = 120.0,
           .origin = Origin::kPublished,
           .source = "Matthies 1995 app. A: 29.33 deg"});
  v.Real("nearest_m", nearest_m,
         {.doc = "horizontal distance below which the cylinder is not found",
          .min = 0.2,
          .max = 100.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 app. A.2: the nearest of the table of one-pixel limits"});
  v.Angle("mounting_deg", mounting_rad,
          {.doc = "heading of the cylinder's x axis on the rover: the corner of blue and pink "
                  "panels at theta 0 looks that way",
           .min = -180.0,
           .max = 180.0,
           .origin = Origin::kAssumed,
           .source = "the paper does not say which way the cylinder stood",
           .study_low = -180.0,
           .study_high = 180.0});
  v.Angle("sun_elevation_deg", sun_elevation_rad,
          {.doc = "elevation of the sun where the trial has none of its own (sensors.aids.sun off)",
           .min = 0.0,
           .max = 90.0,
           .origin = Origin::kAssumed,
           .source = "as sensors.sun.elevation_deg",
           .study_low = 10.0,
           .study_high = 60.0});
  v.Group("found", found, "chance that the cylinder is found");
  v.Group("wrong", wrong, "chance that what was found is wrong, unknown to the lander");
  v.Group("heading", heading, "deviation of the heading");
  v.Group("range", range, "deviation of the range, over the range");
  v.Group("bearing", bearing, "deviation of the bearing");
  v.Angle("heading_bias_deg", heading_bias_rad,
          {.doc = "mean error of the heading",
           .min = -90.0,
           .max = 90.0,
           .origin = Origin::kCalibrated,
           .source = kCylinderFit});
  v.Real("range_bias", range_bias,
         {.doc = "mean error of the range, over the range",
          .min = -0.9,
          .max = 1.0,
          .origin = Origin::kCalibrated,
          .source = kCylinderFit});
  v.Angle("wrong_turn_deg", wrong_turn_rad,
          {.doc = "a wrong heading is off by anything up to this, either way",
           .min = 0.0,
           .max = 180.0,
           .origin = Origin::kCalibrated,
           .source = kCylinderFit});
  v.Real("wrong_range", wrong_range,
         {.doc = "deviation of the logarithm of a wrong range over the true one",
          .min = 0.0,
          .max = 3.0,
          .origin = Origin::kCalibrated,
          .source = kCylinderFit});
}

}  // namespace rockyard::sensing
