#include "sensing/aid_params.h"

#include <string_view>

namespace rockyard::sensing {
namespace {

using core::Assumed;
using core::Calibrated;
using core::Published;
using core::Setting;

constexpr const char* kCylinderFit =
    "fitted to rendered views (fit_lander_fix.py; 2,000 of scenarios/cylinder/views.json, "
    "seed 1)";

}  // namespace

void CylinderChanceParams::Visit(core::FieldVisitor& v) {
  const auto field = [&](std::string_view name, double& value, std::string_view doc) {
    v.Real(name, value, Calibrated(doc, kCylinderFit, {-1000.0, 1000.0}));
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
          Calibrated("deviation of a cylinder of any width", kCylinderFit, {0.0, 180.0}));
  v.Real("pixels", pixels,
         Calibrated("deviation in pixels, each worth what equations 18 to 23 of Matthies 1995 say",
                    kCylinderFit, {0.0, 100.0}));
}

void CylinderRangeDeviationParams::Visit(core::FieldVisitor& v) {
  v.Real(
      "least", least,
      Calibrated("deviation of a cylinder of any width, over the range", kCylinderFit, {0.0, 1.0}));
  v.Real("pixels", pixels,
         Calibrated("deviation in pixels of width (equation 22 of Matthies 1995)", kCylinderFit,
                    {0.0, 100.0}));
}

void CylinderLawParams::Visit(core::FieldVisitor& v) {
  v.Real("image_width_px", image_width_px,
         Published("width of the lander's images", "Matthies 1995 app. A: 512 x 480", {16.0, 1e5}));
  v.Angle(
      "field_of_view_deg", field_of_view_rad,
      Published("angle of view of that width", "Matthies 1995 app. A: 29.33 deg", {1.0, 120.0}));
  v.Real("nearest_m", nearest_m,
         Published("horizontal distance below which the cylinder is not found",
                   "Matthies 1995 app. A.2: the nearest of the table of one-pixel limits",
                   {0.2, 100.0}));
  v.Angle("mounting_deg", mounting_rad,
          Assumed("heading of the cylinder's x axis on the rover: the corner of blue and pink "
                  "panels at theta 0 looks that way",
                  "the paper does not say which way the cylinder stood", {-180.0, 180.0},
                  {-180.0, 180.0}));
  v.Angle("sun_elevation_deg", sun_elevation_rad,
          Assumed("elevation of the sun where the trial has none of its own (sensors.aids.sun off)",
                  "as sensors.sun.elevation_deg", {0.0, 90.0}, {10.0, 60.0}));
  v.Group("found", found, "chance that the cylinder is found");
  v.Group("wrong", wrong, "chance that what was found is wrong, unknown to the lander");
  v.Group("heading", heading, "deviation of the heading");
  v.Group("range", range, "deviation of the range, over the range");
  v.Group("bearing", bearing, "deviation of the bearing");
  v.Angle("heading_bias_deg", heading_bias_rad,
          Calibrated("mean error of the heading", kCylinderFit, {-90.0, 90.0}));
  v.Real("range_bias", range_bias,
         Calibrated("mean error of the range, over the range", kCylinderFit, {-0.9, 1.0}));
  v.Angle("wrong_turn_deg", wrong_turn_rad,
          Calibrated("a wrong heading is off by anything up to this, either way", kCylinderFit,
                     {0.0, 180.0}));
  v.Real("wrong_range", wrong_range,
         Calibrated("deviation of the logarithm of a wrong range over the true one", kCylinderFit,
                    {0.0, 3.0}));
}

void AidScheduleParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled, Setting("the aid is there"));
  v.Real("every_m", every_m,
         Setting("way by the rover's odometer from one measurement to the next; 0: not by way",
                 {0.0, 1e4}));
  v.Real("every_s", every_s,
         Setting("simulated time from one measurement to the next; 0: not by time. 14400: once a "
                 "day of the four hours that a rover operates (Matthies 1995 sec. 2.1.2)",
                 {0.0, 1e7}));
  v.Real(
      "delay_s", delay_s,
      Setting("simulated time from the measurement to its use on board, in which the rover goes on",
              {0.0, 1e6}));
  v.Require("every_m", !enabled || every_m > 0.0 || every_s > 0.0,
            "is 0, as every_s is, so that the aid never measures",
            "set one of them, or turn the aid off");
}

