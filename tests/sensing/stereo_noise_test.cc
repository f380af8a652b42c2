#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/archive.h"
#include "core/json_file.h"
#include "noise_laws.h"
#include "perception/cloud_elevations.h"
#include "perception/hazard_detector.h"
#include "perception/hazard_params.h"
#include "stereo_scene.h"
#include "vision/each_pixel.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;

// Spread of stereo range and rate of dropouts against their laws.

// Cameras that look straight at a wall at this depth.
constexpr double kDepth_m = 2.0;

StereoParams LevelCameras() {
  StereoParams params = NoiselessStereo();
  params.front = {.ahead_m = 0.0, .height_m = 3.0, .pitch_rad = 0.0};
  params.vertical_fov_rad = math::DegToRad(60.0);
  params.max_range_m = 10.0;
  return params;
}

terrain::Terrain Wall() { return FlatWith({}, {{Vector3::UnitX(), kDepth_m}}); }

std::vector<double> Depths(const StereoParams& params, std::int64_t look) {
  std::vector<double> depths;
  for (const Vector3& p_R : LookAhead(params, Wall(), PoseAt(0, 0, 0), look).points_R) {
    depths.push_back(p_R.x());
  }
  return depths;
}

// What matching leaves of an image of disparities.
DepthImage Matched(const StereoParams& params, core::TrialKey key, std::uint32_t look,
                   const DepthImage& all_px, const PixelFlags& shaded = {}) {
  DepthImage seen_px = all_px;
  StereoMatcher(params).Match(key, look, all_px, seen_px, shaded);
  return seen_px;
}

DepthImage Even(double disparity_px) { return DepthImage::Constant(128, 128, disparity_px); }

double BinomialP(double count, double chances, double probability) {
  const boost::math::binomial law(chances, probability);
  return 2.0 * std::min(cdf(law, count), cdf(complement(law, count - 1.0)));
}

TEST(StereoNoiseTest, RangeErrorGrowsWithTheSquareOfDepth) {
  // sigma_Z = Z^2 sigma_d / (f b), to first order: the disparity is 2.7 px, sigma 0.7 % of it, and
  // second order adds 8 (0.7 %)^2 = 0.04 % to a variance known to 0.9 %.
  StereoParams params = LevelCameras();
  params.disparity_noise_px = 0.02;
  std::vector<double> depths = Depths(params, 0);
  const std::vector<double> more = Depths(params, 1);
  depths.insert(depths.end(), more.begin(), more.end());
  ASSERT_GT(depths.size(), 30000U);
  const double deviation_m =
      kDepth_m * kDepth_m * 0.02 / (params.focal_columns_px() * params.baseline_m);
  EXPECT_NEAR(deviation_m, 0.0149, 1e-4);
  EXPECT_GT(VarianceP(depths, kDepth_m, deviation_m), kAlpha);
  // Negative control: four per cent more.
  EXPECT_LT(VarianceP(depths, kDepth_m, 1.04 * deviation_m), kAlpha);
}

TEST(StereoNoiseTest, ErrorsOfTwoLooksAreIndependent) {
  StereoParams params = LevelCameras();
  params.disparity_noise_px = 0.02;
  const std::vector<double> first = Depths(params, 5);
  const std::vector<double> second = Depths(params, 6);
  ASSERT_EQ(first.size(), second.size());
  const auto correlation = [](const std::vector<double>& a, const std::vector<double>& b) {
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      ab += (a[i] - kDepth_m) * (b[i] - kDepth_m);
      aa += (a[i] - kDepth_m) * (a[i] - kDepth_m);
      bb += (b[i] - kDepth_m) * (b[i] - kDepth_m);
    }
    return ab / std::sqrt(aa * bb);
  };
  // 3.9 standard deviations of 1 / sqrt(n): alpha = 1e-4.
  const double limit = 3.9 / std::sqrt(static_cast<double>(first.size()));
  EXPECT_LT(std::abs(correlation(first, second)), limit);
  EXPECT_GT(std::abs(correlation(first, first)), limit);  // negative control
}

