// The published finder on painted pairs: all orientations, and every way to find nothing.
#include "vision/cylinder/published_finder.h"

#include <gmock/gmock.h>

#include <cmath>

#include "math/angles.h"
#include "vision/cylinder/cylinder_equations.h"
#include "vision/cylinder/painted_cylinder.h"

namespace rockyard::vision {
namespace {

using math::DegToRad;
using math::RadToDeg;
using testing::HasSubstr;

CylinderFinding Find(const PaintedPair& pair, const PublishedFinderParams& params = {}) {
  return FindCylinderAsPublished(pair.Pair(), {}, params);
}

void ExpectMiss(const CylinderFinding& finding, CylinderMiss miss, const std::string& words) {
  EXPECT_FALSE(finding.sighting);
  EXPECT_EQ(finding.miss, miss) << finding.reason;
  EXPECT_THAT(finding.reason, HasSubstr(words));
}

// Within what one pixel moves (equations 21 and 23), but for what perspective does to near ones:
// the middle between both rims is not the image of the axis, which is 1.2 % short at 0.838 m.
TEST(PublishedFinderTest, FindsAllOrientationsWithinOnePixel) {
  const ViewOfCylinder view = {512.0, DegToRad(29.33), 0.096, 0.12};
  for (const double d_m : {0.838, 1.753, 4.496, 9.982}) {
    for (int deg = -175; deg < 180; deg += 80) {
      const CylinderFinding finding = Find(Paint(SceneAt(d_m, DegToRad(deg))));
      ASSERT_TRUE(finding.sighting) << finding.reason << ", " << d_m << " m, " << deg << " deg";
      EXPECT_EQ(finding.miss, CylinderMiss::kNone);
      const CylinderSighting& seen = *finding.sighting;
      const double error_rad = math::WrapAngle(seen.orientation_rad - DegToRad(deg));
      EXPECT_LT(std::abs(error_rad), CoarsestTurnAt(view, d_m) + DegToRad(1.0))
          << d_m << " " << deg;
      const double step_m = d_m * RelativeStepByStereo(view, d_m);
      EXPECT_NEAR(seen.distance_by_stereo_m, d_m, step_m + 0.015 * d_m);
      EXPECT_NEAR(seen.distance_by_size_m, d_m,
                  1.5 * d_m * RelativeStepBySize(view, d_m) + 0.01 * d_m);
      EXPECT_NEAR(seen.p_LT_L.x(), seen.distance_by_stereo_m, 1e-9);
      EXPECT_NEAR(seen.p_LT_L.y(), -0.06, 0.02 * d_m);
      EXPECT_NEAR(seen.p_LT_L.z(), 0.0, 0.02 * d_m);
    }
  }
}

TEST(PublishedFinderTest, TellsRegionsFromLeftToRight) {
  const CylinderFinding finding = Find(Paint(SceneAt(2.0, DegToRad(-30.0))));
  ASSERT_TRUE(finding.sighting);
  for (const auto& regions : finding.sighting->regions) {
    ASSERT_EQ(regions.size(), 4U);
    EXPECT_EQ(regions[0].role, RegionRole::kWhole);
    EXPECT_EQ(regions[1].colour, CylinderColour::kRed);
    EXPECT_EQ(regions[1].role, RegionRole::kLeft);
    EXPECT_EQ(regions[2].colour, CylinderColour::kMagenta);
    EXPECT_EQ(regions[3].colour, CylinderColour::kBlue);
    EXPECT_EQ(regions[3].role, RegionRole::kRight);
    EXPECT_LT(regions[1].right, regions[2].left + 1);
    EXPECT_NEAR(regions[0].Width(), 0.192 * 999.0 / 2.0, 4.0);
  }
}

// The covariance is that of one pixel: equation 23 along the view, 19 for theta.
TEST(PublishedFinderTest, TheCovarianceIsThatOfPixelErrors) {
  const PaintedPair pair = Paint(SceneAt(4.496, DegToRad(20.0)));
  const Eigen::Matrix4d one = Find(pair).sighting->covariance;
  const double d_m = Find(pair).sighting->distance_by_stereo_m;
  const double f_px = pair.cameras.focal_px;
  EXPECT_NEAR(std::sqrt(one(0, 0)), d_m * d_m / (f_px * 0.12), 1e-3 * d_m);
  EXPECT_NEAR(std::sqrt(one(2, 2)), d_m / f_px, 0.02 * d_m / f_px);
  const double m_px = 0.5 * (Find(pair).sighting->regions[0][0].Width() +
                             Find(pair).sighting->regions[1][0].Width());
  EXPECT_NEAR(std::sqrt(one(3, 3)), CoarsestTurn(m_px), 1e-9);
  PublishedFinderParams two_pixels;
  two_pixels.pixel_error_px = 2.0;
  EXPECT_TRUE(Find(pair, two_pixels).sighting->covariance.isApprox(4.0 * one, 1e-9));
}

TEST(PublishedFinderTest, WidthsTellTheSameAsPixels) {
  PublishedFinderParams params;
  params.measure = QuadrantMeasure::kWidth;
  const CylinderFinding finding = Find(Paint(SceneAt(2.0, DegToRad(70.0))), params);
  ASSERT_TRUE(finding.sighting) << finding.reason;
  EXPECT_NEAR(RadToDeg(finding.sighting->orientation_rad), 70.0, 3.0);
}

TEST(PublishedFinderTest, NothingInViewIsNothing) {
  PaintedScene scene;
  scene.cylinders.clear();
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kNothing, "0 pixels");
}

TEST(PublishedFinderTest, AClippedCylinderIsClipped) {
  PaintedScene scene = SceneAt(2.0, 0.5);
  scene.cylinders.front().p_LT_L.y() = 0.45;
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kClipped, "border");
  // The area of interest has a border, too.
  PublishedFinderParams params;
  params.sky_share = 0.5;
  ExpectMiss(Find(Paint(SceneAt(2.0, 0.5)), params), CylinderMiss::kClipped, "border");
}

