// The robust finder on painted pairs: light, noise and crosstalk; its covariance; every way to find
// nothing.
#include "vision/cylinder/robust_finder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/angles.h"
#include "vision/cylinder/colour_model.h"
#include "vision/cylinder/cylinder_equations.h"
#include "vision/cylinder/painted_cylinder.h"

namespace rockyard::vision {
namespace {

using math::DegToRad;
using math::RadToDeg;
using testing::HasSubstr;

CylinderFinding Find(const PaintedPair& pair, const RobustFinderParams& params = {}) {
  return FindCylinder(pair.Pair(), {}, params);
}

void ExpectMiss(const CylinderFinding& finding, CylinderMiss miss, const std::string& words) {
  EXPECT_FALSE(finding.sighting);
  EXPECT_EQ(finding.miss, miss) << finding.reason;
  EXPECT_THAT(finding.reason, HasSubstr(words));
}

PaintedScene OutdoorsAt(double distance_m, double orientation_rad, std::uint64_t seed) {
  PaintedScene scene = SceneAt(distance_m, orientation_rad);
  scene.light = {1.0, 0.9, 0.75};
  scene.diffuse = 0.5;
  scene.sun_azimuth_rad = DegToRad(40.0);
  scene.crosstalk = 0.05;
  scene.noise_grey = 2.0;
  scene.ground_texture = 0.1;
  scene.seed = seed;
  return scene;
}

TEST(RobustFinderTest, CleanImagesTellTheirPoseToParts) {
  for (const double d_m : {0.838, 4.496, 9.982}) {
    for (int deg = -170; deg < 180; deg += 110) {
      const CylinderFinding finding = Find(Paint(SceneAt(d_m, DegToRad(deg))));
      ASSERT_TRUE(finding.sighting) << finding.reason << ", " << d_m << " m, " << deg << " deg";
      const CylinderSighting& seen = *finding.sighting;
      const double error_deg = RadToDeg(math::WrapAngle(seen.orientation_rad - DegToRad(deg)));
      EXPECT_LT(std::abs(error_deg), 0.05 + 0.16 * d_m) << d_m << " " << deg;
      EXPECT_NEAR(seen.p_LT_L.x(), d_m, 1e-3 * d_m + 2e-3 * d_m * d_m);
      EXPECT_NEAR(seen.p_LT_L.y(), -0.06, 2e-3 + 2e-4 * d_m);
      EXPECT_NEAR(seen.p_LT_L.z(), 0.0, 2e-3 + 5e-4 * d_m);
      EXPECT_NEAR(seen.distance_by_size_m, d_m, 0.03 * d_m);
      EXPECT_NEAR(seen.distance_by_stereo_m, d_m, 0.03 * d_m);
    }
  }
}

// Errors over their standard deviations, of scenes with all there is.
TEST(RobustFinderTest, ErrorsAreWithinTheirCovariance) {
  double squares = 0.0;
  int found = 0, runs = 0;
  for (const double d_m : {1.2, 4.0, 9.0}) {
    for (int i = 0; i < 5; ++i) {
      const double theta_rad = DegToRad(-160.0 + 69.0 * i);
      const CylinderFinding finding =
          Find(Paint(OutdoorsAt(d_m, theta_rad, static_cast<std::uint64_t>(i + 1))));
      ++runs;
      if (!finding.sighting) continue;
      ++found;
      Eigen::Vector4d error;
      error.head<3>() = finding.sighting->p_LT_L - math::Vector3(d_m, -0.06, 0.0);
      error[3] = math::WrapAngle(finding.sighting->orientation_rad - theta_rad);
      EXPECT_LT(std::abs(RadToDeg(error[3])), 10.0) << d_m << " " << i;
      squares += error.dot(finding.sighting->covariance.inverse() * error);
    }
  }
  EXPECT_GE(found, runs - 1);
  // 4 each if the covariance is right; four times too small would be beyond. It is made for views
  // with rocks and things behind, where tests/experiments hold it from both sides, and is too large
  // for these.
  EXPECT_LT(squares / found, 8.0);
  EXPECT_GT(squares / found, 0.06);
}

TEST(RobustFinderTest, LeaningCylindersAreFound) {
  for (const double lean_deg : {-6.0, 6.0}) {
    PaintedScene scene = SceneAt(2.0, DegToRad(20.0));
    scene.cylinders.front().lean_rad = DegToRad(lean_deg);
    const CylinderFinding finding = Find(Paint(scene));
    ASSERT_TRUE(finding.sighting) << finding.reason;
    EXPECT_NEAR(RadToDeg(finding.sighting->orientation_rad), 20.0, 1.0);
  }
}

// Of a finding against the first cylinder of a scene: its place and orientation.
void ExpectFound(const CylinderFinding& finding, const PaintedScene& scene, double place_m,
                 double angle_deg) {
  ASSERT_TRUE(finding.sighting) << finding.reason;
  const PaintedCylinder& truth = scene.cylinders.front();
  const math::Vector3 error_m = finding.sighting->p_LT_L - truth.p_LT_L;
  EXPECT_LT(error_m.norm(), place_m) << error_m.transpose();
  EXPECT_NEAR(RadToDeg(math::WrapAngle(finding.sighting->orientation_rad - truth.orientation_rad)),
              0.0, angle_deg);
}

bool IsMissedOrTurned(const CylinderFinding& finding, const PaintedScene& scene, double angle_deg) {
  return !finding.sighting ||
         std::abs(RadToDeg(math::WrapAngle(finding.sighting->orientation_rad -
                                           scene.cylinders.front().orientation_rad))) > angle_deg;
}

TEST(RobustFinderTest, CylindersSeenFromAboveAndBelowAreFound) {
  for (const double pitch_deg : {-25.0, 8.0, 20.0, 33.0}) {
    for (int deg = -160; deg < 180; deg += 115) {
      SCOPED_TRACE(testing::Message() << pitch_deg << " deg down, " << deg);
      const PaintedScene scene = SceneFromAbove(2.2, DegToRad(deg), DegToRad(pitch_deg));
      ExpectFound(Find(Paint(scene)), scene, 0.015, 1.0);
    }
  }
}

// The axis is what tells the height: along the columns of the image it is another one.
TEST(RobustFinderTest, TheAxisIsWhereTheCylinderPoints) {
  const double pitch_rad = DegToRad(25.0);
  const PaintedScene scene = SceneFromAbove(2.2, 0.5, pitch_rad);
  const ColourCylinder tilted{
      .axis_L = {3.0 * std::sin(pitch_rad), 0.0, 3.0 * std::cos(pitch_rad)}};
  const CylinderFinding finding = FindCylinder(Paint(scene).Pair(), tilted, {});
  ASSERT_TRUE(finding.sighting) << finding.reason;
  EXPECT_GT((finding.sighting->p_LT_L - scene.cylinders.front().p_LT_L).norm(), 0.03);
}

// A rover's deck and the lid, grey as cardboard or bluish as solar cells.
TEST(RobustFinderTest, GreyThingsThatTouchItAreNotPartOfIt) {
  for (const PaintColour& lid : {PaintColour(0.55, 0.53, 0.50), PaintColour(0.07, 0.08, 0.12)}) {
    PaintedScene scene = SceneFromAbove(2.2, DegToRad(100.0), DegToRad(25.0));
    scene.top = lid;
    scene.crosstalk = 0.08;
    ExpectFound(Find(Paint(scene)), scene, 0.015, 1.0);
  }
}

// Solar cells as an 8-bit camera sees them, and the blue of the cylinder in the same light.
TEST(RobustFinderTest, SolarCellsAreGreyRatherThanBlue) {
  const ColourModelParams colours;
  const auto label_of = [](const Rgb& pixel, const ColourModelParams& params) {
    return LabelSurfaces(ColourImage(1, 1, pixel), LogRatios::Zero(), {}, params).At(0, 0);
  };
  const Rgb cells{15, 16, 23};
  const Rgb blue{40, 65, 140};
  EXPECT_EQ(label_of(cells, colours), kBackground);
  EXPECT_EQ(label_of(blue, colours), LabelOf(CylinderColour::kBlue));
  // Control: to a finder that knows of nothing grey they are blue.
  const ColourModelParams no_grey{.neutral_sd = 0.05};
  EXPECT_EQ(label_of(cells, no_grey), LabelOf(CylinderColour::kBlue));
}

struct SideLight {
  double theta_deg = 0.0;
  double sun_deg = 0.0;
};

// As a camera of one chip sees it, dark, blurred by a pixel, with the sun at a side.
PaintedPair PaintSideLit(const PaintedScene& at, double sun_deg) {
  PaintedScene scene = at;
  scene.diffuse = 0.25;
  scene.sun_azimuth_rad = DegToRad(sun_deg);
  scene.noise_grey = 1.0;
  scene.crosstalk = 0.08;
  scene.exposure = 120.0;
  scene.rays = 3;
  PaintedPair pair = Paint(scene);
  pair.left = Blurred(pair.left);
  pair.right = Blurred(pair.right);
  return pair;
}

// What the cylinder is told to be 4 % narrower than has rims that are wrong by a pixel: boundaries
// may be, too.
TEST(RobustFinderTest, AWallTooWideForItsRadiusIsLessSure) {
  const PaintedPair pair = Paint(SceneAt(4.5, DegToRad(20.0)));
  ColourCylinder narrow;
  narrow.diameter_m *= 0.96;
  RobustFinderParams params;
  // That pixels fit worse, and that colours mix at wrong edges, is not what is tested.
  params.fit.usual_misfit = 10.0;
  params.fit.largest_colour_misfit = 100.0;
  const CylinderFinding right = FindCylinder(pair.Pair(), {}, params);
  const CylinderFinding wrong = FindCylinder(pair.Pair(), narrow, params);
  ASSERT_TRUE(right.sighting && wrong.sighting) << right.reason << wrong.reason;
  const double sd_px = std::sqrt(wrong.sighting->covariance(3, 3)) / CoarsestTurn(41.7);
  EXPECT_GT(sd_px, 0.65);
  EXPECT_LT(sd_px, std::hypot(0.35, 0.5 * 41.7 * 0.04) + 0.15);
  EXPECT_LT(right.sighting->covariance(3, 3), 0.4 * wrong.sighting->covariance(3, 3));
}

TEST(RobustFinderTest, PixelsThatFitWorseThanUsuallyAreLessSure) {
  const PaintedPair pair = Paint(OutdoorsAt(4.5, DegToRad(20.0), 1));
  const auto sd_rad = [&](double usual_misfit) {
    RobustFinderParams params;
    params.fit.usual_misfit = usual_misfit;
    const CylinderFinding finding = Find(pair, params);
    EXPECT_TRUE(finding.sighting) << finding.reason;
    return finding.sighting ? std::sqrt(finding.sighting->covariance(3, 3)) : 0.0;
  };
  EXPECT_GT(sd_rad(0.02), 3.0 * sd_rad(8.0));
  EXPECT_EQ(sd_rad(4.0), sd_rad(8.0));  // both beyond what it is
}

// Where the light of the sun ends on the wall, no quadrant ends.
TEST(RobustFinderTest, ATerminatorIsNoBoundary) {
  // Control: a finder to which a darker column, or side of a quadrant, is another colour.
  RobustFinderParams bright;
  bright.fit.brightness_sd = 0.0;
  bright.fit.shading_sd = bright.fit.tint_sd;
  for (const SideLight& view :
       {SideLight{-134, -80}, SideLight{-94, -80}, SideLight{-134, 80}, SideLight{-74, 80}}) {
    SCOPED_TRACE(testing::Message() << view.theta_deg << ", sun " << view.sun_deg);
    const PaintedScene scene = SceneAt(8.0, DegToRad(view.theta_deg));
    const PaintedPair pair = PaintSideLit(scene, view.sun_deg);
    ExpectFound(Find(pair), scene, 0.3, 3.0);
    EXPECT_TRUE(IsMissedOrTurned(Find(pair, bright), scene, 5.0));
  }
}

// The sun's light makes one side of a quadrant brighter than the other, and leaves its colour.
TEST(RobustFinderTest, AQuadrantMayBeBrighterAtASide) {
  // Control: a finder that expects brightness to change as little as colour.
  RobustFinderParams even;
  even.fit.shading_sd = even.fit.tint_sd;
  double error_rad = 0.0, of_even_rad = 0.0;
  const std::array<double, 6> thetas_deg = {-160.0, -120.0, -100.0, 20.0, 60.0, 110.0};
  for (const double theta_deg : thetas_deg) {
    const double theta_rad = DegToRad(theta_deg);
    const PaintedPair pair = PaintSideLit(SceneAt(10.0, theta_rad), 80.0);
    const CylinderFinding finding = Find(pair);
    const CylinderFinding of_even = Find(pair, even);
    ASSERT_TRUE(finding.sighting && of_even.sighting) << theta_deg;
    error_rad += std::abs(math::WrapAngle(finding.sighting->orientation_rad - theta_rad));
    of_even_rad += std::abs(math::WrapAngle(of_even.sighting->orientation_rad - theta_rad));
  }
  EXPECT_LT(RadToDeg(error_rad), 1.5 * thetas_deg.size());
  EXPECT_GT(RadToDeg(of_even_rad), 2.5 * thetas_deg.size());
}

// Strips as narrow as their blur.
TEST(RobustFinderTest, BlurIsFoundByTheFit) {
  // Control: a blur that is taken for half of what it is.
  RobustFinderParams sharp;
  sharp.fit.edge_blur_px = 0.5;
  sharp.fit.edge_blur_spread = 0.01;
  for (const SideLight& view : {SideLight{66, -80}, SideLight{106, -80}, SideLight{-64, 80}}) {
    SCOPED_TRACE(testing::Message() << view.theta_deg << ", sun " << view.sun_deg);
    const PaintedScene scene = SceneAt(11.0, DegToRad(view.theta_deg));
    const PaintedPair pair = PaintSideLit(scene, view.sun_deg);
    ExpectFound(Find(pair), scene, 0.6, 5.0);
    EXPECT_TRUE(IsMissedOrTurned(Find(pair, sharp), scene, 5.0));
  }
}

// What fits a cylinder only if its edges are nowhere: no camera blurs so.
TEST(RobustFinderTest, ABlurThatNoCameraHasIsNoCylinder) {
  PaintedPair pair = Paint(SceneAt(6.0, DegToRad(30.0)));
  for (int blurs = 1; blurs <= 9; ++blurs) {
    pair.left = Blurred(pair.left);
    pair.right = Blurred(pair.right);
    // Control: two of them are between what is expected.
    if (blurs == 2) {
      EXPECT_TRUE(Find(pair).sighting) << Find(pair).reason;
    }
  }
  ExpectMiss(Find(pair), CylinderMiss::kNotACylinder, "its edges are blurred by");
}

TEST(RobustFinderTest, GreenInPlaceOfOrangeIsASetting) {
  PaintedScene scene = SceneAt(6.0, DegToRad(-135.0));
  scene.quadrants[2] = {0.15, 0.80, 0.25};
  EXPECT_FALSE(Find(Paint(scene)).sighting);
  RobustFinderParams green;
  green.surfaces.third = kGreenSurface;
  const CylinderFinding finding = Find(Paint(scene), green);
  ASSERT_TRUE(finding.sighting) << finding.reason;
  EXPECT_NEAR(RadToDeg(finding.sighting->orientation_rad), -135.0, 2.0);
}

TEST(RobustFinderTest, RegionsAreThoseOfTheQuadrants) {
  const CylinderFinding finding = Find(Paint(SceneAt(2.0, DegToRad(-30.0))));
  ASSERT_TRUE(finding.sighting);
  const auto& regions = finding.sighting->regions[0];
  ASSERT_EQ(regions.size(), 4U);
  EXPECT_EQ(regions[1].colour, CylinderColour::kRed);
  EXPECT_EQ(regions[2].colour, CylinderColour::kMagenta);
  EXPECT_EQ(regions[3].colour, CylinderColour::kBlue);
  EXPECT_LE(regions[1].right, regions[2].left);
  EXPECT_GT(regions[2].Width(), regions[1].Width());
}

TEST(RobustFinderTest, NothingInViewIsNothing) {
  PaintedScene scene = OutdoorsAt(2.0, 0.0, 3);
  scene.cylinders.clear();
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kNothing, "");
}

TEST(RobustFinderTest, AClippedCylinderIsClipped) {
  PaintedScene scene = SceneAt(2.0, 0.3);
  scene.cylinders.front().p_LT_L.y() = 0.45;
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kClipped, "left image");
  scene.cylinders.front().p_LT_L.y() = -0.57;
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kClipped, "border");
}

