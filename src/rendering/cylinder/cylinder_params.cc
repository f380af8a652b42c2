#include "rendering/cylinder/cylinder_params.h"

namespace rockyard::rendering {
namespace {

using core::Assumed;
using core::Published;
using core::Setting;

void VisitColour(core::FieldVisitor& v, std::string_view name, ColourValues& colour,
                 std::string_view doc, std::string_view source) {
  v.FixedReals(name, colour, Assumed(doc, source, {0.0, 1.0}, {0.0, 1.0}));
}

constexpr std::string_view kCardboard =
    "fluorescent cardboard (Matthies 1995 sec. 5), of which no spectrum is told; each channel may "
    "be "
    "off by some 0.1";

}  // namespace

void CylinderTargetParams::Visit(core::FieldVisitor& v) {
  v.Real("diameter_m", diameter_m,
         Published("of the cylinder", "Matthies 1995 sec. 5", {0.01, 2.0}));
  v.Real("height_m", height_m,
         Published("of the cylinder's wall", "Matthies 1995 sec. 5", {0.01, 2.0}));
  v.Real("middle_height_m", middle_height_m,
         Assumed("of the middle of its axis above the ground",
                 "on a turntable before the cameras; on a rover of 30 cm (sec. 2.1.2): 0.35",
                 {0.05, 3.0}, {0.3, 1.2}));
  v.Choice("third_colour", third_colour,
           Published("of the quadrant opposite to the blue one",
                     "Matthies 1995 sec. 5: orange; green as an improvement"));
  VisitColour(v, "blue", blue, "reflectance of quadrant A, centred 45 deg left of ahead",
              kCardboard);
  VisitColour(v, "pink", pink, "of quadrants B and D, centred 135 and 315 deg", kCardboard);
  VisitColour(v, "orange", orange, "of quadrant C, centred 225 deg", kCardboard);
  VisitColour(v, "green", green, "of quadrant C in place of orange", kCardboard);
  VisitColour(v, "top", top, "of the cylinder's flat top", "grey cardboard");
  v.Choice("stand", stand,
           Assumed("what carries it: a plate on a post, or a rover's deck with dark solar cells",
                   "Matthies 1995 sec. 5: a machinists' turntable"));
}

void ColourCameraParams::Visit(core::FieldVisitor& v) {
  constexpr std::string_view kSec5 = "Matthies 1995 sec. 5";
  v.Integer("columns", columns,
            Published("pixels of a line", "Matthies 1995 app. A: nominal 512 x 480", {32, 4096}));
  v.Integer("rows", rows, Published("lines", "Matthies 1995 app. A", {32, 4096}));
  v.Angle("field_of_view_deg", field_of_view_rad,
          Published("across the columns; pixels are square", kSec5, {1.0, 120.0}));
  v.Real("baseline_m", baseline_m, Published("between the cameras", kSec5, {0.01, 2.0}));
  v.Real("front_m", front_m,
         Published("from the centre of rotation, where distances count from, to the cameras' "
                   "fronts, which are their centres of projection here",
                   kSec5, {0.0, 1.0}));
  v.Real("height_m", height_m,
         Assumed("above the ground; on a lander's mast 1.5 (sec. 2.1.1)",
                 "as high as the cylinder, which lies on their axis (sec. 5)", {0.05, 10.0},
                 {0.3, 2.0}));
  v.Choice("pointing", pointing,
           Assumed("along the ground, or down to the cylinder's height at its distance",
                   "Matthies 1995 sec. 5: bore-sighted"));
  v.Real("crosstalk", crosstalk,
         Assumed("share of a channel's light that is taken from its neighbours in the spectrum: "
                 "red and blue from green, green from both by halves",
                 "a colour camera with one chip (Sony XC999); no response is told", {0.0, 0.5},
                 {0.0, 0.3}));
  v.Real("blur_px", blur_px,
         Assumed("standard deviation of the image's lack of sharpness",
                 "a lens that suits its pixels", {0.0, 0.7}, {0.3, 0.7}));
  v.Real(
      "colour_blur_px", colour_blur_px,
      Assumed("standard deviation along the line of what the differences of the channels lose more "
              "than their brightness",
              "one chip has each colour at every other pixel or fourth", {0.0, 3.0}, {0.0, 2.0}));
  v.Real("full_well_e", full_well_e,
         Assumed("electrons of the largest count, which give the shot noise", "a half-inch CCD",
                 {100.0, 1e7}, {10000.0, 60000.0}));
  v.Real("read_noise_counts", read_noise_counts,
         Assumed("standard deviation of the other noise of a channel, in counts of 8 bits; 0 with "
                 "a very large well: none",
                 "48 dB of signal to noise, usual for such cameras", {0.0, 50.0}, {0.5, 3.0}));
  v.Real("exposure_level", exposure_level,
         Assumed("count of the brightest channel of level, sunlit ground, over the largest count",
                 "bright cardboard is to stay below the largest count", {0.01, 1.0}, {0.2, 0.5}));
  v.Angle(
      "balance_elevation_deg", balance_elevation_rad,
      Assumed("elevation of the sun at which a level white card was grey in the image; channels "
              "keep that balance in any light",
              "a calibration target in the light of the experiment", {5.0, 90.0}, {20.0, 70.0}));
  v.Real("gamma", gamma,
         Assumed("power of the light that counts are in proportion to",
                 "switched off for measurements", {0.3, 1.0}, {0.45, 1.0}));
}

void CylinderLightParams::Visit(core::FieldVisitor& v) {
  v.Angle("elevation_deg", elevation_rad, Setting("of the sun above the horizon", {1.0, 90.0}));
  v.Angle(
      "azimuth_deg", azimuth_rad,
      Setting(
          "towards the sun, from the cameras' line of sight to the left: 180 is behind the cameras",
          {-360.0, 360.0}));
  v.Real("optical_depth", optical_depth,
         Published("of the dust towards the zenith",
                   "Smith et al. 1997 (Science 278, 1758): about 0.5 at the Pathfinder site",
                   {0.0, 10.0}));
  v.Real("diffuse_share", diffuse_share,
         Assumed("of what the dust takes from the beam, what comes from the whole sky",
                 "as sensors.sun.diffuse_share", {0.0, 1.0}, {0.5, 0.9}));
  VisitColour(v, "sun", sun, "colour of the direct light, its largest channel 1",
              "slightly reddened by dust");
  VisitColour(v, "sky", sky, "colour of the sky's light, its largest channel 1",
              "the butterscotch sky of dust that absorbs blue");
}

void BackdropParams::Visit(core::FieldVisitor& v) {
  VisitColour(v, "ground", ground, "reflectance of the ground",
              "red Martian soil, bright in red and dark in blue");
  v.Real("contrast", contrast,
         Assumed("standard deviation of the ground's brightness over its mean",
                 "between drift and gravel of sensors.look", {0.0, 0.5}, {0.05, 0.25}));
  v.Real("hue_contrast", hue_contrast,
         Assumed("standard deviation of what patches of half a metre are redder and less blue",
                 "drift and crust side by side", {0.0, 0.3}, {0.0, 0.1}));
  v.Angle("horizon_elevation_deg", horizon_elevation_rad,
          Assumed("of the hills' edge as seen from the ground; above it there is sky",
                  "Matthies 1995 app. A.3 wants no sky in view", {-1.0, 60.0}, {0.0, 20.0}));
  v.Real("horizon_distance_m", horizon_distance_m,
         Assumed("of the hills, a wall across the view", "far behind every cylinder",
                 {26.0, 1000.0}, {30.0, 300.0}));
  v.Real("horizon_relief_m", horizon_relief_m,
         Assumed("standard deviation of their height", "low hills", {0.0, 50.0}, {0.0, 3.0}));
}

void ClutterParams::Visit(core::FieldVisitor& v) {
  v.Real("rocks", rocks,
         Setting("mean number in the part of the ground that both cameras' columns cover",
                 {0.0, 200.0}));
  v.Real("hardware", hardware,
         Setting("mean number of things of bright colours, drawn at random", {0.0, 50.0}));
  v.Real("smallest_m", smallest_m,
         Assumed("smallest half width of rocks and hardware; logarithms are uniform",
                 "what is a few pixels large", {0.005, 1.0}, {0.02, 0.1}));
  v.Real("largest_m", largest_m,
         Assumed("largest half width of rocks", "rocks of a metre", {0.005, 2.0}, {0.2, 0.7}));
  VisitColour(v, "rock", rock, "reflectance of grey rocks",
              "dust-covered basalt, greyer than the soil");
  v.Real("rock_brightness_spread", rock_brightness_spread,
         Assumed("half width of the uniform spread of their brightness over its mean",
                 "dusty and bare rocks", {0.0, 0.9}, {0.0, 0.5}));
  v.Real("red_share", red_share,
         Assumed("share of the rocks that are of the redder kind",
                 "reddish rocks of the Pathfinder site", {0.0, 1.0}, {0.0, 0.5}));
  VisitColour(v, "red_rock", red_rock, "reflectance of the redder, pinkish kind",
              "beyond what is known of Mars, so that pink is not the cylinder's alone");
  v.Real("hardware_largest_m", hardware_largest_m,
         Assumed("largest half width of hardware",
                 "boxes, thermal blankets, flags on a lander's petals", {0.005, 1.0}, {0.05, 0.3}));
  v.Real("clear_m", clear_m,
         Assumed("from the cylinder's axis to the edge of any of them along the ground, at least; "
                 "they may hide it all the same",
                 "a rover keeps off", {0.0, 10.0}, {0.3, 1.0}));
  v.Real("nearest_m", nearest_m,
         Assumed("from the centre of rotation to the middle of any of them, at least",
                 "the lander's own petals lie nearer", {0.1, 10.0}, {1.0, 3.0}));
  v.Real("farthest_m", farthest_m,
         Assumed("the same, at most", "before the hills", {1.0, 100.0}, {20.0, 50.0}));
  v.Require("largest_m", largest_m >= smallest_m && hardware_largest_m >= smallest_m,
            "or hardware_largest_m is below smallest_m", "use at least smallest_m");
  v.Require("farthest_m", farthest_m > nearest_m, "is not above nearest_m", "use more");
}

void CylinderPictureParams::Visit(core::FieldVisitor& v) {
  v.Group("target", target, "the cylinder and what it stands on");
  v.Group("cameras", cameras, "the pair of colour cameras");
  v.Group("light", light, "sun and sky");
  v.Group("backdrop", backdrop, "ground, hills and horizon");
  v.Group("clutter", clutter, "rocks and hardware");
  v.Integer("edge_samples", edge_samples,
            Setting("rays along either side of a pixel that holds an edge", {1, 32}));
}

}  // namespace rockyard::rendering
