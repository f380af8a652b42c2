#include "vision/odometry/odometer_params.h"

namespace rockyard::vision {

using core::Assumed;
using core::Calibrated;
using core::Published;
using core::Setting;

void DisparityMapParams::Visit(core::FieldVisitor& v) {
  v.Group("dog", dog, "difference of Gaussians");
  v.Integer("window_side_px", window_side_px,
            Published("side of the window that is compared, about its pixel; odd",
                      "Goldberg 2002 sec. 2 stage 4: 7 x 7", {1, 21}));
  v.Group("filters", filters, "sub-pixel interpolation and the checks that drop pixels");
  v.Real("noise_px", noise_px,
         Assumed("standard deviation of a disparity of the map",
                 "rendered rocks and soil at level 0: root mean square of 0.14 to 0.17 px from 1.5 "
                 "to 4.5 m (results/studies/pyramid_error.csv)",
                 {1e-3, 10.0}, {0.05, 0.3}));
  v.Real("max_step_px", max_step_px,
         Assumed("largest difference between neighbours of the map of which one disparity is "
                 "interpolated: a feature on an edge of depth has no place",
                 "as the blob filter's blob_max_step_px; ground that is seen flat has up to a "
                 "third of a pixel",
                 {0.0, 100.0}, {0.25, 2.0}));
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
           Setting("what says how far a feature is: right_eye, the feature found in the right "
                   "image; disparity_map, dense stereo of both images at the feature"));
  v.Real(
      "min_disparity_px", min_disparity_px,
      Assumed(
          "smallest disparity that the right eye is searched for: farther features have no place",
          "a feature at one pixel has a range that is wrong by a tenth of it", {0.0, 4096.0},
          {0.5, 4.0}));
  v.Real("max_disparity_px", max_disparity_px, Setting("largest disparity", {4.0, 4096.0}));
  v.Require("max_disparity_px", max_disparity_px >= min_disparity_px + 4.0,
            "is less than 4 px above min_disparity_px", "search more disparities");
  v.Integer("window_px", window_px,
            Assumed("side of the windows, odd, that are found between pixels, in time and in the "
                    "right eye; whole disparities are those of 15 x 15 pixels",
                    "that of matching (Howard 2012 section 2); 9 shows two surfaces less often "
                    "(results/visual_odometry.md)",
                    {5, 15}, {7, 15}));
  v.Require("window_px", window_px % 2 == 1, "must be odd", "use 9 or 15");
  v.Real("noise_px", noise_px,
         Assumed("standard deviation of a feature's place, and of its disparity, beyond what the "
                 "noise of pixels makes of it: interpolation, another view of a surface",
                 "a fortieth of a pixel: windows whose view is predicted add little to the noise "
                 "of pixels (results/visual_odometry.md)",
                 {1e-3, 10.0}, {0.005, 0.1}));
  v.Boolean("slanted", slanted,
            Assumed("whether windows show small planes, whose slopes are found with their "
                    "disparities and turned with the motion, or surfaces that face the cameras",
                    "level ground that is taken to face the cameras makes a step of 75 cm nod by "
                    "0.3 mrad (results/visual_odometry.md)"));
  v.Real("slope_sd", slope_sd,
         Assumed("by how much disparities of small planes grow with column and row, standard "
                 "deviation before images say more, px/px",
                 "level ground under hazard cameras has 0.25; 0.1 and 1 changed no error on three "
                 "sequences (results/visual_odometry.md)",
                 {0.01, 10.0}, {0.1, 1.0}));
  // The bound must be kMostSlope of plane_view.cc.
  v.Real("max_slope", max_slope,
         Assumed("largest such slope", "steeper surfaces are seen from their edge", {0.0, 0.75},
                 {0.3, 0.75}));
  v.Real("max_residual_ratio", max_residual_ratio,
         Assumed("windows whose residual, in time or between the eyes, is more than so many times "
                 "the lower quartile of all of the pair are left out: they show two surfaces, such "
                 "as a rock's edge and what lies behind it, which move differently",
                 "on ground without rocks noise alone stays below it; of 1.5 to 2.5 the one with "
                 "which all pairs of KITTI's excerpt have a motion and rendered rocks bias least",
                 {1.0, 1e6}, {1.2, 4.0}));
  v.Integer("min_kept", min_kept,
            Assumed("but so many points are left, those of the least residuals",
                    "a motion of few points is worse than one of doubtful points", {0, 100000},
                    {20, 200}));
  v.Real("ambiguity", ambiguity,
         Assumed("share of another disparity's difference up to which the best one is believed",
                 "repeated texture; the consistent set follows anyway", {0.0, 1.0}, {0.7, 1.0}));
  v.Group("map", map, "the disparity map, where places are taken from it");
  // The bound of CorrelatorParams (stereo_params.cc), less one disparity for the peak filter.
  constexpr double kMapReach_px = 479.0;
  v.Require("max_disparity_px",
            source != PlaceSource::kDisparityMap || max_disparity_px <= kMapReach_px,
            "is above 479 px, which dense stereo does not reach",
            "search fewer disparities, or take places from the right eye");
}