// Mean product of the disparity errors of pixels so far apart, over their mean square.
double Correlation(const StereoParams& params, int columns_apart, int rows_apart) {
  double product = 0.0, square = 0.0;
  for (std::uint32_t look = 0; look < 40; ++look) {
    const DepthImage error = Matched(params, {9, 0}, look, Even(8.0)) - 8.0;
    const Eigen::Index rows = 128 - rows_apart;
    const Eigen::Index columns = 128 - columns_apart;
    product += (error.topLeftCorner(rows, columns) * error.bottomRightCorner(rows, columns)).mean();
    square += error.square().mean();
  }
  return product / square;
}

TEST(StereoNoiseTest, ErrorsAreAlikeAsFarAsWindowsOverlap) {
  // (1 - i / w) (1 - j / w). 40 looks of 128^2 / 7^2 independent windows: 1 / sqrt(n) = 0.009, and
  // 0.035 is 3.9 of it, alpha = 1e-4.
  StereoParams params = LevelCameras();
  params.disparity_noise_px = 0.3;
  params.noise_window_px = 7;
  EXPECT_NEAR(Correlation(params, 1, 0), 6.0 / 7.0, 0.035);
  EXPECT_NEAR(Correlation(params, 3, 2), 4.0 / 7.0 * 5.0 / 7.0, 0.035);
  EXPECT_NEAR(Correlation(params, 0, 6), 1.0 / 7.0, 0.035);
  EXPECT_NEAR(Correlation(params, 7, 0), 0.0, 0.035);
  // Negative control: neighbours of independent errors.
  params.noise_window_px = 1;
  EXPECT_NEAR(Correlation(params, 1, 0), 0.0, 0.035);
}

TEST(StereoNoiseTest, WindowsKeepTheDeviation) {
  // 80 looks give 80 x 128^2 / 7^2 = 26700 windows' worth; their variance scatters by sqrt(2 / n)
  // = 0.9 %, and more than a window counts as one: 3.5 % is beyond 3.9 of it.
  StereoParams params = LevelCameras();
  params.disparity_noise_px = 0.3;
  params.noise_window_px = 7;
  double square = 0.0;
  for (std::uint32_t look = 0; look < 80; ++look) {
    square += (Matched(params, {9, 0}, look, Even(8.0)) - 8.0).square().mean() / 80.0;
  }
  EXPECT_NEAR(square / (0.3 * 0.3), 1.0, 0.035);
}

TEST(StereoNoiseTest, WrongMatchesAreUniformOverTheSearchedDisparities) {
  StereoParams params = LevelCameras();
  params.mismatch_probability = 0.02;
  std::vector<double> wrong;
  for (std::uint32_t look = 0; look < 20; ++look) {
    const DepthImage seen_px = Matched(params, {9, 1}, look, Even(8.0));
    for (const double disparity_px : seen_px.reshaped()) {
      if (disparity_px != 8.0) wrong.push_back(disparity_px);
    }
  }
  constexpr double kPixels = 20.0 * 128.0 * 128.0;
  EXPECT_GT(BinomialP(static_cast<double>(wrong.size()), kPixels, 0.02), kAlpha);
  EXPECT_LT(BinomialP(static_cast<double>(wrong.size()), kPixels, 0.021), kAlpha);
  const auto uniform = [](double low_px, double high_px) {
    return [=](double px) { return (px - low_px) / (high_px - low_px); };
  };
  EXPECT_GT(core::KolmogorovP(wrong, uniform(0.5, 16.0)), kAlpha);
  EXPECT_LT(core::KolmogorovP(wrong, uniform(0.5, 17.0)), kAlpha);  // negative control
}

TEST(StereoNoiseTest, DropoutsComeAsOftenAsTheyShould) {
  StereoParams params = LevelCameras();
  const auto all = static_cast<double>(Depths(params, 0).size());
  params.dropout_probability = 0.05;
  params.edge_reach_px = 0;
  const double lost = all - static_cast<double>(Depths(params, 0).size());
  EXPECT_GT(BinomialP(lost, all, 0.05), kAlpha);
  EXPECT_LT(BinomialP(lost, all, 0.06), kAlpha);  // negative control
}

