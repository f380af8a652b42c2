#include "sensing/stereo_params.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/functions.h"

namespace rockyard::sensing {
namespace {

using core::Assumed;
using core::Published;
using core::Setting;

constexpr std::string_view kFido = "FIDO rover's Hazcam, WUSTL data sheet: 110 x 90 deg, 12 cm";
constexpr std::string_view kArray =
    "Matthies 1995 sec. 6: points 10 to 30 cm ahead of the front, 13 cm beyond the sides; rover of "
    "0.65 x 0.48 m";
constexpr double kMostDisparity_px = 400.0;
constexpr double kGrazing_rad = math::DegToRad(1.0);

// Returns the angle below the horizon of the lowest ray in the middle of the image, rad; at most
// straight down.
double LowestDepression(const StereoMountParams& mount, double vertical_fov_rad) {
  return std::min(mount.pitch_rad + 0.5 * vertical_fov_rad, 0.5 * std::numbers::pi);
}

bool SeesGround(const StereoMountParams& mount, const StereoParams& p) {
  const double depression = LowestDepression(mount, p.vertical_fov_rad);
  return depression > kGrazing_rad && mount.height_m <= p.max_range_m * math::Sin(depression);
}

// Returns whether the middle of the window, on flat ground, is in the image and in range.
bool SeesWindow(const StereoMountParams& mount, const StereoParams& p) {
  const double ahead_m = 0.5 * (p.stripe_window.near_m + p.stripe_window.far_m) - mount.ahead_m;
  const double off_axis = math::Atan2(mount.height_m, ahead_m) - mount.pitch_rad;
  return std::abs(off_axis) <= 0.5 * p.vertical_fov_rad &&
         math::Hypot(ahead_m, mount.height_m) <= p.max_range_m;
}

void VisitImage(StereoParams& p, core::FieldVisitor& v) {
  v.Integer("columns", p.columns,
            Published("range points in an image row",
                      "Goldberg 2002 table 2: 512 x 512 down to 128 x 128", {8, 512}));
  v.Integer("rows", p.rows,
            Published("range points in an image column",
                      "Goldberg 2002 table 2: 512 x 512 down to 128 x 128", {8, 512}));
  v.Angle("horizontal_fov_deg", p.horizontal_fov_rad,
          Assumed("field of view from the left to the right edge of the rectified image", kFido,
                  {1.0, 150.0}, {60.0, 124.0}));
  v.Angle("vertical_fov_deg", p.vertical_fov_rad,
          Assumed("field of view from its upper to its lower edge", kFido, {1.0, 150.0},
                  {45.0, 124.0}));
  v.Real("baseline_m", p.baseline_m,
         Assumed("distance between the two cameras of a pair", kFido, {1e-3, 2.0}, {0.08, 0.2}));
}

// Bounds the size of rendered images: each eye keeps 50 bytes a pixel.
void VisitImageSize(StereoParams& p, core::FieldVisitor& v) {
  constexpr std::int64_t kMostPixels = 2048;
  const bool images = p.fidelity == StereoFidelity::kImage;
  v.Require("images.pyramid_level",
            !images || std::max(p.image_columns(), p.image_rows()) <= kMostPixels,
            "makes images of more than 2048 pixels a side",
            "use a lower level, or fewer columns and rows");
  // perception/stereo_points.cc searches one disparity more on either side; the correlator takes at
  // most 512.
  v.Require("max_disparity_px", !images || p.max_disparity_px <= kMostDisparity_px,
            "is above 400, where fidelity is image",
            "search fewer disparities, at a higher images.pyramid_level");
}

void VisitMatching(StereoParams& p, core::FieldVisitor& v) {
  v.Real("disparity_noise_px", p.disparity_noise_px,
         Assumed("standard deviation of a matched disparity",
                 "FLIR stereo accuracy note: 0.18 px with a 7 px window, the size in Goldberg 2002 "
                 "sec. 2; Xiong and Matthies 1997: errors exceed 0.3 px",
                 {0.0, 5.0}, {0.05, 0.35}));
  v.Integer("noise_window_px", p.noise_window_px,
            Assumed("side of the square of pixels over which errors are alike: each is the mean of "
                    "independent numbers over such a window, of the same deviation; 1: independent",
                    "Goldberg 2002 sec. 2 matches 7 x 7 windows, whose errors are alike as far as "
                    "they overlap; the simplest choice",
                    {1, 31}, {1, 7}));
  v.Real("disparity_step_px", p.disparity_step_px,
         Assumed("disparities are rounded to a multiple of this; 0: not rounded",
                 "Goldberg 2002 sec. 2: fitted to subpixel precision, resolution not given",
                 {0.0, 4.0}, {0.0, 0.25}));
  v.Real("min_disparity_px", p.min_disparity_px,
         Assumed("smallest disparity that the matching searches: limits depth",
                 "no match with the horizon", {1e-3, 1000.0}, {0.1, 2.0}));
  v.Real("max_disparity_px", p.max_disparity_px,
         Assumed("largest disparity that the matching searches: the near blind zone",
                 "Goldberg 2002 sec. 3: 32 disparities in images 256 wide; half of it at 128",
                 {2e-3, 1000.0}, {8.0, 32.0}));
  v.Require("max_disparity_px", p.max_disparity_px > p.min_disparity_px,
            "is not larger than min_disparity_px", "use a larger value");
  v.Require("max_disparity_px",
            p.fidelity == StereoFidelity::kIdeal ||
                p.focal_columns_px() * p.baseline_m < p.max_disparity_px * p.max_range_m,
            "leaves everything within max_range_m in the near blind zone",
            "search larger disparities, or use a shorter baseline or a wider field of view");
}

void VisitDropouts(StereoParams& p, core::FieldVisitor& v) {
  v.Real("mismatch_probability", p.mismatch_probability,
         Assumed(
             "chance that a point is matched with anything in the searched range of disparities",
             "Goldberg 2002 sec. 2 removes small blobs of wrong matches; what is left is not given",
             {0.0, 0.999}, {0.0, 0.02}));
  v.Real("dropout_probability", p.dropout_probability,
         Assumed("chance that a point finds no match that holds from left to right and back",
                 "Goldberg 2002 sec. 2 names the check without a rate", {0.0, 0.999}, {0.0, 0.4}));
  v.Real("edge_dropout_probability", p.edge_dropout_probability,
         Assumed("the same beside a jump in depth, where a matching window holds two surfaces",
                 "half of such a window belongs to either surface", {0.0, 0.999}, {0.0, 0.9}));
  v.Integer("edge_reach_px", p.edge_reach_px,
            Published("columns on both sides of the jump where that holds; 0: nowhere",
                      "Goldberg 2002 sec. 2: half of a 7 x 7 window", {0, 100}));
  v.Real("edge_disparity_px", p.edge_disparity_px,
         Assumed("difference in disparity between columns from which depth jumps",
                 "more than sloping ground has", {0.01, 100.0}, {0.5, 2.0}));
  v.Real("edge_mismatch_probability", p.edge_mismatch_probability,
         Assumed("chance that a point beside a jump in depth, within edge_reach_px, is matched as "
                 "if it were of the surface on the other side",
                 "the simplest choice: edges are sharp; fit_stereo_errors.py counts it in images",
                 {0.0, 0.999}, {0.0, 0.9}));
  v.Real("shadow_dropout_probability", p.shadow_dropout_probability,
         Assumed(
             "chance that a point outside of the sun drops out for that, whatever else may drop "
             "it; above 0 each point costs a ray",
             "the simplest choice: light does not matter; fit_stereo_errors.py counts it in images",
             {0.0, 0.999}, {0.0, 0.9}));
  v.Integer(
      "margin_px", p.margin_px,
      Assumed(
          "rows and columns at the edges of both images without matches",
          "the simplest choice; a 7 x 7 window (Goldberg 2002 sec. 2) reaches 3 beyond its pixel",
          {0, 100}, {0, 4}));
}

}  // namespace

double StereoParams::focal_columns_px() const {
  return 0.5 * static_cast<double>(columns) / math::Tan(0.5 * horizontal_fov_rad);
}

double StereoParams::focal_rows_px() const {
  return 0.5 * static_cast<double>(rows) / math::Tan(0.5 * vertical_fov_rad);
}

void StereoImageParams::Visit(core::FieldVisitor& v) {
  v.Integer("pyramid_level", pyramid_level,
            Published("images have 2^level times columns and rows, and are reduced to them on "
                      "board; disparities are those of the reduced images",
                      "Goldberg 2002 table 2: 512 x 512 reduced to 128 x 128", {0, 4}));
  v.Group("drift", drift,
          "how far the cameras of a pair have drifted apart since they were calibrated, which the "
          "rover does not know; drawn once a trial for either pair");
  v.Group("camera", camera, "lens, filter, imager, exposure, faults");
}

void StereoMountParams::Visit(core::FieldVisitor& v) {
  v.Real("ahead_m", ahead_m,
         Assumed("distance of the cameras from the chassis centre in the direction they look",
                 "front of a body of 0.8 m between wheels 1.04 m long", {-5.0, 5.0}, {0.3, 0.52}));
  v.Real("height_m", height_m,
         Assumed("height of the cameras above R's origin",
                 "below the deck of FIDO, 0.53 m high; MER: 0.52 m (Maki et al. 2003)",
                 {0.01, 10.0}, {0.3, 0.55}));
  v.Angle("pitch_deg", pitch_rad,
          Assumed("optical axes below the horizontal", "MER: 45 deg (Maki et al. 2003)",
                  {-90.0, 90.0}, {25.0, 50.0}));
}

void StripeWindowParams::Visit(core::FieldVisitor& v) {
  const auto length = [&v](std::string_view name, double& value, std::string_view doc) {
    v.Real(name, value, Published(doc, kArray, {0.0, 20.0}));
  };
  length("near_m", near_m, "nearest row of points from the chassis centre");
  length("far_m", far_m, "farthest row of points from the chassis centre");
  v.Require("far_m", far_m > near_m, "is not larger than near_m", "use a larger value");
  length("half_width_m", half_width_m, "outermost points from the middle line");
  v.Require("half_width_m", half_width_m > 0.0, "leaves no ground", "use a positive value");
}

void StereoParams::Visit(core::FieldVisitor& v) {
  v.Choice("fidelity", fidelity,
           Setting("ideal: exact range points; error_model: those of a camera pair; image: the "
                   "pair's images are rendered and matched on board (perception.stereo)"));
  v.Choice("field_of_view", field_of_view,
           Setting("full, or stripe: only points over stripe_window, for telling a navigator from "
                   "its sensor"));
  VisitImage(*this, v);
  v.Group("front", front, "the pair that looks ahead");
  v.Group("rear", rear, "the pair that looks behind");
  v.Real("max_range_m", max_range_m,
         Assumed("distance from the cameras up to which surfaces give points",
                 "grid-dist-timeout of 3 m (Goldberg 2002 table 1) and half a rover more",
                 {0.05, 20.0}, {3.0, 8.0}));
  VisitMatching(*this, v);
  VisitDropouts(*this, v);
  v.Group("stripe_window", stripe_window, "ground under the light stripe array");
  v.Group("images", images, "the images of the pairs, where fidelity is image");
  VisitImageSize(*this, v);
  constexpr std::string_view kNoGround = "shows no level ground within max_range_m";
  constexpr std::string_view kLower =
      "look further down, mount the cameras lower, or widen the "
      "field of view";
  v.Require("front", SeesGround(front, *this), kNoGround, kLower);
  v.Require("rear", SeesGround(rear, *this), kNoGround, kLower);
  const bool windowed = field_of_view == StereoFieldOfView::kStripe;
  v.Require("stripe_window", !windowed || (SeesWindow(front, *this) && SeesWindow(rear, *this)),
            "has its middle outside the images", "move the window or the cameras");
}

}  // namespace rockyard::sensing
