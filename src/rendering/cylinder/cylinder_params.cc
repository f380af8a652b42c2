#include "rendering/cylinder/cylinder_params.h"

namespace rockyard::rendering {
namespace {

using core::Origin;

void VisitColour(core::FieldVisitor& v, std::string_view name, ColourValues& colour,
                 std::string_view doc, std::string_view source) {
  v.FixedReals(name, colour,
               {.doc = doc,
                .min = 0.0,
                .max = 1.0,
                .origin = Origin::kAssumed,
                .source = source,
                .study_low = 0.0,
                .study_high = 1.0});
}

constexpr std::string_view kCardboard =
    "fluorescent cardboard (Matthies 1995 sec. 5), of which no spectrum is told; each channel may "
    "be "
    "off by some 0.1";

}  // namespace

void CylinderTargetParams::Visit(core::FieldVisitor& v) {
  v.Real("diameter_m", diameter_m,
         {.doc = "of the cylinder",
          .min = 0.01,
          .max = 2.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5"});
  v.Real("height_m", height_m,
         {.doc = "of the cylinder's wall",
          .min = 0.01,
          .max = 2.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5"});
  v.Real("middle_height_m", middle_height_m,
         {.doc = "of the middle of its axis above the ground",
          .min = 0.05,
          .max = 3.0,
          .origin = Origin::kAssumed,
          .source = "on a turntable before the cameras; on a rover of 30 cm (sec. 2.1.2): 0.35",
          .study_low = 0.3,
          .study_high = 1.2});
  v.Choice("third_colour", third_colour,
           {.doc = "of the quadrant opposite to the blue one",
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 5: orange; green as an improvement"});
  VisitColour(v, "blue", blue, "reflectance of quadrant A, centred 45 deg left of ahead",
              kCardboard);
  VisitColour(v, "pink", pink, "of quadrants B and D, centred 135 and 315 deg", kCardboard);
  VisitColour(v, "orange", orange, "of quadrant C, centred 225 deg", kCardboard);
  VisitColour(v, "green", green, "of quadrant C in place of orange", kCardboard);
  VisitColour(v, "top", top, "of the cylinder's flat top", "grey cardboard");
  v.Choice("stand", stand,
           {.doc = "what carries it: a plate on a post, or a rover's deck with dark solar cells",
            .origin = Origin::kAssumed,
            .source = "Matthies 1995 sec. 5: a machinists' turntable"});
}

void ColourCameraParams::Visit(core::FieldVisitor& v) {
  constexpr std::string_view kSec5 = "Matthies 1995 sec. 5";
  v.Integer("columns", columns,
            {.doc = "pixels of a line",
             .min = 32,
             .max = 4096,
             .origin = Origin::kPublished,
             .source = "Matthies 1995 app. A: nominal 512 x 480"});
  v.Integer("rows", rows,
            {.doc = "lines",
             .min = 32,
             .max = 4096,
             .origin = Origin::kPublished,
             .source = "Matthies 1995 app. A"});
  v.Angle("field_of_view_deg", field_of_view_rad,
          {.doc = "across the columns; pixels are square",
           .min = 1.0,
           .max = 120.0,
           .origin = Origin::kPublished,
           .source = kSec5});
  v.Real("baseline_m", baseline_m,
         {.doc = "between the cameras",
          .min = 0.01,
          .max = 2.0,
          .origin = Origin::kPublished,
          .source = kSec5});
  v.Real("front_m", front_m,
         {.doc = "from the centre of rotation, where distances count from, to the cameras' fronts, "
                 "which are their centres of projection here",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kPublished,
          .source = kSec5});
  v.Real("height_m", height_m,
         {.doc = "above the ground; on a lander's mast 1.5 (sec. 2.1.1)",
          .min = 0.05,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "as high as the cylinder, which lies on their axis (sec. 5)",
          .study_low = 0.3,
          .study_high = 2.0});
  v.Choice("pointing", pointing,
           {.doc = "along the ground, or down to the cylinder's height at its distance",
            .origin = Origin::kAssumed,
            .source = "Matthies 1995 sec. 5: bore-sighted"});
  v.Real("crosstalk", crosstalk,
         {.doc = "share of a channel's light that is taken from its neighbours in the spectrum: "
                 "red and blue from green, green from both by halves",
          .min = 0.0,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = "a colour camera with one chip (Sony XC999); no response is told",
          .study_low = 0.0,
          .study_high = 0.3});
  v.Real("blur_px", blur_px,
         {.doc = "standard deviation of the image's lack of sharpness",
          .min = 0.0,
          .max = 0.7,
          .origin = Origin::kAssumed,
          .source = "a lens that suits its pixels",
          .study_low = 0.3,
          .study_high = 0.7});
  v.Real("colour_blur_px", colour_blur_px,
         {.doc = "standard deviation along the line of what the differences of the channels lose "
                 "more than their brightness",
          .min = 0.0,
          .max = 3.0,
          .origin = Origin::kAssumed,
          .source = "one chip has each colour at every other pixel or fourth",
          .study_low = 0.0,
          .study_high = 2.0});
  v.Real("full_well_e", full_well_e,
         {.doc = "electrons of the largest count, which give the shot noise",
          .min = 100.0,
          .max = 1e7,
          .origin = Origin::kAssumed,
          .source = "a half-inch CCD",
          .study_low = 10000.0,
          .study_high = 60000.0});
  v.Real("read_noise_counts", read_noise_counts,
         {.doc = "standard deviation of the other noise of a channel, in counts of 8 bits; 0 with "
                 "a very large well: none",
          .min = 0.0,
          .max = 50.0,
          .origin = Origin::kAssumed,
          .source = "48 dB of signal to noise, usual for such cameras",
          .study_low = 0.5,
          .study_high = 3.0});
  v.Real("exposure_level", exposure_level,
         {.doc = "count of the brightest channel of level, sunlit ground, over the largest count",
          .min = 0.01,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "bright cardboard is to stay below the largest count",
          .study_low = 0.2,
          .study_high = 0.5});
  v.Angle(
      "balance_elevation_deg", balance_elevation_rad,
      {.doc = "elevation of the sun at which a level white card was grey in the image; channels "
              "keep that balance in any light",
       .min = 5.0,
       .max = 90.0,
       .origin = Origin::kAssumed,
       .source = "a calibration target in the light of the experiment",
       .study_low = 20.0,
       .study_high = 70.0});
  v.Real("gamma", gamma,
         {.doc = "power of the light that counts are in proportion to",
          .min = 0.3,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "switched off for measurements",
          .study_low = 0.45,
          .study_high = 1.0});
}

void CylinderLightParams::Visit(core::FieldVisitor& v) {
  v.Angle(
      "elevation_deg", elevation_rad,
      {.doc = "of the sun above the horizon", .min = 1.0, .max = 90.0, .origin = Origin::kSetting});
  v.Angle("azimuth_deg", azimuth_rad,
          {.doc = "towards the sun, from the cameras' line of sight to the left: 180 is behind the "
                  "cameras",
           .min = -360.0,
           .max = 360.0,
           .origin = Origin::kSetting});
  v.Real("optical_depth", optical_depth,
         {.doc = "of the dust towards the zenith",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Smith et al. 1997 (Science 278, 1758): about 0.5 at the Pathfinder site"});
  v.Real("diffuse_share", diffuse_share,
         {.doc = "of what the dust takes from the beam, what comes from the whole sky",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "as sensors.sun.diffuse_share",
          .study_low = 0.5,
          .study_high = 0.9});
  VisitColour(v, "sun", sun, "colour of the direct light, its largest channel 1",
              "slightly reddened by dust");
  VisitColour(v, "sky", sky, "colour of the sky's light, its largest channel 1",
              "the butterscotch sky of dust that absorbs blue");
}

void BackdropParams::Visit(core::FieldVisitor& v) {
  VisitColour(v, "ground", ground, "reflectance of the ground",
              "red Martian soil, bright in red and dark in blue");
  v.Real("contrast", contrast,
         {.doc = "standard deviation of the ground's brightness over its mean",
          .min = 0.0,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = "between drift and gravel of sensors.look",
          .study_low = 0.05,
          .study_high = 0.25});
  v.Real("hue_contrast", hue_contrast,
         {.doc = "standard deviation of what patches of half a metre are redder and less blue",
          .min = 0.0,
          .max = 0.3,
          .origin = Origin::kAssumed,
          .source = "drift and crust side by side",
          .study_low = 0.0,
          .study_high = 0.1});
  v.Angle("horizon_elevation_deg", horizon_elevation_rad,
          {.doc = "of the hills' edge as seen from the ground; above it there is sky",
           .min = -1.0,
           .max = 60.0,
           .origin = Origin::kAssumed,
           .source = "Matthies 1995 app. A.3 wants no sky in view",
           .study_low = 0.0,
           .study_high = 20.0});
  v.Real("horizon_distance_m", horizon_distance_m,
         {.doc = "of the hills, a wall across the view",
          .min = 26.0,
          .max = 1000.0,
          .origin = Origin::kAssumed,
          .source = "far behind every cylinder",
          .study_low = 30.0,
          .study_high = 300.0});
  v.Real("horizon_relief_m", horizon_relief_m,
         {.doc = "standard deviation of their height",
          .min = 0.0,
          .max = 50.0,
          .origin = Origin::kAssumed,
          .source = "low hills",
          .study_low = 0.0,
          .study_high = 3.0});
}

void ClutterParams::Visit(core::FieldVisitor& v) {
  v.Real("rocks", rocks,
         {.doc = "mean number in the part of the ground that both cameras' columns cover",
          .min = 0.0,
          .max = 200.0,
          .origin = Origin::kSetting});
  v.Real("hardware", hardware,
         {.doc = "mean number of things of bright colours, drawn at random",
          .min = 0.0,
          .max = 50.0,
          .origin = Origin::kSetting});
  v.Real("smallest_m", smallest_m,
         {.doc = "smallest half width of rocks and hardware; logarithms are uniform",
          .min = 0.005,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "what is a few pixels large",
          .study_low = 0.02,
          .study_high = 0.1});
  v.Real("largest_m", largest_m,
         {.doc = "largest half width of rocks",
          .min = 0.005,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "rocks of a metre",
          .study_low = 0.2,
          .study_high = 0.7});
  VisitColour(v, "rock", rock, "reflectance of grey rocks",
              "dust-covered basalt, greyer than the soil");
  v.Real("rock_brightness_spread", rock_brightness_spread,
         {.doc = "half width of the uniform spread of their brightness over its mean",
          .min = 0.0,
          .max = 0.9,
          .origin = Origin::kAssumed,
          .source = "dusty and bare rocks",
          .study_low = 0.0,
          .study_high = 0.5});
  v.Real("red_share", red_share,
         {.doc = "share of the rocks that are of the redder kind",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "reddish rocks of the Pathfinder site",
          .study_low = 0.0,
          .study_high = 0.5});
  VisitColour(v, "red_rock", red_rock, "reflectance of the redder, pinkish kind",
              "beyond what is known of Mars, so that pink is not the cylinder's alone");
  v.Real("hardware_largest_m", hardware_largest_m,
         {.doc = "largest half width of hardware",
          .min = 0.005,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "boxes, thermal blankets, flags on a lander's petals",
          .study_low = 0.05,
          .study_high = 0.3});
  v.Real("clear_m", clear_m,
         {.doc = "from the cylinder's axis to the edge of any of them along the ground, at least; "
                 "they may hide it all the same",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "a rover keeps off",
          .study_low = 0.3,
          .study_high = 1.0});
  v.Real("nearest_m", nearest_m,
         {.doc = "from the centre of rotation to the middle of any of them, at least",
          .min = 0.1,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "the lander's own petals lie nearer",
          .study_low = 1.0,
          .study_high = 3.0});
  v.Real("farthest_m", farthest_m,
         {.doc = "the same, at most",
          .min = 1.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "before the hills",
          .study_low = 20.0,
          .study_high = 50.0});
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
            {.doc = "rays along either side of a pixel that holds an edge",
             .min = 1,
             .max = 32,
             .origin = Origin::kSetting});
}

}  // namespace rockyard::rendering