TEST(StereoNoiseTest, MoreDropsOutInShadow) {
  // 1 - (1 - p) (1 - q) of the shaded half, p of the other one.
  StereoParams params = LevelCameras();
  params.dropout_probability = 0.1;
  params.shadow_dropout_probability = 0.3;
  PixelFlags shaded = PixelFlags::Constant(128, 128, false);
  shaded.rightCols(64).setConstant(true);
  double lit = 0.0, dark = 0.0;
  for (std::uint32_t look = 0; look < 20; ++look) {
    const DepthImage seen_px = Matched(params, {3, 0}, look, Even(8.0), shaded);
    lit += static_cast<double>((seen_px.leftCols(64) == 0.0).count());
    dark += static_cast<double>((seen_px.rightCols(64) == 0.0).count());
  }
  constexpr double kHalf = 20.0 * 128.0 * 64.0;
  EXPECT_GT(BinomialP(lit, kHalf, 0.1), kAlpha);
  EXPECT_GT(BinomialP(dark, kHalf, 0.37), kAlpha);
  EXPECT_LT(BinomialP(dark, kHalf, 0.4), kAlpha);  // negative control: the sum of both
}

TEST(StereoNoiseTest, ShadowDropsOutWhereNothingElseDoes) {
  StereoParams params = LevelCameras();
  params.shadow_dropout_probability = 0.3;
  const PixelFlags shaded = PixelFlags::Constant(128, 128, true);
  const DepthImage seen_px = Matched(params, {3, 0}, 0, Even(8.0), shaded);
  EXPECT_GT(BinomialP(static_cast<double>((seen_px == 0.0).count()), 128.0 * 128.0, 0.3), kAlpha);
}

// From the sensor itself: the shadow of a rock, and none where the scenario says nothing of it.
TEST(StereoNoiseTest, TheSensorDropsWhatTheSunDoesNotReach) {
  StereoParams params = NoiselessStereo();
  const rendering::SunParams sun{.elevation_rad = math::DegToRad(20.0)};
  const terrain::Terrain terrain = FlatWith({EllipsoidRock(1.0, -0.3, 0.0, 0.1, 0.1, 0.3)});
  const auto points = [&] {
    return StereoSensor(params, SunShade(sun, {}))
        .Look(terrain, PoseAt(0, 0, 0), {1, 0}, 0, messages::LookDirection::kAhead)
        .points_R.size();
  };
  const std::size_t all = points();
  EXPECT_EQ(all, LookAhead(params, terrain, PoseAt(0, 0, 0)).points_R.size());
  params.shadow_dropout_probability = 0.999;
  const std::size_t lit = points();
  // The shadow is 0.8 m long: hundreds of pixels of 16384.
  EXPECT_LT(lit + 200, all);
  EXPECT_GT(lit, all / 2);
}

// A nearer surface from column 60 to 79: three columns on both sides of its edges take the
// disparity across or keep theirs, at the rate of the parameter; wrong matches anywhere come first.
TEST(StereoNoiseTest, SurfacesAreMixedUpBesideAJumpInDepth) {
  StereoParams params = LevelCameras();
  params.edge_mismatch_probability = 0.4;
  params.mismatch_probability = 0.1;
  DepthImage all_px = Even(4.0);
  all_px.middleCols(60, 20).setConstant(9.0);
  double crossed = 0.0, elsewhere = 0.0, wrong = 0.0;
  for (std::uint32_t look = 0; look < 20; ++look) {
    const DepthImage seen_px = Matched(params, {5, 0}, look, all_px);
    for (const auto& [first, across_px] : {std::pair{57, 9.0}, {60, 4.0}, {77, 4.0}, {80, 9.0}}) {
      const auto side_px = seen_px.middleCols(first, 3);
      crossed += static_cast<double>((side_px == across_px).count());
      wrong += static_cast<double>((side_px != 9.0 && side_px != 4.0).count());
    }
    elsewhere += static_cast<double>((seen_px.leftCols(57) == 9.0).count() +
                                     (seen_px.middleCols(63, 14) == 4.0).count());
  }
  constexpr double kBeside = 20.0 * 128.0 * 12.0;
  EXPECT_GT(BinomialP(crossed, kBeside, 0.4 * 0.9), kAlpha);
  EXPECT_LT(BinomialP(crossed, kBeside, 0.4), kAlpha);  // negative control
  EXPECT_GT(BinomialP(wrong, kBeside, 0.1), kAlpha);
  EXPECT_EQ(elsewhere, 0.0);
}

