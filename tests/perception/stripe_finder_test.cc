// Stripes in images made by hand.
#include "perception/stripe_finder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "perception/stripe_images.h"
#include "perception/triangulation.h"

namespace rockyard::perception {
namespace {

messages::StripePixel FindOne(const messages::StripeExposure& exposure,
                              const StripeFinderParams& params = {}) {
  return StripeFinder(params, OneLaser()).Find({.exposures = {exposure}}).pixels[0][0];
}

TEST(StripeFinderTest, FindsTheColumnOfAStripe) {
  for (const int column : {-370, -190, -100}) {
    auto exposure = WithStripe(column, 50);
    const auto pixel = FindOne(exposure);
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
  auto exposure = WithStripe(finder.searched(0, 0).last + 1, 50);
  EXPECT_FALSE(FindOne(exposure).detected);
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
  auto gone = WithStripe(-190, -15, 3);  // darker where the lasers are on
  EXPECT_FALSE(FindOne(gone).detected);
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
  auto exposure = WithStripe(-190, 1000, 7, 255);
  const auto pixel = FindOne(exposure);
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
  auto exposure = WithStripe(-384, 50);
  const auto pixel = FindOne(exposure);
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
  auto exposure = WithStripe(-190, 50);
  const auto scan = StripeFinder({}, OneLaser()).Find({.exposures = {exposure}});
  // Half a column is 0.5e-3 / (0.1 / (0.1^2 + 0.521^2)) = 1.4 mm along the ray.
  EXPECT_NEAR(Triangulator(OneLaser()).Elevations(scan).points[0][0].elevation_m, 0.0, 0.001);
}

}  // namespace
}  // namespace rockyard::perception
