// What is drawn of one scan.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "report/scan_drawing.h"

namespace rockyard::report {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int kColumns = 60;
constexpr int kRows = 40;

messages::ImageBand Band(std::uint16_t counts) {
  return {-kRows / 2, -kColumns / 2, kRows, kColumns,
          std::vector<std::uint16_t>(std::size_t{kRows} * kColumns, counts)};
}

// One stripe of two points: the nearer found at column 5, the farther not.
ScanView TwoPoints(bool hazard) {
  ScanView scan;
  scan.title = "a <b> & c";
  scan.calibration.lasers.resize(1);
  scan.calibration.scanline_px = {8, -8};
  scan.points = messages::StripeArray<ShownPoint>({.rows = 2, .stripes = 1});
  scan.points[0][0] = {.pixel = {true, 5.0},
                       .searched_first_px = -12,
                       .searched_last_px = 12,
                       .elevation = {true, 0.042},
                       .p_RoP_R = {0.45, 0.0, 0.042},
                       .expected_R = {0.5, 0.0, 0.0}};
  scan.points[1][0].expected_R = {0.6, 0.0, 0.0};
  scan.hazards.stripe_hazard = {hazard};
  scan.rover = {{0.3, 0.2}, {0.3, -0.2}, {-0.3, -0.2}, {-0.3, 0.2}};
  return scan;
}

TEST(ScanPicture, FrameShowsTheSquareRootOfTheCounts) {
  messages::ImageBand band = Band(25);
  // Brighter than a thousandth of the image, so that white lies at 100 counts.
  for (int i = 0; i < 100; ++i) band.counts[static_cast<std::size_t>(i)] = 100;
  const image_files::Picture picture = FramePicture(band);
  EXPECT_EQ(picture.At(0, 0), (image_files::Rgb{255, 255, 255}));
  EXPECT_EQ(picture.At(kColumns - 1, kRows - 1), (image_files::Rgb{128, 128, 128}));
}

TEST(ScanPicture, FrameWithoutLightIsBlack) {
  EXPECT_EQ(FramePicture(Band(0)).At(3, 3), (image_files::Rgb{0, 0, 0}));
}

TEST(ScanPicture, DifferenceMarksWhatWasFound) {
  const messages::StripeExposure exposure{0, 0, {Band(10)}, {Band(10)}};
  const std::vector<double> dark(std::size_t{kRows} * kColumns, -1.0);
  const int column = 5 + kColumns / 2;
  const int row = 8 + kRows / 2;
  const image_files::Picture clear = DifferencePicture(TwoPoints(false), exposure, dark);
  const image_files::Picture hazard = DifferencePicture(TwoPoints(true), exposure, dark);
  EXPECT_GT(clear.At(column + 3, row + 3).green, 200);
  EXPECT_GT(hazard.At(column + 3, row + 3).red, 200);
  EXPECT_LT(hazard.At(column + 3, row + 3).green, 100);
  EXPECT_GT(clear.At(-12 + kColumns / 2, row - 9).blue, 200) << "searched columns";
  EXPECT_EQ(clear.At(column, row), (image_files::Rgb{0, 0, 0})) << "the peak itself stays free";
  // A point of another camera is not drawn.
  ScanView other = TwoPoints(false);
  other.calibration.lasers[0].camera = 1;
  EXPECT_EQ(DifferencePicture(other, exposure, dark).At(column + 3, row + 3),
            (image_files::Rgb{0, 0, 0}));
}

TEST(ScanDrawing, SvgShowsElevationsMissingPointsAndHazards) {
  const std::string clear = ScanSvg(TwoPoints(false));
  EXPECT_THAT(clear, HasSubstr(">42</text>"));
  EXPECT_THAT(clear, HasSubstr("stroke=\"#888\"")) << "cross of the missing point";
  EXPECT_THAT(clear, HasSubstr("a &lt;b&gt; &amp; c"));
  EXPECT_THAT(clear, Not(HasSubstr("#d22")));
  EXPECT_THAT(ScanSvg(TwoPoints(true)), HasSubstr("#d22"));
}

TEST(ScanDrawing, TextHasTheFarthestRowFirst) {
  EXPECT_EQ(ScanText(TwoPoints(true)),
            "  elevation [mm], farthest row first, left to right\n"
            "         -\n"
            "        42\n"
            "    hazard\n");
}

TEST(ScanDrawing, CsvLeavesWhatWasNotFoundEmpty) {
  EXPECT_EQ(ScanCsv(TwoPoints(false)),
            "stripe,row,detected,column_px,elevation_m,x_m,y_m,hazard\n"
            "0,0,1,5,0.042,0.45,0,0\n"
            "0,1,0,,,,,0\n");
}

}  // namespace
}  // namespace rockyard::report