TEST(PublishedFinderTest, SwappedEyesAreSaidSo) {
  const PaintedPair pair = Paint(SceneAt(2.0, 0.5));
  ExpectMiss(FindCylinderAsPublished(pair.Swapped(), {}, {}), CylinderMiss::kSwappedEyes,
             "swapped");
}

TEST(PublishedFinderTest, UnlikeEyesAreRefused) {
  const PaintedPair pair = Paint(SceneAt(2.0, 0.5));
  PaintedPair mixed = Paint(SceneAt(3.0, 0.5));
  mixed.left = pair.left;
  ExpectMiss(Find(mixed), CylinderMiss::kUnlikeEyes, "columns");
  mixed.right = Paint(SceneAt(2.0, 1.8)).right;
  ExpectMiss(Find(mixed), CylinderMiss::kUnlikeEyes, "deg");
}

TEST(PublishedFinderTest, MirroredImagesShowAnOrderThatNoCylinderHas) {
  PaintedPair pair = Paint(SceneAt(2.0, DegToRad(135.0)));
  for (ColourImage* image : {&pair.left, &pair.right}) {
    // Blue, pink and red become red, blue and pink.
    for (Rgb& pixel : image->values()) {
      if (pixel.blue > pixel.red && pixel.blue > 100) {
        pixel = {190, 50, 120};
      } else if (pixel.red > 150 && pixel.blue > 80) {
        pixel = {24, 60, 170};
      }
    }
  }
  ExpectMiss(Find(pair), CylinderMiss::kUnlikeOrder, "magenta, blue, red");
}

TEST(PublishedFinderTest, PinkAloneIsTooFew) {
  PaintedScene scene = SceneAt(2.0, DegToRad(135.0));
  scene.quadrants[0] = scene.ground;
  scene.quadrants[2] = scene.ground;
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kTooFewRegions, "pink");
}

TEST(PublishedFinderTest, OneOrTwoRegionsAreEnough) {
  // At 45 deg blue fills the middle: alone it says 45 deg.
  PaintedScene scene = SceneAt(2.0, DegToRad(45.0));
  scene.quadrants[1] = scene.ground;
  scene.quadrants[3] = scene.ground;
  const CylinderFinding one = Find(Paint(scene));
  ASSERT_TRUE(one.sighting) << one.reason;
  EXPECT_NEAR(RadToDeg(one.sighting->orientation_rad), 45.0, 1e-6);
  EXPECT_EQ(one.sighting->regions[0].size(), 2U);
  const CylinderFinding two = Find(Paint(SceneAt(2.0, 0.0)));
  ASSERT_TRUE(two.sighting) << two.reason;
  EXPECT_NEAR(RadToDeg(two.sighting->orientation_rad), 0.0, 3.0);
}

}  // namespace
}  // namespace rockyard::vision