void LanderFixParams::Visit(core::FieldVisitor& v) {
  schedule.Visit(v);
  v.Angle("heading_sd_deg", heading_sd_rad,
          Published("standard deviation of the rover's heading as seen by the lander",
                    "Matthies 1995 sec. 5: not better than +-5 deg, read as a standard deviation",
                    {0.0, 180.0}));
  v.Real(
      "range_sd_fraction", range_sd_fraction,
      Published(
          "standard deviation of its range from the lander, over the range",
          "Matthies 1995 sec. 5: not better than +-5 % of distance, read as a standard deviation",
          {0.0, 1.0}));
  v.Real("bearing_sd_rad", bearing_sd_rad,
         Published("standard deviation of its bearing from the lander",
                   "Matthies 1995 sec. 2.1.1: a pixel of 0.001 rad", {0.0, 1.0}));
  v.Real(
      "common_share", common_share,
      Assumed("share of these variances that all fixes of a trial have in common, of which the "
              "rover knows nothing",
              "figs. 9 and 10 show biases that go with the angle of view", {0.0, 1.0}, {0.0, 1.0}));
  v.Real(
      "range_m", range_m,
      Assumed(
          "horizontal distance up to which the lander recognizes the rover",
          "the rover's 48 cm are 12 pixels at 40 m; the cylinder of sec. 5 failed in part at 15 m",
          {0.1, 1e4}, {10.0, 100.0}));
  v.Real("mast_height_m", mast_height_m,
         Published("height of the lander's cameras above the ground", "Matthies 1995 sec. 2.1.1",
                   {0.1, 10.0}));
  v.Real("rover_height_m", rover_height_m,
         Published("height above the ground of what the lander has to see of the rover",
                   "Matthies 1995 sec. 2.1.2: the rover is 30 cm high", {0.0, 5.0}));
  v.Boolean("shares_pan_error", shares_pan_error,
            Assumed("the fix is wrong by the trial's pan error (course.designation) as designated "
                    "goals are: one mast serves both",
                    "Matthies 1995 sec. 2.1.1: this imaging system designates goals and updates "
                    "the rover's position"));
  v.Choice("law", law,
           Setting("constant: the deviations above; cylinder: chance, deviations and wrong fixes "
                   "as the coloured cylinder was found in rendered views, in place of them"));
  v.Group("cylinder", cylinder, "the law of the coloured cylinder");
}

void SunSensorParams::Visit(core::FieldVisitor& v) {
  schedule.Visit(v);
  v.Angle("half_field_of_view_deg", half_field_of_view_rad,
          Published("largest angle from the rover's vertical axis at which the sun is seen",
                    "Matthies 1995 sec. 8: a field of view of greater than 150 deg", {1.0, 90.0}));
  v.Angle("noise_sd_deg", noise_sd_rad,
          Assumed("standard deviation of either angle across the direction to a sun in the zenith; "
                  "light that is dimmed on a longer way through the dust makes it larger",
                  "the paper gives no accuracy; small sensors of wide view reach 0.1 to 1 deg",
                  {0.0, 45.0}, {0.1, 2.0}));
  v.Real(
      "optical_depth", optical_depth,
      Assumed("optical depth of the dust: the light of a sun at elevation e is exp(-depth / sin e)",
              "as sensors.sun.optical_depth; 0.5 is a clear season at Ares Vallis", {0.0, 10.0},
              {0.2, 1.5}));
  v.Real("dropout_probability", dropout_probability,
         Assumed("share of the sightings that fail though the sun is in view", "glare, dust, masts",
                 {0.0, 1.0}, {0.0, 0.2}));
  v.Angle(
      "tilt_sd_deg", tilt_sd_rad,
      Assumed("standard deviation of roll and pitch that the rover reckons with where it turns the "
              "sun's direction level; more where it has no accelerometers",
              "the filter's lag and bias of accelerometers among rocks", {0.0, 90.0}, {0.2, 5.0}));
  v.Angle("latitude_deg", latitude_rad,
          Published("latitude of the site, north positive",
                    "Mars Pathfinder at Ares Vallis, 19.3 deg N (Golombek et al. 1997)",
                    {-90.0, 90.0}));
  v.Angle("areocentric_longitude_deg", areocentric_longitude_rad,
          Published("season: areocentric longitude Ls of the sun, 90 at northern summer solstice",
                    "Ls 142.7 deg at the landing of Mars Pathfinder (Golombek et al. 1997)",
                    {0.0, 360.0}));
  v.Real("start_solar_time_h", start_solar_time_h,
         Assumed("true solar time at which the drive begins",
                 "Matthies 1995 sec. 2.1.2: four hours a day, centred around noon", {0.0, 24.0},
                 {8.0, 14.0}));
  v.Angle("north_heading_deg", north_heading_rad,
          Setting("heading of north in the world frame, whose x axis runs along the course",
                  {-180.0, 180.0}));
}

void RadioBeaconParams::Visit(core::FieldVisitor& v) {
  schedule.Visit(v);
  v.Real("range_sd_m", range_sd_m,
         Assumed("standard deviation of a measured range",
                 "the paper gives no accuracy; timing to 3 ns", {0.0, 1000.0}, {0.1, 5.0}));
  v.Angle("bearing_sd_deg", bearing_sd_rad,
          Assumed("standard deviation of a measured bearing",
                  "the paper gives no accuracy; phases of two antennas half a metre apart",
                  {0.0, 90.0}, {0.5, 10.0}));
  v.Real("range_m", range_m,
         Published("horizontal distance up to which the beacon is heard",
                   "Matthies 1995 sec. 2.1.2: a clear-field radial range of 500 m", {0.1, 1e5}));
}

void AidParams::Visit(core::FieldVisitor& v) {
  v.Group("lander_fix", lander_fix, "the lander finds the rover in its images");
  v.Group("sun", sun, "a sun sensor on the rover");
  v.Group("beacon", beacon, "a radio beacon on the lander");
}

}  // namespace rockyard::sensing