// Nothing is seen across the edge of the sky.
TEST(StereoNoiseTest, TheSkyIsNoSurface) {
  StereoParams params = LevelCameras();
  params.edge_mismatch_probability = 0.999;
  DepthImage all_px = Even(4.0);
  all_px.rightCols(64).setZero();
  EXPECT_TRUE((Matched(params, {5, 0}, 0, all_px) == all_px).all());
}

TEST(StereoNoiseTest, PointsAcrossAJumpKeepTheirNoise) {
  StereoParams params = LevelCameras();
  params.edge_mismatch_probability = 0.999;
  params.disparity_noise_px = 0.1;
  DepthImage all_px = Even(4.0);
  all_px.rightCols(64).setConstant(9.0);
  const DepthImage seen_px = Matched(params, {5, 0}, 0, all_px);
  params.edge_mismatch_probability = 0.0;
  const DepthImage without_px = Matched(params, {5, 0}, 0, all_px);
  EXPECT_GT((seen_px != without_px).count(), 700);
  EXPECT_LE((seen_px != without_px).count(), 6 * 128);
  for (int row = 0; row < 128; ++row) {
    for (int column = 61; column < 67; ++column) {
      const double step_px = seen_px(row, column) - without_px(row, column);
      if (step_px != 0.0) {
        EXPECT_NEAR(step_px, column < 64 ? 5.0 : -5.0, 1e-12);
      }
    }
  }
}

TEST(StereoNoiseTest, MarginsOfBothImagesHaveNoMatch) {
  StereoParams params = LevelCameras();
  params.margin_px = 3;
  const DepthImage seen_px = Matched(params, {3, 0}, 0, Even(8.25));
  vision::ForEachPixel(128, 128, [&](int column, int row) {
    // Column c is c - 8.25 in the right image, whose margin ends at 2.5.
    const bool seen = row >= 3 && row <= 124 && column <= 124 && column >= 11;
    EXPECT_EQ(seen_px(row, column) > 0.0, seen) << row << " " << column;
  });
}

TEST(StereoNoiseTest, MoreDropsOutBesideAJumpInDepth) {
  // A plate 1 m before the wall: three columns on both sides of its edges have the other rate.
  StereoParams params = LevelCameras();
  params.edge_dropout_probability = 0.5;
  const terrain::Terrain terrain =
      FlatWith({EllipsoidRock(1.0, 0.0, 3.0, 1e-4, 0.3, 0.3)}, {{Vector3::UnitX(), kDepth_m}});
  const StereoView view = MakeStereoView(params, LookDirection::kAhead);
  const DepthImage depths = StereoScene(terrain, view, params.max_range_m).InverseDepths();
  const DepthImage all_px = depths * view.focal_px * view.baseline_m;
  double beside = 0.0, lost = 0.0, lost_elsewhere = 0.0;
  for (std::uint32_t look = 0; look < 20; ++look) {
    const DepthImage seen_px = Matched(params, {1, 0}, look, all_px);
    vision::ForEachPixel(view.columns, view.rows, [&](int column, int row) {
      bool edge = false;
      for (int at = std::max(column - 2, 1); at <= std::min(column + 3, 127); ++at) {
        edge = edge || std::abs(all_px(row, at) - all_px(row, at - 1)) >= 1.0;
      }
      const bool is_lost = seen_px(row, column) == 0.0;
      beside += edge;
      (edge ? lost : lost_elsewhere) += is_lost;
    });
  }
  EXPECT_GT(beside, 5000.0);
  EXPECT_EQ(lost_elsewhere, 0.0);
  EXPECT_GT(BinomialP(lost, beside, 0.5), kAlpha);
  EXPECT_LT(BinomialP(lost, beside, 0.53), kAlpha);  // negative control
}

