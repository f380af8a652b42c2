#include "perception/eyes_params.h"

#include "messages/stripe_array.h"

namespace rockyard::perception {

using core::Published;

void StereoMatchingParams::Visit(core::FieldVisitor& v) {
  v.Group("dog", dog, "difference of Gaussians");
  v.Integer("window_side_px", window_side_px,
            Published("side of the window that is compared; the pixel is at side / 2, rounded down",
                      "Goldberg 2002 sec. 2 stage 4: 7 x 7; sec. 3 times 8 x 8", {1, 21}));
  v.Group("filters", filters, "sub-pixel interpolation and the checks that drop pixels");
  vision::CorrelatorParams correlator;
  correlator.window_side_px = window_side_px;
  v.Require("window_side_px", vision::ScoresFit(dog, correlator),
            "squared, times twice dog.limit, is 2^14 or more, so that scores do not fit 16 bits",
            "use a smaller window or a lower limit");
}

namespace {

using core::Assumed;

void VisitGround(CloudElevationParams& p, core::FieldVisitor& v) {
  const auto length = [&v](std::string_view name, double& value, std::string_view doc,
                           std::string_view reason, double study_low, double study_high) {
    v.Real(name, value, Assumed(doc, reason, {0.0, 20.0}, {study_low, study_high}));
  };
  length("near_m", p.near_m, "nearest edge of the ground, from the chassis centre, as they look",
         "where the light stripe array begins on Rocky 3.2", 0.4, 0.8);
  length("far_m", p.far_m, "its farthest edge", "five times as long as the light stripe array", 0.8,
         2.5);
  v.Require("far_m", p.far_m > p.near_m, "is not larger than near_m", "use a larger value");
  length("half_width_m", p.half_width_m, "its edges left and right of the middle line",
         "a rover's width and as much again for clearance", 0.37, 1.2);
  v.Require("half_width_m", p.half_width_m > 0.0, "leaves no ground", "use a positive value");
}

}  // namespace

void CloudElevationParams::Visit(core::FieldVisitor& v) {
  v.Integer("rows", rows,
            Assumed("rows of bins, from near to far", "as many as the light stripe array has",
                    {2, static_cast<double>(messages::kMaxStripeRows)}, {4, 7}));
  v.Integer("stripes", stripes,
            Assumed("bins of a row, from left to right", "as many as the light stripe array has",
                    {3, static_cast<double>(messages::kMaxStripes)}, {5, 9}));
  VisitGround(*this, v);
  v.Real(
      "quantile", quantile,
      Assumed("share of a bin's points that lie no higher than its elevation; 1: the highest point",
              "the highest point: what noise adds is much the same in all bins, and less shows a "
              "rock that fills a tenth of one",
              {0.0, 1.0}, {0.5, 1.0}));
  v.Integer("min_points", min_points,
            Assumed("points from which a bin counts as seen", "one stray point is no ground",
                    {1, 100000}, {1, 10}));
  v.Choice(
      "frame", frame,
      Assumed("frame in which heights count",
              "over a metre, a pitch of 7 deg is as high as the clearance; so is a slope, from "
              "the level"));
  v.Real(
      "plane_outlier_m", plane_outlier_m,
      Assumed("frame plane: points that stand out from the plane by more are left out of it, one "
              "fit after the other",
              "half of the clearance: rocks that matter are not to tilt the ground", {0.001, 10.0},
              {0.05, 0.2}));
  v.Angle("max_plane_deg", max_plane_rad,
          Assumed("frame plane: slope of the plane from which on heights count from the level",
                  "ground that is too steep is to be a hazard: GESTALT's max_pitch_deg",
                  {0.0, 90.0}, {15.0, 30.0}));
}

using core::Assumed;
using core::Setting;

void SlipCheckParams::Visit(core::FieldVisitor& v) {
  v.Boolean(
      "enabled", enabled,
      Setting("the way of the wheels is compared with the way that visual odometry saw; beyond the "
              "limit an alarm is raised, and navigation.on_slip says what follows"));
  v.Real("limit", limit,
         Assumed("slip that is too much: 1 less the seen way over the rolled way",
                 "Howard 2012 has slip checking without a number; half of the way lost is more "
                 "than any slope that a rover is sent up",
                 {-1.0, 1.0}, {0.2, 0.8}));
  v.Real("sigma", sigma,
         Assumed("standard deviations of the measured slip by which the limit is to be exceeded",
                 "a stop without reason costs a day of operations", {0.0, 100.0}, {0.0, 4.0}));
  v.Real(
      "min_way_m", min_way_m,
      Assumed(
          "way of the wheels, from the keyframe to the newest images, from which on slip is told",
          "three steps of 6.7 cm (Matthies 1995 sec. 5)", {1e-3, 100.0}, {0.05, 0.75}));
}

void VisualMotionParams::Visit(core::FieldVisitor& v) {
  v.Angle("tilt_sd_deg", tilt_sd_rad,
          Assumed("standard deviation of roll and of pitch, as the rover believes them, where a "
                  "motion is told in the levelled frame",
                  "as localization.error_state.drift.tilt_sd_deg: vibration and the rover's own "
                  "accelerations",
                  {0.0, 90.0}, {0.1, 3.0}));
  v.Group("slip_check", slip_check, "whether the wheels slip more than the rover should stand");
  odometer.Visit(v);
}

}  // namespace rockyard::perception
