// From stripe images to elevations: averaged differences, peaks and their lasers, stripes in images
// made by hand, triangulation.
#include "perception/stripe_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/random.h"
#include "messages/calibration.h"
#include "messages/stripe_images.h"
#include "perception/triangulation.h"
#include "vision/each_pixel.h"

namespace rockyard::perception {
namespace {

using math::Vector3;

// Light stripe images made by hand.

// Two cameras 0.25 m above the datum plane that look along x; one scanline 200 rows below the axis,
// at a depression of 0.5 rad; one laser, whose light plane is parallel to the axes, 0.1 m to the
// left. Flat ground appears at 0.25 / sin 0.5 = 0.521 m, column -1000 atan(0.1 / 0.521) = -190.
messages::StripeCalibration OneLaser() {
  messages::StripeCalibration calibration;
  for (messages::Camera& camera : calibration.cameras) {
    camera.X_RC.translation() = math::Vector3(0.0, 0.0, 0.25);
    camera.column_pitch_rad = 0.001;
    camera.row_pitch_rad = 0.0025;
    camera.columns = 768;
    camera.rows = 484;
  }
  calibration.lasers = {{.p_RoE_R = math::Vector3(0.0, 0.1, 0.25)}};
  calibration.scanline_px = {200};
  return calibration;
}

// A second laser in the same image, 0.1 m farther to the left: flat ground at column -367.
messages::StripeCalibration TwoLasers() {
  messages::StripeCalibration calibration = OneLaser();
  messages::StripeLaser outer = calibration.lasers[0];
  outer.p_RoE_R.y() = 0.2;
  calibration.lasers.insert(calibration.lasers.begin(), outer);
  return calibration;
}

messages::ImageBand EvenBand(std::uint16_t counts, int rows = 5, int columns = 768) {
  const auto pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  return {200 - rows / 2, -columns / 2, rows, columns, std::vector(pixels, counts)};
}

// The left camera with all lasers of group 0 on; nothing to see.
messages::StripeExposure DarkExposure() { return {0, 0, {EvenBand(20)}, {EvenBand(20)}}; }

// Adds a stripe `width` columns wide around `column`, no higher than the converter's full scale.
void AddStripe(messages::StripeExposure& exposure, int column, int counts, int width = 1,
               int full_scale = 65535) {
  messages::ImageBand& band = exposure.lit[0];
  vision::ForEachPixel(width, band.rows, [&](int i, int row) {
    const int at = row * band.columns + column - width / 2 + i - band.first_column;
    std::uint16_t& pixel = band.counts.at(static_cast<std::size_t>(at));
    pixel = static_cast<std::uint16_t>(std::min(pixel + counts, full_scale));
  });
}

// Such a stripe before darkness.
messages::StripeExposure WithStripe(int column, int counts, int width = 1, int full_scale = 65535) {
  messages::StripeExposure exposure = DarkExposure();
  AddStripe(exposure, column, counts, width, full_scale);
  return exposure;
}

// Averaged differences, peaks and their association with lasers.

// The mean over the window's part inside the band, pixel by pixel.
double PlainAverage(const messages::StripeExposure& exposure, int row, int column, int window) {
  const messages::ImageBand& lit = exposure.lit[0];
  double sum = 0.0;
  int pixels = 0;
  for (int r = row - window / 2; r <= row + window / 2; ++r) {
    for (int c = column - window / 2; c <= column + window / 2; ++c) {
      if (r < lit.first_row || r >= lit.first_row + lit.rows) continue;
      if (c < lit.first_column || c >= lit.first_column + lit.columns) continue;
      sum += lit.At(r, c) - exposure.dark[0].At(r, c);
      ++pixels;
    }
  }
  return sum / pixels;
}

TEST(AverageDifferenceTest, IsThePlainMean) {
  core::RandomStream stream({20260401, 0}, core::Purpose::kTest);
  messages::StripeExposure exposure{0, 0, {EvenBand(0, 7, 40)}, {EvenBand(0, 7, 40)}};
  for (auto* band : {&exposure.lit[0], &exposure.dark[0]}) {
    for (auto& pixel : band->counts) pixel = static_cast<std::uint16_t>(stream.NextU32() % 256);
  }
  for (const int window : {1, 3, 5, 9}) {
    for (const int row : {197, 198, 200, 203}) {
      const auto profile = AverageDifference(exposure, row, window);
      ASSERT_TRUE(profile);
      ASSERT_EQ(profile->difference.size(), 40u);
      for (int i = 0; i < 40; ++i) {
        EXPECT_NEAR(profile->difference[static_cast<std::size_t>(i)],
                    PlainAverage(exposure, row, profile->first_column + i, window), 1e-9)
            << window << " " << row << " " << i;
      }
    }
  }
}

TEST(AverageDifferenceTest, ImageNarrowerThanTheWindow) {
  messages::StripeExposure exposure{0, 0, {EvenBand(9, 5, 2)}, {EvenBand(4, 5, 2)}};
  const auto profile = AverageDifference(exposure, 200, 9);
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->difference, (std::vector<double>{5.0, 5.0}));
}

TEST(AverageDifferenceTest, RowsOutsideTheBands) {
  for (const int row : {197, 203}) EXPECT_FALSE(AverageDifference(DarkExposure(), row, 5));
  for (const int row : {198, 202}) EXPECT_TRUE(AverageDifference(DarkExposure(), row, 5));
}

TEST(ScanlineProfileTest, NoiseIsTheDeviationOfANormalVariable) {
  EXPECT_NEAR((ScanlineProfile{0, {2.0, -2.0, 2.0, -2.0}}).Noise(),
              2.0 * std::sqrt(0.5 * std::numbers::pi), 1e-12);
  EXPECT_EQ(ScanlineProfile{}.Noise(), 0.0);
  core::RandomStream stream({20260402, 0}, core::Purpose::kTest);
  ScanlineProfile profile;
  for (int i = 0; i < 20000; ++i)
    profile.difference.push_back(core::SampleNormal(stream, 0.0, 3.0));
  // Standard error sqrt(pi / 2 - 1) / sqrt(20000) = 0.53 %; four of them, chance 6e-5.
  EXPECT_NEAR(profile.Noise(), 3.0, 4 * 0.0053 * 3.0);
}

TEST(FindPeaksTest, RunsAboveTheThreshold) {
  const ScanlineProfile profile{-3, {0, 2, 3, 2, 0, 0, 4, 4}};
  const auto peaks = FindPeaks(profile, {.threshold_counts = 1.0, .noise_multiple = 0.0});
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_EQ(peaks[0].column_px, -1.0);
  EXPECT_EQ(peaks[0].height_counts, 3.0);
  EXPECT_EQ(peaks[1].column_px, 4.0) << "half a pixel is rounded away from the axis";
  EXPECT_EQ(peaks[1].height_counts, 4.0);
}

// Searched part around a datum column.
StripeSearch Around(int datum, int half) {
  return {{datum - half, datum + half}, static_cast<double>(datum)};
}

using Found = std::vector<std::optional<std::size_t>>;

const std::vector<StripeSearch> kOverlapping{Around(-10, 40), Around(10, 40)};

TEST(AssociatePeaksTest, SeparateSearchesTakeTheirOwn) {
  const std::vector<StripeSearch> lasers{Around(-50, 10), Around(50, 10)};
  const std::vector<StripePeak> peaks{{-45, 5}, {0, 9}, {52, 3}};
  EXPECT_EQ(AssociatePeaks(lasers, peaks, PeakChoice::kStrongest), (Found{0, 2}));
}

TEST(AssociatePeaksTest, OverlapKeepsTheOrder) {
  // Each alone would take the other's: the left laser's strongest peak is the right one.
  const std::vector<StripePeak> peaks{{-20, 5}, {20, 9}};
  EXPECT_EQ(AssociatePeaks(kOverlapping, peaks, PeakChoice::kStrongest), (Found{0, 1}));
}

TEST(AssociatePeaksTest, ThreePeaksForTwoLasers) {
  const std::vector<StripePeak> peaks{{-20, 5}, {0, 4}, {20, 9}};
  EXPECT_EQ(AssociatePeaks(kOverlapping, peaks, PeakChoice::kStrongest), (Found{0, 2}));
  EXPECT_EQ(AssociatePeaks(kOverlapping, {peaks.data(), 2}, PeakChoice::kStrongest), (Found{0, 1}));
}

TEST(AssociatePeaksTest, OnePeakForTwoLasersGoesToTheNearerDatum) {
  for (const auto choice : {PeakChoice::kStrongest, PeakChoice::kNearestToDatum}) {
    EXPECT_EQ(AssociatePeaks(kOverlapping, std::vector<StripePeak>{{-4, 5}}, choice),
              (Found{0, std::nullopt}));
    EXPECT_EQ(AssociatePeaks(kOverlapping, std::vector<StripePeak>{{4, 5}}, choice),
              (Found{std::nullopt, 0}));
  }
}

TEST(AssociatePeaksTest, NearestPrefersMorePeaksToNearerOnes) {
  const std::vector<StripePeak> peaks{{-45, 1}, {-30, 9}, {-9, 1}};
  // Both are seen; of the left laser's two, the one nearer to its datum column.
  EXPECT_EQ(AssociatePeaks(kOverlapping, peaks, PeakChoice::kNearestToDatum), (Found{1, 2}));
}

TEST(AssociatePeaksTest, NoPeaksAndEmptySearches) {
  const std::vector<StripeSearch> lasers{Around(0, 10), StripeSearch{}};
  EXPECT_EQ(AssociatePeaks(lasers, {}, PeakChoice::kStrongest),
            (Found{std::nullopt, std::nullopt}));
  EXPECT_EQ(AssociatePeaks(lasers, std::vector<StripePeak>{{0, 5}, {5, 5}}, PeakChoice::kStrongest),
            (Found{0, std::nullopt}));
}

// Stripes in images made by hand.

messages::StripePixel FindOne(const messages::StripeExposure& exposure,
                              const StripeFinderParams& params = {}) {
  return StripeFinder(params, OneLaser()).Find({.exposures = {exposure}}).pixels[0][0];
}

TEST(StripeFinderTest, FindsTheColumnOfAStripe) {
  for (const int column : {-370, -190, -100}) {
    const auto pixel = FindOne(WithStripe(column, 50));
    ASSERT_TRUE(pixel.detected) << column;
    EXPECT_EQ(pixel.column_px, column);
  }
}

TEST(StripeFinderTest, CarriesTheNumberAndTheSizeOfTheArray) {
  const auto scan = StripeFinder({}, TwoLasers()).Find({.number = 7, .exposures = {}});
  EXPECT_EQ(scan.number, 7);
  EXPECT_EQ(scan.pixels.size(), (messages::StripeArraySize{1, 2}));
}

TEST(StripeFinderTest, SearchedColumnsAreThoseOfTheElevations) {
  // At the lowest elevation the stripe lies (0.25 + 0.30) / sin 0.5 away; the highest lies left of
  // the image.
  const StripeFinder finder({}, OneLaser());
  EXPECT_EQ(finder.searched(0, 0).first, -384);
  EXPECT_EQ(finder.searched(0, 0).last,
            static_cast<int>(std::floor(-1000.0 * std::atan(0.1 / (0.55 / std::sin(0.5))))));
  EXPECT_FALSE(FindOne(WithStripe(finder.searched(0, 0).last + 1, 50)).detected);
}

TEST(StripeFinderTest, AveragedDifferenceMustExceedTheThreshold) {
  // One column of five holds the stripe: 10 counts average to 2.
  auto exposure = WithStripe(-190, 10);
  StripeFinderParams params{.threshold_counts = 2.0, .noise_multiple = 0.0};
  EXPECT_FALSE(FindOne(exposure, params).detected);
  params.threshold_counts = 1.99;
  EXPECT_TRUE(FindOne(exposure, params).detected);
}

TEST(StripeFinderTest, ThresholdFollowsTheNoiseOfTheScanline) {
  // Averaged differences of +-4 along all of the scanline: a deviation of 4 sqrt(pi / 2) = 5.0.
  const auto exposure_with = [](int stripe_counts) {
    auto exposure = DarkExposure();
    for (int column = -370; column < 370; column += 20) {
      AddStripe(exposure, column, 4, 10);
      AddStripe(exposure, column + 10, -4, 10);
    }
    AddStripe(exposure, -190, stripe_counts, 5);
    return exposure;
  };
  EXPECT_TRUE(FindOne(exposure_with(0), {.noise_multiple = 0.5}).detected);
  EXPECT_FALSE(FindOne(exposure_with(0), {.noise_multiple = 3.0}).detected);
  EXPECT_TRUE(FindOne(exposure_with(40), {.noise_multiple = 3.0}).detected);
}

TEST(StripeFinderTest, NothingToSeeIsMissing) {
  EXPECT_FALSE(FindOne(DarkExposure()).detected);
  EXPECT_FALSE(FindOne(WithStripe(-190, -15, 3)).detected) << "darker where the lasers are on";
}

TEST(StripeFinderTest, ImagesThatAreNotThereLeavePointsMissing) {
  EXPECT_FALSE(StripeFinder({}, OneLaser()).Find({}).pixels[0][0].detected);
  auto other_rows = WithStripe(-190, 50);
  other_rows.lit[0].first_row = other_rows.dark[0].first_row = 100;
  EXPECT_FALSE(FindOne(other_rows).detected);
  auto other_camera = WithStripe(-190, 50);
  other_camera.camera = 1;
  EXPECT_FALSE(FindOne(other_camera).detected);
  auto other_group = WithStripe(-190, 50);
  other_group.group = 1;
  EXPECT_FALSE(FindOne(other_group).detected);
}

TEST(StripeFinderTest, SaturatedStripe) {
  const auto pixel = FindOne(WithStripe(-190, 1000, 7, 255));
  ASSERT_TRUE(pixel.detected);
  EXPECT_EQ(pixel.column_px, -190.0);
}

TEST(StripeFinderTest, SunlightThatSaturatesBothImagesHidesTheStripe) {
  messages::StripeExposure exposure{0, 0, {EvenBand(255)}, {EvenBand(255)}};
  AddStripe(exposure, -190, 100, 3, 255);
  EXPECT_FALSE(FindOne(exposure).detected);
}

TEST(StripeFinderTest, BorderColumns) {
  // At the border the average is that of fewer columns: the run reaches two columns inwards.
  const auto pixel = FindOne(WithStripe(-384, 50));
  ASSERT_TRUE(pixel.detected);
  EXPECT_EQ(pixel.column_px, -383.0);
}

TEST(StripeFinderTest, SeveralPeaks) {
  auto exposure = WithStripe(-180, 40);
  AddStripe(exposure, -250, 60);
  EXPECT_EQ(FindOne(exposure).column_px, -250.0);
  EXPECT_EQ(FindOne(exposure, {.peak = PeakChoice::kNearestToDatum}).column_px, -180.0);
}

TEST(StripeFinderTest, CentroidLiesBetweenPixels) {
  // Brightness 3 : 1 on two columns.
  auto exposure = WithStripe(-190, 75);
  AddStripe(exposure, -189, 25);
  EXPECT_NEAR(FindOne(exposure, {.column = PeakColumn::kCentroid}).column_px, -189.75, 1e-9);
  EXPECT_EQ(FindOne(exposure).column_px, std::floor(FindOne(exposure).column_px));
}

TEST(StripeFinderTest, TwoLasersInOneImageKeepTheirOrder) {
  const StripeFinder finder({}, TwoLasers());
  auto exposure = DarkExposure();
  // Both columns lie in the searched part of both lasers.
  AddStripe(exposure, -210, 60);
  AddStripe(exposure, -340, 50);
  ASSERT_TRUE(finder.searched(0, 0).Contains(-210.0));
  ASSERT_TRUE(finder.searched(0, 1).Contains(-340.0));
  const auto scan = finder.Find({.exposures = {exposure}});
  EXPECT_EQ(scan.pixels[0][0].column_px, -340.0);
  EXPECT_EQ(scan.pixels[0][1].column_px, -210.0);
}

TEST(StripeFinderTest, LaserOfTheOtherCameraTakesItsOwnPeak) {
  // The outer laser is measured by the right camera, and brighter. Its stripe is not taken for that
  // of the inner laser, to which the columns belong as well.
  messages::StripeCalibration calibration = TwoLasers();
  calibration.lasers[0].camera = 1;
  auto exposure = WithStripe(-190, 40);
  AddStripe(exposure, -360, 90);
  const auto scan = StripeFinder({}, calibration).Find({.exposures = {exposure}});
  EXPECT_FALSE(scan.pixels[0][0].detected);
  EXPECT_EQ(scan.pixels[0][1].column_px, -190.0);
}

TEST(StripeFinderTest, ColumnsTriangulateToElevations) {
  const auto scan = StripeFinder({}, OneLaser()).Find({.exposures = {WithStripe(-190, 50)}});
  // Half a column is 0.5e-3 / (0.1 / (0.1^2 + 0.521^2)) = 1.4 mm along the ray.
  EXPECT_NEAR(Triangulator(OneLaser()).Elevations(scan).points[0][0].elevation_m, 0.0, 0.001);
}

// Triangulation by hand: one camera at the origin of R looking along x, one light plane beside it.

// Light plane parallel to the optical axis, 0.1 m to the left.
messages::StripeCalibration Parallel() {
  messages::StripeCalibration calibration;
  for (auto& camera : calibration.cameras) {
    camera.column_pitch_rad = 0.001;
    camera.row_pitch_rad = 0.001;
  }
  calibration.lasers.assign(messages::kStripes,
                            {.p_RoE_R = Vector3(0.0, 0.1, 0.0), .normal_R = Vector3::UnitY()});
  calibration.scanline_px = {600, 500, 400, 300};
  return calibration;
}

messages::ElevationScan ElevationsAt(const messages::StripeCalibration& calibration,
                                     double column_px) {
  messages::StripeScan scan{.number = 12, .pixels = {}};
  for (messages::StripePixel& pixel : scan.pixels.points()) {
    pixel = {.detected = true, .column_px = column_px};
  }
  return Triangulator(calibration).Elevations(scan);
}

TEST(TriangulationTest, ElevationOfAKnownPoint) {
  // Column -200 looks 0.2 rad to the left: depth 0.1 / tan(0.2), elevation -depth sin(row angle).
  const auto scan = ElevationsAt(Parallel(), -200.0);
  EXPECT_EQ(scan.number, 12);
  const double depth = 0.1 / std::tan(0.2);
  EXPECT_NEAR(scan.points[0][0].elevation_m, -depth * std::sin(0.6), 1e-12);
  EXPECT_NEAR(scan.points[3][4].elevation_m, -depth * std::sin(0.3), 1e-12);
}

TEST(TriangulationTest, CountsFromTheDatumPlane) {
  auto calibration = Parallel();
  calibration.datum_z_m = -0.2;
  const double above = ElevationsAt(calibration, -200.0).points[0][0].elevation_m;
  EXPECT_NEAR(above - ElevationsAt(Parallel(), -200.0).points[0][0].elevation_m, 0.2, 1e-12);
}

TEST(TriangulationTest, RaysThatMeetTheLightBehindOrNowhereAreNoDetections) {
  EXPECT_FALSE(ElevationsAt(Parallel(), 200.0).points[1][1].detected);
  EXPECT_FALSE(ElevationsAt(Parallel(), 0.0).points[1][1].detected);
}

TEST(TriangulationTest, UsesTheCameraOfTheStripe) {
  auto calibration = Parallel();
  calibration.cameras[1].X_RC.translation() = Vector3(0.0, 0.05, 0.3);
  calibration.lasers[2].camera = 1;
  const auto scan = ElevationsAt(calibration, -200.0);
  EXPECT_NEAR(scan.points[0][2].elevation_m, 0.3 - 0.05 / std::tan(0.2) * std::sin(0.6), 1e-12);
  EXPECT_NEAR(scan.points[0][1].elevation_m, -0.1 / std::tan(0.2) * std::sin(0.6), 1e-12);
}

// The short form for planar scanlines against rays that meet light planes in space.
TEST(TriangulationTest, ElevationIsThatOfThePoint) {
  messages::StripeCalibration calibration = Parallel();
  calibration.datum_z_m = 0.03;
  for (auto& camera : calibration.cameras) {
    camera.X_RC.translation() = Vector3(0.27, -0.06, 0.25);
    camera.X_RC.linear() =
        (Eigen::AngleAxisd(0.1, Vector3::UnitZ()) * Eigen::AngleAxisd(0.7, Vector3::UnitY()))
            .toRotationMatrix();
  }
  calibration.lasers[1].normal_R = Vector3(0.3, 0.9, 0.1).normalized();
  for (const auto lens : {messages::Lens::kEquidistantRows, messages::Lens::kEquidistant}) {
    for (auto& camera : calibration.cameras) camera.lens = lens;
    const Triangulator triangulator(calibration);
    for (double column = -380.0; column <= 380.0; column += 20.0) {
      const auto point = triangulator.Point(2, 1, column);
      const auto elevation = triangulator.Elevation(2, 1, column);
      ASSERT_EQ(elevation.detected, point.has_value());
      if (point) {
        // Relative to the distance: rays that hardly meet the light plane meet it far away.
        EXPECT_NEAR(elevation.elevation_m, point->z() - 0.03, 1e-12 * (1.0 + point->norm()));
      }
    }
  }
}

TEST(TriangulationTest, MissingStaysMissing) {
  const auto scan = Triangulator(Parallel()).Elevations({});
  for (const auto& point : scan.points.points()) EXPECT_FALSE(point.detected);
}

}  // namespace
}  // namespace rockyard::perception
