// What is drawn of one scan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "report/pinhole_camera.h"
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

// What a pinhole camera sees, by hand.

using math::Vector3;

// At the origin, along x; 200 x 100 px of 90 x 53 degrees: tangents of 1 and 0.5.
PinholeCamera Level() {
  return {.focal_columns_px = 100.0, .focal_rows_px = 100.0, .columns_px = 200.0, .rows_px = 100.0};
}

void ExpectAt(const std::optional<ImagePoint>& point, double column, double row) {
  ASSERT_TRUE(point.has_value());
  EXPECT_NEAR(point->column, column, 1e-9);
  EXPECT_NEAR(point->row, row, 1e-9);
}

TEST(PinholeCamera, PutsTheAxisInTheMiddleAndTheFieldOfViewAtTheEdge) {
  ExpectAt(Project(Level(), {5.0, 0.0, 0.0}), 100.0, 50.0);
  ExpectAt(Project(Level(), {2.0, -2.0, 0.0}), 200.0, 50.0);
  ExpectAt(Project(Level(), {2.0, 2.0, 0.0}), 0.0, 50.0);
  ExpectAt(Project(Level(), {2.0, 0.0, -1.0}), 100.0, 100.0);
  ExpectAt(Project(Level(), {2.0, 0.0, 2.0}), 100.0, -50.0);
}

TEST(PinholeCamera, LooksDownFromItsMount) {
  PinholeCamera camera = Level();
  camera.eye = {0.4, 0.06, 0.5};
  const double r = std::numbers::sqrt2 / 2.0;
  camera.axis = {r, 0.0, -r};
  camera.down = {-r, 0.0, -r};
  // The axis meets the ground half a metre ahead of the mount; the ray of tangent 1/2 below it at
  // 45 degrees + atan(1/2), which has the tangent 3: a sixth of a metre ahead.
  ExpectAt(Project(camera, {0.9, 0.06, 0.0}), 100.0, 50.0);
  ExpectAt(Project(camera, {0.4 + 0.5 / 3.0, 0.06, 0.0}), 100.0, 100.0);
}

TEST(PinholeCamera, SeesNothingBehind) {
  EXPECT_FALSE(Project(Level(), {-5.0, 0.0, 0.0}));
  EXPECT_FALSE(Project(Level(), {0.9 * kNearestDepth_m, 0.0, 0.0}));
  const std::vector<Vector3> behind{{-1.0, 0.0, 0.0}, {-2.0, 1.0, 0.0}, {-2.0, -1.0, 0.0}};
  EXPECT_TRUE(ImageOfPolygon(Level(), behind).empty());
  EXPECT_TRUE(Silhouette(Level(), behind).empty());
}

struct Box {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};

Box BoxOf(const std::vector<ImagePoint>& polygon) {
  Box box;
  for (const ImagePoint& point : polygon) {
    box.left = std::min(box.left, point.column);
    box.right = std::max(box.right, point.column);
    box.top = std::min(box.top, point.row);
    box.bottom = std::max(box.bottom, point.row);
  }
  return box;
}

void ExpectBox(const Box& box, const Box& expected) {
  EXPECT_NEAR(box.left, expected.left, 1e-9);
  EXPECT_NEAR(box.right, expected.right, 1e-9);
  EXPECT_NEAR(box.top, expected.top, 1e-9);
  EXPECT_NEAR(box.bottom, expected.bottom, 1e-9);
}

// A square of ground 0.2 m below the eye, 1 m to 2 m ahead: rows 50 + 100 x 0.2 / 1 and / 2.
TEST(PinholeCamera, PolygonsKeepTheirShapeWithinTheImage) {
  const std::vector<Vector3> square{
      {1.0, 0.5, -0.2}, {1.0, -0.5, -0.2}, {2.0, -0.5, -0.2}, {2.0, 0.5, -0.2}};
  const std::vector<ImagePoint> image = ImageOfPolygon(Level(), square);
  ASSERT_EQ(image.size(), 4u);
  ExpectBox(BoxOf(image), {50.0, 150.0, 60.0, 70.0});
}

// From behind the camera to 2 m ahead, as wide as its distance from the eye cannot be: the image
// takes what is left of it, down to its lower edge, where the ground is 0.4 m ahead.
TEST(PinholeCamera, PolygonsAreCutAtTheEyeAndAtTheEdges) {
  const std::vector<Vector3> ground{
      {-3.0, 9.0, -0.2}, {-3.0, -9.0, -0.2}, {2.0, -9.0, -0.2}, {2.0, 9.0, -0.2}};
  ExpectBox(BoxOf(ImageOfPolygon(Level(), ground)), {0.0, 200.0, 60.0, 100.0});
  const std::vector<Vector3> aside{{2.0, 3.0, 0.0}, {2.0, 4.0, 0.0}, {3.0, 4.0, 0.0}};
  EXPECT_TRUE(ImageOfPolygon(Level(), aside).empty());
}

// A cube of 1 m around (2.5, 0, 0): its front face, at 2 m, is all of its outline.
TEST(PinholeCamera, ASilhouetteIsTheHullOfWhatIsSeen) {
  std::vector<Vector3> corners{{2.5, 0.0, 0.0}};
  for (const double x : {2.0, 3.0}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) corners.push_back({x, y, z});
    }
  }
  const std::vector<ImagePoint> outline = Silhouette(Level(), corners);
  ASSERT_EQ(outline.size(), 4u);
  ExpectBox(BoxOf(outline), {75.0, 125.0, 25.0, 75.0});
}

TEST(PinholeCamera, TheHorizonOfALevelCameraIsItsMiddleRow) {
  const Box level = BoxOf(BelowHorizon(Level(), Vector3::UnitZ()));
  EXPECT_NEAR(level.top, 50.0, 1e-9);
  EXPECT_NEAR(level.bottom, 100.0, 1e-9);
  // Nose down by atan(1/4): the horizon rises by 25 rows. By 45 degrees: nothing but ground.
  const Vector3 pitched = Vector3(-0.25, 0.0, 1.0).normalized();
  EXPECT_NEAR(BoxOf(BelowHorizon(Level(), pitched)).top, 25.0, 1e-9);
  const Vector3 steep = Vector3(-1.0, 0.0, 1.0).normalized();
  EXPECT_NEAR(BoxOf(BelowHorizon(Level(), steep)).top, 0.0, 1e-9);
  EXPECT_TRUE(BelowHorizon(Level(), -steep).empty()) << "nothing but sky";
}

}  // namespace
}  // namespace rockyard::report