// The published hazard criteria on elevation arrays from noisy stereo looks.

constexpr int kLooks = 300;

// What the behaviour controller sees and judges with stereo, as its scenario has it.
struct Rover {
  StereoParams stereo;
  perception::CloudElevationParams bins;
  perception::HazardParams hazard;
};

Rover Stored(const std::string& name) {
  const core::JsonValue scenario = core::LoadJsonFile(std::filesystem::path(ROCKYARD_SOURCE_DIR) /
                                                      "scenarios" / "gestalt" / (name + ".json"));
  const core::JsonValue& perception = *scenario.Find("perception");
  Rover rover;
  core::ReadParams(*scenario.Find("sensors")->Find("stereo"), rover.stereo);
  core::ReadParams(*perception.Find("cloud_elevations"), rover.bins);
  core::ReadParams(*perception.Find("hazard"), rover.hazard);
  return rover;
}

Rover Rocky() { return Stored("abundance_rocky_3_2_behaviour_stereo"); }
Rover Athena() { return Stored("abundance_behaviour_stereo"); }

// Looks with a hazard, of kLooks at ground with a dome of that height somewhere in the array.
int Alarms(const Rover& rover, double height_m) {
  const StereoSensor sensor(rover.stereo);
  int alarms = 0;
  for (int look = 0; look < kLooks; ++look) {
    const double middle_m = 0.5 * (rover.bins.near_m + rover.bins.far_m);
    const double x_m =
        middle_m + 0.35 * (rover.bins.far_m - rover.bins.near_m) * std::sin(3.1 * look);
    const double y_m = 0.5 * rover.bins.half_width_m * std::sin(1.7 * look);
    std::vector<terrain::Rock> rocks;
    if (height_m > 0.0) {
      rocks.push_back(EllipsoidRock(x_m, y_m, 0.0, height_m, 0.8 * height_m, height_m));
    }
    const auto cloud = sensor.Look(FlatWith(std::move(rocks)), PoseAt(0, 0, 0), {1, 0}, look,
                                   LookDirection::kAhead);
    const auto scan = perception::CloudElevations(cloud, {}, rover.bins);
    alarms += perception::ReportHazards(scan, rover.hazard).any();
  }
  return alarms;
}

// Were the rate 2 %, none of 300 looks would be an alarm once in 400 seeds, and 15 or more once in
// 2000 (binomial law).
TEST(StereoHazardTest, FlatGroundIsHardlyEverAHazard) {
  EXPECT_LT(Alarms(Rocky(), 0.0), 15);
  EXPECT_LT(Alarms(Athena(), 0.0), 15);
  // Negative control: wrong matches that the check from left to right has let through. (Noise of
  // any size is none: it raises the highest point of all bins alike.)
  Rover mistaken = Athena();
  mistaken.stereo.mismatch_probability = 0.02;
  EXPECT_GT(Alarms(mistaken, 0.0), 100);
}

// The thresholds are the clearance of the belly: 20 and 13 cm.
TEST(StereoHazardTest, RocksHigherThanTheBellyAreHazardsAndHalfAsHighAreNot) {
  for (const Rover& rover : {Athena(), Rocky()}) {
    EXPECT_EQ(Alarms(rover, 1.25 * rover.hazard.neighbour_threshold_m), kLooks);
    EXPECT_LT(Alarms(rover, 0.5 * rover.hazard.neighbour_threshold_m), kLooks / 10);
  }
}

// Rocks of 12 cm, which cover less than half a bin, at the published thresholds for single points.
TEST(StereoHazardTest, AMedianOverlooksRocksThatFillLessThanHalfABin) {
  Rover rover = Athena();
  rover.hazard = {};
  EXPECT_EQ(Alarms(rover, 0.12), kLooks);
  rover.bins.quantile = 0.5;
  EXPECT_LT(Alarms(rover, 0.12), kLooks / 2);
}

}  // namespace
}  // namespace rockyard::sensing
