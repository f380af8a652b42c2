#include "vision/odometry/odometer_params.h"

namespace rockyard::vision {

using core::Origin;

void DisparityMapParams::Visit(core::FieldVisitor& v) {
  v.Group("dog", dog, "difference of Gaussians");
  v.Integer("window_side_px", window_side_px,
            {.doc = "side of the window that is compared, about its pixel; odd",
             .min = 1,
             .max = 21,
             .origin = Origin::kPublished,
             .source = "Goldberg 2002 sec. 2 stage 4: 7 x 7"});
  v.Group("filters", filters, "sub-pixel interpolation and the checks that drop pixels");
  v.Real("noise_px", noise_px,
         {.doc = "standard deviation of a disparity of the map",
          .min = 1e-3,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "rendered rocks and soil at level 0: root mean square of 0.14 to 0.17 px from "
                    "1.5 to 4.5 m (results/studies/pyramid_error.csv)",
          .study_low = 0.05,
          .study_high = 0.3});
  v.Real("max_step_px", max_step_px,
         {.doc = "largest difference between neighbours of the map of which one disparity is "
                 "interpolated: a feature on an edge of depth has no place",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "as the blob filter's blob_max_step_px; ground that is seen flat has up to a "
                    "third of a pixel",
          .study_low = 0.25,
          .study_high = 2.0});
  v.Require("window_side_px", window_side_px % 2 == 1, "must be odd",
            "a window of even side lies half a pixel beside its pixel; use 5, 7 or 9");
  CorrelatorParams correlator;
  correlator.window_side_px = window_side_px;
  v.Require("window_side_px", ScoresFit(dog, correlator),
            "squared, times twice dog.limit, is 2^14 or more, so that scores do not fit 16 bits",
            "use a smaller window or a lower limit");
}

void PlacementParams::Visit(core::FieldVisitor& v) {
  v.Choice("source", source,
           {.doc = "what says how far a feature is: right_eye, the feature found in the right "
                   "image; disparity_map, dense stereo of both images at the feature",
            .origin = Origin::kSetting});
  v.Real("min_disparity_px", min_disparity_px,
         {.doc = "smallest disparity that the right eye is searched for: farther features have no "
                 "place",
          .min = 0.0,
          .max = 4096.0,
          .origin = Origin::kAssumed,
          .source = "a feature at one pixel has a range that is wrong by a tenth of it",
          .study_low = 0.5,
          .study_high = 4.0});
  v.Real("max_disparity_px", max_disparity_px,
         {.doc = "largest disparity", .min = 4.0, .max = 4096.0, .origin = Origin::kSetting});
  v.Require("max_disparity_px", max_disparity_px >= min_disparity_px + 4.0,
            "is less than 4 px above min_disparity_px", "search more disparities");
  v.Integer("window_px", window_px,
            {.doc = "side of the windows, odd, that are found between pixels, in time and in the "
                    "right eye; whole disparities are those of 15 x 15 pixels",
             .min = 5,
             .max = 15,
             .origin = Origin::kAssumed,
             .source = "that of matching (Howard 2012 section 2); 9 shows two surfaces less often "
                       "(results/visual_odometry.md)",
             .study_low = 7,
             .study_high = 15});
  v.Require("window_px", window_px % 2 == 1, "must be odd", "use 9 or 15");
  v.Real("noise_px", noise_px,
         {.doc = "standard deviation of a feature's place, and of its disparity, beyond what the "
                 "noise of pixels makes of it: interpolation, another view of a surface",
          .min = 1e-3,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source =
              "a fortieth of a pixel: windows whose view is predicted add little to the noise of "
              "pixels (results/visual_odometry.md)",
          .study_low = 0.005,
          .study_high = 0.1});
  v.Boolean(
      "slanted", slanted,
      {.doc =
           "whether windows show small planes, whose slopes are found with their disparities and "
           "turned with the motion, or surfaces that face the cameras",
       .origin = Origin::kAssumed,
       .source = "level ground that is taken to face the cameras makes a step of 75 cm nod by 0.3 "
                 "mrad (results/visual_odometry.md)"});
  v.Real(
      "slope_sd", slope_sd,
      {.doc = "by how much disparities of small planes grow with column and row, standard "
              "deviation before images say more, px/px",
       .min = 0.01,
       .max = 10.0,
       .origin = Origin::kAssumed,
       .source = "level ground under hazard cameras has 0.25; 0.1 and 1 changed no error on three "
                 "sequences (results/visual_odometry.md)",
       .study_low = 0.1,
       .study_high = 1.0});
  v.Real("max_slope", max_slope,
         {.doc = "largest such slope",
          .min = 0.0,
          .max = 0.75,
          .origin = Origin::kAssumed,
          .source = "steeper surfaces are seen from their edge",
          .study_low = 0.3,
          .study_high = 0.75});
  v.Real(
      "max_residual_ratio", max_residual_ratio,
      {.doc = "windows whose residual, in time or between the eyes, is more than so many times the "
              "lower quartile of all of the pair are left out: they show two surfaces, such as a "
              "rock's edge and what lies behind it, which move differently",
       .min = 1.0,
       .max = 1e6,
       .origin = Origin::kAssumed,
       .source = "on ground without rocks noise alone stays below it; of 1.5 to 2.5 the one with "
                 "which all pairs of KITTI's excerpt have a motion and rendered rocks bias least",
       .study_low = 1.2,
       .study_high = 4.0});
  v.Integer("min_kept", min_kept,
            {.doc = "but so many points are left, those of the least residuals",
             .min = 0,
             .max = 100000,
             .origin = Origin::kAssumed,
             .source = "a motion of few points is worse than one of doubtful points",
             .study_low = 20,
             .study_high = 200});
  v.Real("ambiguity", ambiguity,
         {.doc = "share of another disparity's difference up to which the best one is believed",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "repeated texture; the consistent set follows anyway",
          .study_low = 0.7,
          .study_high = 1.0});
  v.Group("map", map, "the disparity map, where places are taken from it");
  constexpr double kMapReach_px = 479.0;  // CorrelatorParams, less one for the peak filter
  v.Require("max_disparity_px",
            source != PlaceSource::kDisparityMap || max_disparity_px <= kMapReach_px,
            "is above 479 px, which dense stereo does not reach",
            "search fewer disparities, or take places from the right eye");
}

void SelectionParams::Visit(core::FieldVisitor& v) {
  v.Choice("method", method,
           {.doc = "how the largest consistent set is found: ransac, motions of three points; "
                   "rigidity, distances between points that did not change",
            .origin = Origin::kAssumed,
            .source = "Howard 2012 sec. 2: RANSAC or other filtering techniques"});
  v.Real("inlier_px", inlier_px,
         {.doc = "ransac: how far from where a motion puts it either eye may see a point",
          .min = 0.01,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "some ten times the noise of a place, for motions of three points only",
          .study_low = 0.7,
          .study_high = 3.0});
  v.Real("miss_probability", miss_probability,
         {.doc = "ransac: chance that no draw was of members of the set alone, at which draws end",
          .min = 1e-12,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = "less often than anything else fails",
          .study_low = 1e-6,
          .study_high = 1e-2});
  v.Integer("max_draws", max_draws,
            {.doc = "ransac: most draws; the chance holds for sets of a share of the points w with "
                    "log(miss_probability) / log(1 - w^3) up to this (21 % for 1000 and 1e-4)",
             .min = 1,
             .max = 1000000,
             .origin = Origin::kAssumed,
             .source = "sets of fewer than 30 % are no motion anyway (min_share)",
             .study_low = 100,
             .study_high = 10000});
  v.Real("rigidity_sigma", rigidity_sigma,
         {.doc = "rigidity: standard deviations by which a distance may seem to have changed",
          .min = 0.1,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "one good pair of points in 370 is lost",
          .study_low = 2.0,
          .study_high = 5.0});
  v.Integer("min_consistent", min_consistent,
            {.doc = "fewer points that moved as one are no motion",
             .min = 3,
             .max = 100000,
             .origin = Origin::kAssumed,
             .source = "four times the three that define a motion, so that chance does not agree",
             .study_low = 6,
             .study_high = 30});
  v.Real("min_share", min_share,
         {.doc = "nor is a smaller share of the points that have a place at both moments",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "where most of what is seen moved otherwise, nobody knows which of them stood",
          .study_low = 0.2,
          .study_high = 0.6});
}

void EstimationParams::Visit(core::FieldVisitor& v) {
  v.Choice("weights", weights,
           {.doc = "weights of points that are off",
            .origin = Origin::kAssumed,
            .source = "the consistent set leaves mismatches of a pixel in"});
  v.Real("robust_sigma", robust_sigma,
         {.doc = "where they begin to matter less, in standard deviations of their residual",
          .min = 0.1,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "normal noise loses hardly any weight",
          .study_low = 1.0,
          .study_high = 3.0});
  v.Integer("max_iterations", max_iterations,
            {.doc = "most steps of least squares",
             .min = 1,
             .max = 1000,
             .origin = Origin::kAssumed,
             .source = "some five are needed",
             .study_low = 10,
             .study_high = 100});
  v.Real("tolerance", tolerance,
         {.doc = "it ends where a step is smaller than so many standard deviations",
          .min = 1e-9,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "a hundredth does not show",
          .study_low = 1e-4,
          .study_high = 0.1});
  v.Real("max_fit", max_fit,
         {.doc = "chi-squared over degrees of freedom up to which there is a motion",
          .min = 0.0,
          .max = 1e6,
          .origin = Origin::kAssumed,
          .source = "noise of more than three times what places state is no noise",
          .study_low = 3.0,
          .study_high = 20.0});
  v.Real("max_position_sd_m", max_position_sd_m,
         {.doc = "standard deviation of the way, in its worst direction, up to which there is a "
                 "motion",
          .min = 0.0,
          .max = 1e6,
          .origin = Origin::kAssumed,
          .source = "wheels are as good over a step of 75 cm",
          .study_low = 0.01,
          .study_high = 0.3});
  v.Angle("max_rotation_sd_deg", max_rotation_sd_rad,
          {.doc = "standard deviation of the turn, likewise",
           .min = 0.0,
           .max = 360.0,
           .origin = Origin::kAssumed,
           .source = "a gyro is as good over a turn of 18 deg",
           .study_low = 0.3,
           .study_high = 5.0});
}

void KeyframeParams::Visit(core::FieldVisitor& v) {
  v.Real("max_way_m", max_way_m,
         {.doc = "a pair that is so far from the keyframe takes its place; 0: each one does",
          .min = 0.0,
          .max = 1e6,
          .origin = Origin::kAssumed,
          .source = "views of near ground change by a third over 50 cm",
          .study_low = 0.1,
          .study_high = 1.0});
  v.Angle("max_turn_deg", max_turn_rad,
          {.doc = "as does one that has turned so far",
           .min = 0.0,
           .max = 180.0,
           .origin = Origin::kAssumed,
           .source = "a fifth of a view of 45 deg is lost",
           .study_low = 5.0,
           .study_high = 20.0});
  v.Real("min_share", min_share,
         {.doc = "and one in which a smaller share of the keyframe's points moved as one",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "before there are too few",
          .study_low = 0.2,
          .study_high = 0.7});
  v.Integer("failures", failures,
            {.doc = "a pair without a motion takes the keyframe's place if it is the last of so "
                    "many in a row; those before are left out, and the next is compared with the "
                    "same keyframe",
             .min = 1,
             .max = 1000000,
             .origin = Origin::kSetting});
}

void OdometerParams::Visit(core::FieldVisitor& v) {
  v.Group("detector", detector, "corners of an image");
  v.Group("matcher", matcher, "which corners of two images are the same");
  v.Group("placement", placement, "where they lie, from the right eye");
  v.Group("selection", selection, "which of them moved as one rigid body");
  v.Group("estimation", estimation, "the motion of these, by least squares");
  v.Group("keyframe", keyframe,
          "when a pair of images takes the place of the one that later ones are compared with");
  v.Real(
      "variance_factor", variance_factor,
      {.doc = "what the covariance of a motion is multiplied by: errors of windows that show one "
              "surface from one other view are not independent",
       .min = 0.1,
       .max = 1000.0,
       .origin = Origin::kCalibrated,
       .source = "rendered steps of hazard cameras: makes the mean squared error in units of the "
                 "covariance 6 (results/visual_odometry.md)"});
  v.Integer("rounds", rounds,
            {.doc = "where no motion is predicted, or another one is found: how often features are "
                    "matched, from the second time on as the motion of the time before predicts",
             .min = 1,
             .max = 10,
             .origin = Origin::kSetting});
  v.Real(
      "round_way_m", round_way_m,
      {.doc = "but not where what was found lies so near to what was predicted: windows that were "
              "turned and scaled by either look alike",
       .min = 0.0,
       .max = 1e6,
       .origin = Origin::kAssumed,
       .source = "an error of a seventh of a step of 75 cm; 0.03 and 0.3 m change the end error of "
                 "three sequences by a seventh at most (results/visual_odometry.md)",
       .study_low = 0.03,
       .study_high = 0.3});
  v.Angle("round_turn_deg", round_turn_rad,
          {.doc = "nor by turn",
           .min = 0.0,
           .max = 180.0,
           .origin = Origin::kAssumed,
           .source = "windows of 15 pixels turn by less than half a pixel at their edge",
           .study_low = 1.0,
           .study_high = 6.0});
}

}  // namespace rockyard::vision