void SelectionParams::Visit(core::FieldVisitor& v) {
  v.Choice("method", method,
           Assumed("how the largest consistent set is found: ransac, motions of three points; "
                   "rigidity, distances between points that did not change",
                   "Howard 2012 sec. 2: RANSAC or other filtering techniques"));
  v.Real("inlier_px", inlier_px,
         Assumed("ransac: how far from where a motion puts it either eye may see a point",
                 "some ten times the noise of a place, for motions of three points only",
                 {0.01, 100.0}, {0.7, 3.0}));
  v.Real("miss_probability", miss_probability,
         Assumed("ransac: chance that no draw was of members of the set alone, at which draws end",
                 "less often than anything else fails", {1e-12, 0.5}, {1e-6, 1e-2}));
  v.Integer("max_draws", max_draws,
            Assumed("ransac: most draws; the chance holds for sets of a share of the points w with "
                    "log(miss_probability) / log(1 - w^3) up to this (21 % for 1000 and 1e-4)",
                    "sets of fewer than 30 % are no motion anyway (min_share)", {1, 1000000},
                    {100, 10000}));
  v.Real("rigidity_sigma", rigidity_sigma,
         Assumed("rigidity: standard deviations by which a distance may seem to have changed",
                 "one good pair of points in 370 is lost", {0.1, 100.0}, {2.0, 5.0}));
  v.Integer("min_consistent", min_consistent,
            Assumed("fewer points that moved as one are no motion",
                    "four times the three that define a motion, so that chance does not agree",
                    {3, 100000}, {6, 30}));
  v.Real("min_share", min_share,
         Assumed("nor is a smaller share of the points that have a place at both moments",
                 "where most of what is seen moved otherwise, nobody knows which of them stood",
                 {0.0, 1.0}, {0.2, 0.6}));
}

void EstimationParams::Visit(core::FieldVisitor& v) {
  v.Choice("weights", weights,
           Assumed("weights of points that are off",
                   "the consistent set leaves mismatches of a pixel in"));
  v.Real("robust_sigma", robust_sigma,
         Assumed("residual from which on a point has less weight, in standard deviations",
                 "normal noise loses hardly any weight", {0.1, 100.0}, {1.0, 3.0}));
  v.Integer("max_iterations", max_iterations,
            Assumed("most steps of least squares", "some five are needed", {1, 1000}, {10, 100}));
  v.Real("tolerance", tolerance,
         Assumed("it ends where a step is smaller than so many standard deviations",
                 "a hundredth does not show", {1e-9, 1.0}, {1e-4, 0.1}));
  v.Real("max_fit", max_fit,
         Assumed("chi-squared over degrees of freedom up to which there is a motion",
                 "noise of more than three times what places state is no noise", {0.0, 1e6},
                 {3.0, 20.0}));
  v.Real("max_position_sd_m", max_position_sd_m,
         Assumed(
             "standard deviation of the way, in its worst direction, up to which there is a motion",
             "wheels are as good over a step of 75 cm", {0.0, 1e6}, {0.01, 0.3}));
  v.Angle("max_rotation_sd_deg", max_rotation_sd_rad,
          Assumed("standard deviation of the turn, likewise",
                  "a gyro is as good over a turn of 18 deg", {0.0, 360.0}, {0.3, 5.0}));
}

void KeyframeParams::Visit(core::FieldVisitor& v) {
  v.Real("max_way_m", max_way_m,
         Assumed("a pair that is so far from the keyframe takes its place; 0: each one does",
                 "views of near ground change by a third over 50 cm", {0.0, 1e6}, {0.1, 1.0}));
  v.Angle("max_turn_deg", max_turn_rad,
          Assumed("as does one that has turned so far", "a fifth of a view of 45 deg is lost",
                  {0.0, 180.0}, {5.0, 20.0}));
  v.Real("min_share", min_share,
         Assumed("and one in which a smaller share of the keyframe's points moved as one",
                 "before there are too few", {0.0, 1.0}, {0.2, 0.7}));
  v.Integer(
      "failures", failures,
      Setting("a pair without a motion takes the keyframe's place if it is the last of so many in "
              "a row; those before are left out, and the next is compared with the same keyframe",
              {1, 1000000}));
}

void OdometerParams::Visit(core::FieldVisitor& v) {
  v.Group("detector", detector, "corners of an image");
  v.Group("matcher", matcher, "which corners of two images are the same");
  v.Require("detector.border_px", detector.border_px >= matcher.window_px / 2,
            "is less than half of matcher.window_px: windows would reach beyond the image",
            "use at least half the side of a window");
  v.Group("placement", placement, "where they lie, from the right eye");
  v.Group("selection", selection, "which of them moved as one rigid body");
  v.Group("estimation", estimation, "the motion of these, by least squares");
  v.Group("keyframe", keyframe,
          "when a pair of images takes the place of the one that later ones are compared with");
  v.Real("variance_factor", variance_factor,
         Calibrated("what the covariance of a motion is multiplied by: errors of windows that show "
                    "one surface from one other view are not independent",
                    "rendered steps of hazard cameras: makes the mean squared error in units of "
                    "the covariance 6 (results/visual_odometry.md)",
                    {0.1, 1000.0}));
  v.Integer("rounds", rounds,
            Setting("where no motion is predicted, or another one is found: how often features are "
                    "matched, from the second time on as the motion of the time before predicts",
                    {1, 10}));
  v.Real("round_way_m", round_way_m,
         Assumed("but not where what was found lies so near to what was predicted: windows that "
                 "were turned and scaled by either look alike",
                 "an error of a seventh of a step of 75 cm; 0.03 and 0.3 m change the end error of "
                 "three sequences by a seventh at most (results/visual_odometry.md)",
                 {0.0, 1e6}, {0.03, 0.3}));
  v.Angle(
      "round_turn_deg", round_turn_rad,
      Assumed("nor by turn", "windows of 15 pixels turn by less than half a pixel at their edge",
              {0.0, 180.0}, {1.0, 6.0}));
}

}  // namespace rockyard::vision
