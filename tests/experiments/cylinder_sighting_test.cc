// Views of the coloured cylinder: what is drawn, what counts as wrong, and records as sums.
#include "experiments/cylinder_sighting/cylinder_sighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "experiments/scenario_experiment.h"

namespace rockyard::experiments {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

CylinderTruth TruthAtFiveMetres() { return {true, 0.5, {4.0, 3.0, 1.0}, 4.0}; }

// A sighting that is off by these, with standard deviations of 0.1 m along each axis and 4 deg.
vision::CylinderFinding Off(double turn_deg, double range_share) {
  const CylinderTruth truth = TruthAtFiveMetres();
  vision::CylinderSighting seen;
  seen.orientation_rad = truth.orientation_rad + turn_deg * kDegree;
  seen.p_LT_L = truth.p_LT_L;
  seen.p_LT_L.head<2>() *= 1.0 + range_share;
  seen.distance_by_stereo_m = 4.0 * (1.0 + range_share);
  seen.distance_by_size_m = 4.4;
  seen.covariance.diagonal() << 0.01, 0.01, 0.01, 16.0 * kDegree * kDegree;
  vision::CylinderFinding finding;
  finding.sighting = seen;
  return finding;
}

FinderSums Judged(const vision::CylinderFinding& finding) {
  FinderSums sums;
  JudgeSighting(TruthAtFiveMetres(), finding, sums);
  return sums;
}

TEST(JudgeSighting, WrongIsBeyondBothBounds) {
  EXPECT_EQ(Judged(Off(11.9, 0.0)).wrong, 0.0);  // beyond 10 deg, within 3 deviations of 4 deg
  EXPECT_EQ(Judged(Off(12.1, 0.0)).wrong, 1.0);
  EXPECT_EQ(Judged(Off(-12.1, 0.0)).wrong, 1.0);
  EXPECT_EQ(Judged(Off(0.0, 0.09)).wrong, 0.0);  // 4.5 deviations of 2 %, within 10 %
  EXPECT_EQ(Judged(Off(0.0, 0.11)).wrong, 1.0);
  EXPECT_EQ(Judged(Off(0.0, -0.11)).wrong, 1.0);
  vision::CylinderFinding sure = Off(9.0, 0.0);
  sure.sighting->covariance(3, 3) = 1e-6;
  EXPECT_EQ(Judged(sure).wrong, 0.0);  // many deviations, but not 10 deg
  vision::CylinderFinding unsure = Off(0.0, 0.5);
  unsure.sighting->covariance.diagonal().head<3>().setConstant(1.0);
  EXPECT_EQ(Judged(unsure).wrong, 0.0);
}

TEST(JudgeSighting, AnglesAreComparedRoundTheCircle) {
  const FinderSums sums = Judged(Off(358.0, 0.0));
  EXPECT_EQ(sums.wrong, 0.0);
  EXPECT_NEAR(sums.orientation_deg.sum, -2.0, 1e-9);
  EXPECT_NEAR(sums.orientation_deg.squares, 4.0, 1e-8);
}

TEST(JudgeSighting, ErrorsAreSharesAndUnitsOfWhatIsStated) {
  const FinderSums sums = Judged(Off(4.0, 0.04));
  EXPECT_EQ(sums.found, 1.0);
  EXPECT_EQ(sums.right, 1.0);
  EXPECT_NEAR(sums.stereo.sum, 0.04, 1e-12);
  EXPECT_NEAR(sums.size.sum, 0.1, 1e-12);
  EXPECT_NEAR(sums.right_range.sum, 0.04, 1e-12);
  EXPECT_NEAR(sums.right_bearing_mrad.sum, 0.0, 1e-9);
  EXPECT_NEAR(sums.nees, 1.0 + 0.2 * 0.2 / 0.01, 1e-9);
}

TEST(JudgeSighting, MissesAreCountedByReasonAndWrongOnesInNoRightSum) {
  vision::CylinderFinding miss;
  miss.miss = vision::CylinderMiss::kClipped;
  const FinderSums none = Judged(miss);
  EXPECT_EQ(none.found, 0.0);
  EXPECT_EQ(none.misses[static_cast<std::size_t>(vision::CylinderMiss::kClipped)], 1.0);
  const FinderSums wrong = Judged(Off(90.0, 0.0));
  EXPECT_EQ(wrong.right, 0.0);
  EXPECT_EQ(wrong.right_orientation_deg.squares, 0.0);
  EXPECT_NEAR(wrong.orientation_deg.sum, 90.0, 1e-9);
}

TEST(JudgeSighting, WithoutACylinderEveryPoseIsWrong) {
  CylinderTruth truth = TruthAtFiveMetres();
  truth.present = false;
  FinderSums sums;
  JudgeSighting(truth, Off(0.0, 0.0), sums);
  EXPECT_EQ(sums.wrong, 1.0);
  EXPECT_EQ(sums.right, 0.0);
  EXPECT_EQ(sums.orientation_deg.squares, 0.0);
}

CylinderSightingParams Small() {
  CylinderSightingParams params;
  params.measurements_per_view = 2;
  params.distances_m = {2.0, 5.0};
  params.orientations_deg = {45.0};
  return params;
}

TEST(CylinderSighting, ARunIsItsSeedAndIndex) {
  const CylinderSightingExperiment experiment(Small());
  const truth::Record first = Measure(experiment, 3, 1);
  EXPECT_EQ(first.values.size(), experiment.schema().size());
  EXPECT_EQ(ValueOf(experiment.schema(), first, "distance_m"), 5.0);
  EXPECT_EQ(ValueOf(experiment.schema(), first, "measurements"), 2.0);
  EXPECT_EQ(ValueOf(experiment.schema(), first, "published_found"), 2.0);
  EXPECT_LT(ValueOf(experiment.schema(), first, "published_orientation_error_deg") / 2.0, 100.0);
  EXPECT_EQ(first.values, experiment.Run(3, 1).values);
  EXPECT_NE(first.values, experiment.Run(4, 1).values);
}

TEST(CylinderSighting, ViewsAreDrawnAsTheParametersSay) {
  CylinderSightingParams params = Small();
  params.orientations_deg = {};
  params.any_sun_azimuth = true;
  params.largest_bearing_rad = 5.0 * kDegree;
  params.distance_spread = 0.1;
  params.third_colours = {0.0, 1.0};
  params.sun_elevations_deg = {20.0};
  params.clutter_levels = {2.0};
  params.picture.clutter.rocks = 7.0;
  const CylinderSightingExperiment experiment(params);
  double bearing_most = 0.0;
  double theta_most = 0.0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const StudiedView orange = experiment.Draw(0, {1, i});
    const StudiedView green = experiment.Draw(1, {1, i});
    EXPECT_EQ(orange.view.orientation_rad, green.view.orientation_rad);
    EXPECT_EQ(orange.picture.target.third_colour, rendering::ThirdColour::kOrange);
    EXPECT_EQ(green.picture.target.third_colour, rendering::ThirdColour::kGreen);
    EXPECT_EQ(green.robust.surfaces.third, vision::kGreenSurface);
    EXPECT_EQ(green.published.classes.red.over, vision::PrimaryColour::kGreen);
    EXPECT_EQ(orange.published.classes.red.over, vision::PrimaryColour::kRed);
    EXPECT_NEAR(orange.picture.light.elevation_rad, 20.0 * kDegree, 1e-12);
    EXPECT_EQ(orange.picture.clutter.rocks, 14.0);
    EXPECT_NEAR(orange.view.distance_m, 2.0, 0.2);
    bearing_most = std::fmax(bearing_most, std::abs(orange.view.bearing_rad));
    theta_most = std::fmax(theta_most, std::abs(orange.view.orientation_rad));
  }
  EXPECT_GT(bearing_most, 4.8 * kDegree);
  EXPECT_LE(bearing_most, 5.0 * kDegree);
  EXPECT_GT(theta_most, 175.0 * kDegree);
}

