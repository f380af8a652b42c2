// What a pinhole camera sees, by hand.
#include "report/pinhole_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

namespace rockyard::report {
namespace {

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

// A square of ground 0.2 m below the eye, 1 m to 2 m ahead: rows 50 + 100 x 0.2 / 1 and / 2.
TEST(PinholeCamera, PolygonsKeepTheirShapeWithinTheImage) {
  const std::vector<Vector3> square{
      {1.0, 0.5, -0.2}, {1.0, -0.5, -0.2}, {2.0, -0.5, -0.2}, {2.0, 0.5, -0.2}};
  const std::vector<ImagePoint> image = ImageOfPolygon(Level(), square);
  ASSERT_EQ(image.size(), 4u);
  const Box box = BoxOf(image);
  EXPECT_NEAR(box.left, 50.0, 1e-9);
  EXPECT_NEAR(box.right, 150.0, 1e-9);
  EXPECT_NEAR(box.top, 60.0, 1e-9);
  EXPECT_NEAR(box.bottom, 70.0, 1e-9);
}

// From behind the camera to 2 m ahead, as wide as its distance from the eye cannot be: the image
// takes what is left of it, down to its lower edge, where the ground is 0.4 m ahead.
TEST(PinholeCamera, PolygonsAreCutAtTheEyeAndAtTheEdges) {
  const std::vector<Vector3> ground{
      {-3.0, 9.0, -0.2}, {-3.0, -9.0, -0.2}, {2.0, -9.0, -0.2}, {2.0, 9.0, -0.2}};
  const Box box = BoxOf(ImageOfPolygon(Level(), ground));
  EXPECT_NEAR(box.left, 0.0, 1e-9);
  EXPECT_NEAR(box.right, 200.0, 1e-9);
  EXPECT_NEAR(box.top, 60.0, 1e-9);
  EXPECT_NEAR(box.bottom, 100.0, 1e-9);
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
  const Box box = BoxOf(outline);
  EXPECT_NEAR(box.left, 75.0, 1e-9);
  EXPECT_NEAR(box.right, 125.0, 1e-9);
  EXPECT_NEAR(box.top, 25.0, 1e-9);
  EXPECT_NEAR(box.bottom, 75.0, 1e-9);
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
