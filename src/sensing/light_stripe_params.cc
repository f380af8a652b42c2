#include "sensing/light_stripe_params.h"

#include <algorithm>

#include "core/sources.h"
#include "sensing/stripe_layout_params.h"

namespace rockyard::sensing {

namespace {

using core::Assumed;
using core::kMatthiesTable3;
using core::Published;
using core::Setting;

void VisitBeam(LaserParams& p, core::FieldVisitor& v) {
  v.Real("beam_width_rad", p.beam_width_rad,
         Published("width of the beam across the light plane: between the 1/e2 points of a "
                   "Gaussian, or edge to edge",
                   kMatthiesTable3, {1e-5, 0.1}));
  v.Choice(
      "profile", p.profile,
      Assumed(
          "cross section of the beam",
          "the paper gives a width alone; a laser diode behind a collimator is nearly Gaussian"));
  v.Choice("fan", p.fan,
           Published("full: the light of an emitter spreads over its fan; three_scanlines: over "
                     "three scanlines around each measured point, from an emitter of its own",
                     "Matthies 1995 sec. 6: table 3's fan, and the first improvement listed"));
  v.Real("speckle_contrast", p.speckle_contrast,
         Assumed("standard deviation over mean of the laser light on one pixel",
                 "1/sqrt(M) of M speckles of width wavelength x f-number on a pixel (Goodman 2007 "
                 "ch. 2): 0.27 for one mode at f/4, less for a diode of several modes",
                 {0.0, 1.0}, {0.0, 0.27}));
}

}  // namespace

void LaserParams::Visit(core::FieldVisitor& v) {
  v.Real("input_power_w", input_power_w,
         Published("electrical power of one emitter", kMatthiesTable3, {1e-6, 100.0}));
  v.Real("optical_efficiency", optical_efficiency,
         Assumed("light that leaves the fan's optics over electrical power",
                 "laser diodes of 1994 reach 0.1 to 0.3; driver and line optics take their share",
                 {1e-6, 1.0}, {0.02, 0.25}));
  v.Real("wavelength_m", wavelength_m, Published("of the light", kMatthiesTable3, {3e-7, 1.1e-6}));
  VisitBeam(*this, v);
}

void StripeImagerParams::Visit(core::FieldVisitor& v) {
  VisitOptics(v);
  v.Integer("averaging_rows", averaging_rows,
            Published("image lines that are read around each scanline for averaging; odd",
                      "Matthies 1995 sec. 6: 5 x 5 averaging", {1, 63}));
  v.Require("averaging_rows", averaging_rows % 2 == 1, "is even: no line is the middle one",
            "use 5");
  v.Integer("margin_rows", margin_rows,
            Setting("further lines read above and below those", {0, 256}));
  VisitDetectors(v);
}

namespace {

using core::Assumed;
using core::kMatthiesSection6;
using core::kMatthiesTable3;
using core::Published;
using core::Setting;

constexpr std::string_view kFigure13 = "Matthies 1995 fig. 13 is lost; text of sec. 6";

void VisitOptics(LightStripeParams& p, core::FieldVisitor& v) {
  v.Integer("columns", p.columns, Published("image columns", kMatthiesTable3, {16, 16384}));
  v.Integer("rows", p.rows, Published("image rows", kMatthiesTable3, {16, 16384}));
  v.Real("active_width_m", p.active_width_m,
         Published("width of the imager's active area", kMatthiesTable3, {1e-4, 0.1}));
  v.Real("active_height_m", p.active_height_m,
         Published("height of the imager's active area", kMatthiesTable3, {1e-4, 0.1}));
  v.Real("focal_length_m", p.focal_length_m,
         Published("focal length of the f-theta lens: 4.8 mm on Rocky 3.2, 4 mm on MFEX",
                   kMatthiesTable3, {5e-4, 0.1}));
  v.Choice("lens", p.lens,
           Assumed("how directions map to the image: both equidistant models have the published "
                   "field of view; equidistant_rows reads rows as planes, equidistant is the "
                   "radially symmetric f-theta lens",
                   "Matthies 1995 table 3: 8.9 x 6.6 mm at 4 mm are 2.2 x 1.6 rad only for an "
                   "f-theta lens; rows as planes are what software straightens them to"));
  v.Integer("lasers_per_image", p.lasers_per_image,
            Published("lasers that are on in one image", kMatthiesSection6,
                      {1, static_cast<double>(messages::kMaxStripes)}));
  v.Real("fan_rad", p.fan_rad,
         Published("full opening of each light fan", kMatthiesTable3, {0.05, 3.0}));
}

void VisitCameras(LightStripeParams& p, core::FieldVisitor& v) {
  v.Real("camera_separation_m", p.camera_separation_m,
         Published("distance between the two cameras", kMatthiesTable3, {0.01, 1.0}));
  v.Real("camera_x_m", p.camera_x_m,
         Assumed("cameras ahead of the chassis centre", kFigure13, {-1.0, 2.0}, {0.22, 0.32}));
  v.Real("camera_height_m", p.camera_height_m,
         Assumed("cameras above the ground", kFigure13, {0.02, 2.0}, {0.20, 0.29}));
  v.Angle(
      "camera_pitch_deg", p.camera_pitch_rad,
      Assumed("optical axes below the rover's horizontal", kFigure13, {0.0, 90.0}, {20.0, 60.0}));
}

void VisitEmitters(LightStripeParams& p, core::FieldVisitor& v) {
  v.Real(
      "emitter_x_m", p.emitter_x_m,
      Assumed("light emitters ahead of the chassis centre", kFigure13, {-1.0, 2.0}, {0.22, 0.32}));
  v.Real("emitter_height_m", p.emitter_height_m,
         Assumed("light emitters above the ground", kFigure13, {0.02, 2.0}, {0.20, 0.29}));
  v.Real("inner_emitter_y_m", p.inner_emitter_y_m,
         Assumed("second and fourth emitter beside the centre line; baseline 5 cm to the camera of "
                 "their side",
                 "Matthies 1995 table 3: camera-to-emitter baselines 5 to 10 cm", {0.0, 1.0},
                 {0.11, 0.13}));
  v.Real("outer_emitter_y_m", p.outer_emitter_y_m,
         Assumed("first and fifth emitter beside the centre line; baseline 8 cm to the camera of "
                 "their side",
                 "Matthies 1995 table 3: camera-to-emitter baselines 5 to 10 cm", {0.0, 1.0},
                 {0.12, 0.16}));
}

void VisitArray(LightStripeParams& p, core::FieldVisitor& v) {
  v.Real("front_x_m", p.front_x_m,
         Published("front of the rover, from which row_ahead_m counts",
                   "Matthies 1995 sec. 2.1.2: 65 cm long", {0.0, 2.0}));
  v.Real("datum_z_m", p.datum_z_m,
         Assumed("height in the rover frame of the plane from which elevations count",
                 "the plane under the wheels", {-1.0, 1.0}, {-0.02, 0.02}));
  v.FixedReals("row_ahead_m", p.row_ahead_m,
               Assumed("where the four scanlines meet flat ground, ahead of the rover's front; "
                       "nearest first. The farthest is published, the others are assumed",
                       kFigure13, {-0.5, 5.0}));
  v.Require("row_ahead_m", IsLaidOut(p),
            "the rows do not rise from near to far, or cameras or emitters are not above the datum "
            "plane and behind the nearest row",
            "use rows 0.1, 0.1667, 0.2333, 0.3 and mount the sensor above and behind them");
  v.Real("inner_stripe_y_m", p.inner_stripe_y_m,
         Assumed("second and fourth stripe beside the centre line at the farthest row", kFigure13,
                 {0.0, 5.0}, {0.15, 0.22}));
  v.Real("outer_stripe_y_m", p.outer_stripe_y_m,
         Published("first and fifth stripe beside the centre line at the farthest row: 13 cm "
                   "beyond the side of a rover 48 cm wide",
                   kMatthiesSection6, {0.0, 5.0}));
}

void VisitDensity(LightStripeParams& p, core::FieldVisitor& v) {
  v.Integer("row_subdivision", p.row_subdivision,
            Published("1: the published four rows; 2: one more between any two, seven in all",
                      kMatthiesSection6, {1, 2}));
  v.Integer("stripe_subdivision", p.stripe_subdivision,
            Published("1: the published five stripes; 2: one more between any two, nine in all",
                      kMatthiesSection6, {1, 2}));
}

// Where stripes are looked for.
void VisitSearch(LightStripeParams& p, core::FieldVisitor& v) {
  v.Real("search_low_m", p.search_low_m,
         Assumed("lowest elevation whose column is searched for a stripe",
                 "deeper than any drop that the rover could enter", {-5.0, -0.01}, {-0.5, -0.15}));
  v.Real("search_high_m", p.search_high_m,
         Assumed("highest elevation whose column is searched for a stripe",
                 "just below cameras and emitters", {0.01, 5.0}, {0.13, 0.22}));
  v.Require("search_high_m",
            p.datum_z_m + p.search_high_m < std::min(p.emitter_height_m, p.camera_height_m),
            "reaches the height of the cameras or emitters, where a scanline holds no point",
            "use a value below camera_height_m and emitter_height_m, counted from datum_z_m");
  v.Real("max_range_m", p.max_range_m,
         Assumed("largest distance from the camera at which a stripe is bright enough (geometric "
                 "level); images show rocks that far",
                 "twice what flat ground needs", {0.05, 10.0}, {0.7, 2.0}));
}

void VisitErrors(LightStripeParams& p, core::FieldVisitor& v) {
  v.Real("wrong_place_probability", p.wrong_place_probability,
         Published("chance that a point is detected in the wrong place of its scanline (geometric "
                   "level only)",
                   kMatthiesSection6, {0.0, 1.0}));
  v.Choice("wrong_place", p.wrong_place,
           Assumed("where a point appears that is found in a wrong place (geometric level only)",
                   "a wrong peak is found where a peak is looked for"));
  v.Real("missed_probability", p.missed_probability,
         Assumed("chance that a visible point is not detected (geometric level only)",
                 kMatthiesSection6, {0.0, 1.0}, {0.0, 0.01}));
  v.Reals(
      "missed_at", p.missed_at,
      Setting(
          "the same for each point, row by row from the nearest, left to right, in place of "
          "missed_probability (geometric level only); empty: the same for all. Faint light misses "
          "the farthest and outermost points first: fit_stripe_errors.py fits them to images",
          {0.0, 1.0}));
  const messages::StripeArraySize size = ArraySize(p);
  v.Require("missed_at", p.missed_at.empty() || p.missed_at.size() == size.rows * size.stripes,
            "does not have one value for each point of the array",
            "give rows times stripes values, or none");
  v.Real("outlier_persistence", p.outlier_persistence,
         Assumed("chance that a point keeps from one scan to the next whether and where it is "
                 "misplaced; 0: scans are independent (geometric level only)",
                 "Matthies 1995 sec. 6: two scans make false alarms vanish, which takes "
                 "independence; figure 8 shows one that two scans must have agreed on",
                 {0.0, 0.99}, {0.0, 0.5}));
  v.Real("column_noise_px", p.column_noise_px,
         Assumed("standard deviation by which found columns are off, before rounding to pixels "
                 "(geometric level only)",
                 "Matthies 1995 sec. 6: detected to pixel resolution", {0.0, 100.0}, {0.0, 1.0}));
}

}  // namespace

void LightStripeParams::Visit(core::FieldVisitor& v) {
  v.Choice("fidelity", fidelity,
           Setting("geometric: rays, which pass through the rover, and an error model; image: from "
                   "light to pixels, where chassis and panel must hide no point on flat ground, "
                   "and the finder of stripes on board"));
  VisitOptics(*this, v);
  VisitCameras(*this, v);
  VisitEmitters(*this, v);
  VisitArray(*this, v);
  VisitDensity(*this, v);
  VisitSearch(*this, v);
  VisitErrors(*this, v);
  v.Group("laser", laser, "light emitters");
  v.Group("imager", imager, "lens, filter, imager and exposure control");
  RequireVisibility(*this, v);
}

}  // namespace rockyard::sensing