// The hills' edge of 60 m away and 5 deg up, three deviations of 1 m above it.
TEST(CylinderSighting, NoRowAboveTheHillsIsThePublishedFindersOwn) {
  CylinderSightingParams params = Small();
  params.picture.backdrop.horizon_elevation_rad = 5.0 * kDegree;
  const StudiedView studied = CylinderSightingExperiment(params).Draw(0, {1, 1});
  const double focal_px = 256.0 / std::tan(0.5 * 29.33 * kDegree);
  const double up_m = 60.0 * std::tan(5.0 * kDegree) + 3.0 - 1.0;
  EXPECT_NEAR(studied.published.sky_share, (239.5 - focal_px * up_m / 59.924 + 1.0) / 480.0, 1e-6);
  params.picture.backdrop.horizon_elevation_rad = 30.0 * kDegree;
  EXPECT_EQ(CylinderSightingExperiment(params).Draw(0, {1, 1}).published.sky_share, 0.0);
}

TEST(CylinderSighting, WithoutACylinderNothingIsRight) {
  CylinderSightingParams params = Small();
  params.present = false;
  const CylinderSightingExperiment experiment(params);
  const truth::Record record = experiment.Run(1, 0);
  EXPECT_EQ(ValueOf(experiment.schema(), record, "published_right"), 0.0);
  EXPECT_EQ(ValueOf(experiment.schema(), record, "robust_right"), 0.0);
}