TEST(RobustFinderTest, SwappedEyesAreSaidSo) {
  const PaintedPair pair = Paint(SceneAt(2.0, 0.5));
  ExpectMiss(FindCylinder(pair.Swapped(), {}, {}), CylinderMiss::kSwappedEyes, "swapped");
}

TEST(RobustFinderTest, TwoCylindersAreTold) {
  PaintedScene scene = SceneAt(3.0, 0.5);
  scene.cylinders.push_back(scene.cylinders.front());
  scene.cylinders[0].p_LT_L.y() = 0.3;
  scene.cylinders[1].p_LT_L.y() = -0.3;
  scene.cylinders[1].orientation_rad = 2.0;
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kTwoCylinders, "two places");
}

TEST(RobustFinderTest, OneInEachEyeIsUnlike) {
  PaintedPair pair = Paint(SceneAt(2.0, 0.5));
  pair.right = Paint(SceneAt(5.0, 0.5)).right;
  ExpectMiss(Find(pair), CylinderMiss::kUnlikeEyes, "");
}

// A quadrant that is yellower to one eye than to the other: each is as orange as orange may be.
TEST(RobustFinderTest, EyesThatSeeOtherColoursSeeOtherThings) {
  const auto painted = [](double green) {
    PaintedScene scene = SceneAt(4.5, DegToRad(-100.0));
    scene.quadrants[2] = {1.0, green, 0.1};
    return Paint(scene);
  };
  const PaintedPair yellower = painted(0.42);
  const PaintedPair redder = painted(0.28);
  PaintedPair unlike = yellower;
  unlike.right = redder.right;
  EXPECT_TRUE(Find(yellower).sighting) << Find(yellower).reason;
  EXPECT_TRUE(Find(redder).sighting) << Find(redder).reason;
  ExpectMiss(Find(unlike), CylinderMiss::kNotACylinder, "the colours side by side");
}

// The same picture of a thing of another size.
TEST(RobustFinderTest, ALargerCylinderFartherAwayIsNone) {
  PaintedScene scene = SceneAt(3.0, 0.5);
  scene.cylinders.front().size = {0.25, 0.13};
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kNotACylinder, "");
  scene.cylinders.front().size = {0.192, 0.17};
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kNotACylinder, "high");
}

TEST(RobustFinderTest, OtherColoursSideBySideAreNone) {
  PaintedScene scene = SceneAt(3.0, DegToRad(45.0));
  // Blue between orange and orange.
  scene.quadrants[1] = scene.quadrants[2];
  scene.quadrants[3] = scene.quadrants[2];
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kNotACylinder, "colours");
}

// Nobody knows where pink alone looks.
TEST(RobustFinderTest, PinkAloneIsNone) {
  PaintedScene scene = SceneAt(3.0, 0.0);
  for (PaintColour& quadrant : scene.quadrants) quadrant = {0.95, 0.25, 0.60};
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kNothing, "two of the colours");
}

}  // namespace
}  // namespace rockyard::vision