// A rover before the lander's mast, as in scenarios/cylinder/views.json, at 7 to 15 m.
CylinderSightingParams FarViews() {
  CylinderSightingParams params;
  params.views_per_run = 1;
  params.measurements_per_view = 1;
  params.distances_m = {7.0, 10.0, 15.0};
  params.sun_elevations_deg = {10.0, 30.0, 60.0};
  params.clutter_levels = {0.0, 1.0, 3.0};
  params.any_sun_azimuth = true;
  params.largest_bearing_rad = 6.0 * kDegree;
  params.distance_spread = 0.15;
  params.picture.target.middle_height_m = 0.35;
  params.picture.target.stand = rendering::CylinderStand::kRover;
  params.picture.cameras.height_m = 1.5;
  params.picture.cameras.pointing = rendering::CameraPointing::kAtCylinder;
  params.picture.backdrop.horizon_elevation_rad = 2.0 * kDegree;
  params.picture.clutter.rocks = 15.0;
  params.picture.clutter.hardware = 1.0;
  return params;
}

// Trials of seed 3 at 9 and 10 m that came out 12 and 13 deg off by descents from 48 orientations
// alone, a pixel beside a place that fits far better.
TEST(CylinderSighting, TheBestPlaceIsFoundBesideALocalMinimum) {
  const CylinderSightingExperiment experiment(FarViews());
  for (const std::int64_t trial : {281, 2844}) {
    const truth::Record record = experiment.Run(3, trial);
    EXPECT_EQ(ValueOf(experiment.schema(), record, "robust_right"), 1.0) << trial;
    EXPECT_LT(std::abs(ValueOf(experiment.schema(), record, "robust_orientation_bias_deg")), 5.0)
        << trial;
  }
}

// Seed 6 at 7, 10 and 15 m: squared errors in units of the stated covariance are 4 each if that is
// right; bounds of a quarter of it and twice as much.
TEST(CylinderSighting, FarErrorsAreAsStated) {
  const CylinderSightingExperiment experiment(FarViews());
  double squares = 0.0;
  double right = 0.0;
  for (std::int64_t trial = 0; trial < 27; ++trial) {
    const truth::Record record = experiment.Run(6, trial);
    squares += ValueOf(experiment.schema(), record, "robust_nees");
    right += ValueOf(experiment.schema(), record, "robust_right");
  }
  EXPECT_GE(right, 20.0);
  EXPECT_GT(squares / right, 1.0);
  EXPECT_LT(squares / right, 8.0);
}

}  // namespace
}  // namespace rockyard::experiments
