// Pictures of the cylinder against the geometry of Matthies 1995, appendix A.

#include "rendering/cylinder/cylinder_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_params.h"
#include "rendering/cylinder/cylinder_scene.h"
#include "vision/each_pixel.h"

namespace rockyard::rendering {
namespace {

// Pure colours (blue wall in the blue channel, pink in the red one, the third in the green one) in
// even light before black ground: a channel's sum over a line is what is seen of that colour.
CylinderPictureParams PureColours() {
  return {.target = {.blue = {0.0, 0.0, 1.0}, .pink = {1.0, 0.0, 0.0}, .orange = {0.0, 1.0, 0.0}},
          .light = {.sun = {0.0, 0.0, 0.0}, .sky = {1.0, 1.0, 1.0}},
          .backdrop = {.ground = {0.0, 0.0, 0.0}, .contrast = 0.0, .hue_contrast = 0.0},
          .edge_samples = 16};
}

CylinderView ViewAt(double distance_m, double orientation_deg, double bearing_deg = 0.0) {
  return {distance_m, math::DegToRad(bearing_deg), math::DegToRad(orientation_deg), true};
}

constexpr core::TrialKey kKey{7, 3};

// What is seen of red, green and blue along the line through the cylinder's middle, px.
Colour SeenWidths(const CylinderPictureParams& params, const ColourPlanes& planes) {
  const int row = planes[0].height() / 2;
  Colour sum = Colour::Zero();
  for (int column = 0; column < planes[0].width(); ++column) sum += PixelOf(planes, column, row);
  const ColourLight light(params.light, ToColour(params.backdrop.ground));
  return sum / light.On(math::Vector3::UnitX());
}

double FocalOf(const ColourCameraParams& camera) {
  return 0.5 * static_cast<double>(camera.columns) / std::tan(0.5 * camera.field_of_view_rad);
}

// Equations 5 to 8 over rho for theta in any quadrant: pink, third, blue.
Colour Orthographic(double theta) {
  Colour seen = Colour::Zero();
  // Of the quadrant between azimuths a and a + 90 deg the part before the viewer spans the sines of
  // its ends about theta.
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    constexpr double kHalf = 0.5 * std::numbers::pi;
    double from = std::remainder(quadrant * kHalf - theta, 2.0 * std::numbers::pi);
    double to = from + kHalf;
    if (from < -kHalf) from = -kHalf;
    if (to > kHalf) to = kHalf;
    // A quadrant that comes round from behind.
    double wide = to > from ? std::sin(to) - std::sin(from) : 0.0;
    const double behind = std::remainder(quadrant * kHalf - theta, 2.0 * std::numbers::pi) + kHalf;
    if (behind > 1.5 * std::numbers::pi) wide += std::sin(behind) + 1.0;
    const int channel = quadrant == 0 ? 2 : (quadrant == 2 ? 1 : 0);
    seen[channel] += wide;
  }
  return seen;
}

TEST(CylinderPicture, QuadrantsAreAsWideAsEquationsFiveToEightSay) {
  const CylinderPictureParams params = PureColours();
  const double focal_px = FocalOf(params.cameras);
  constexpr double kDistance_m = 8.0;
  const double depth_m = kDistance_m - params.cameras.front_m;
  const double radius_px = focal_px * 0.096 / depth_m;
  for (int theta = -180; theta < 180; theta += 15) {
    const auto images = RenderCylinder(params, ViewAt(kDistance_m, theta), kKey);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      // The left camera sees the cylinder from further clockwise, from above: it stands at +y.
      const double aside = (eye == 0 ? -0.5 : 0.5) * params.cameras.baseline_m / depth_m;
      const Colour expected = radius_px * Orthographic(math::DegToRad(theta) + aside);
      const Colour seen = SeenWidths(params, images[eye]);
      // Rays: 1/32 px an edge; perspective: rho / d of the widths.
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], expected[i], 0.25) << theta << " " << eye;
      EXPECT_NEAR(seen.sum(), 2.0 * radius_px, 0.1);
    }
  }
}

TEST(CylinderPicture, FirstQuadrantHasTheTextsFormulas) {
  const double theta = math::DegToRad(25.0);
  const Colour seen = Orthographic(theta);
  EXPECT_NEAR(seen[2], std::sin(theta) + std::cos(theta), 1e-12);                  // A, eq. 5
  EXPECT_NEAR(seen[0], (1.0 - std::cos(theta)) + (1.0 - std::sin(theta)), 1e-12);  // B + D
  EXPECT_NEAR(seen[1], 0.0, 1e-12);                                                // C, eq. 7
}

TEST(CylinderPicture, PinkIsOnTheSidesThatTheAppendixTells) {
  const CylinderPictureParams params = PureColours();
  const auto images = RenderCylinder(params, ViewAt(2.0, 70.0), kKey);
  // At theta = 70 deg the wide pink B = rho (1 - cos 70) is to the right of blue.
  const int row = static_cast<int>(params.cameras.rows) / 2;
  double right = 0.0, left = 0.0;
  bool past_blue = false;
  for (int column = 0; column < images[0][0].width(); ++column) {
    if (images[0][2].At(column, row) > 0.01F) past_blue = true;
    (past_blue ? right : left) += images[0][0].At(column, row);
  }
  EXPECT_GT(right, 5.0 * left);
  EXPECT_GT(left, 0.0);
}

TEST(CylinderPicture, NearCylindersAreWiderByEquationSixteen) {
  const CylinderPictureParams params = PureColours();
  for (const double distance_m : {0.914, 1.829, 4.572}) {
    const double d = distance_m - params.cameras.front_m;
    const auto images = RenderCylinder(params, ViewAt(distance_m, 45.0), kKey);
    const double m = SeenWidths(params, images[0]).sum();
    // d = M rho / (m tan) + rho^2 / d; the eye is half a baseline aside, which adds its square.
    const double by_size = FocalOf(params.cameras) * 2.0 * 0.096 / m + 0.096 * 0.096 / d;
    EXPECT_NEAR(by_size / d, 1.0, 0.006) << distance_m;
    EXPECT_GT(std::abs(by_size - 0.096 * 0.096 / d - d), 0.8 * 0.096 * 0.096 / d - 0.003 * d);
  }
}

double CentroidOf(const ColourPlanes& planes) {
  const int row = planes[0].height() / 2;
  double sum = 0.0, moment = 0.0;
  for (int column = 0; column < planes[0].width(); ++column) {
    const double light = PixelOf(planes, column, row).sum();
    sum += light;
    moment += light * column;
  }
  return moment / sum;
}

TEST(CylinderPicture, DisparityIsThatOfEquationSeventeen) {
  const CylinderPictureParams params = PureColours();
  for (const double distance_m : {2.0, 5.0, 12.0}) {
    const auto images = RenderCylinder(params, ViewAt(distance_m, 20.0), kKey);
    const double disparity_px = CentroidOf(images[0]) - CentroidOf(images[1]);
    const double expected_px =
        FocalOf(params.cameras) * params.cameras.baseline_m / (distance_m - params.cameras.front_m);
    EXPECT_NEAR(disparity_px, expected_px, 0.04 + 0.004 * expected_px) << distance_m;
  }
}

// The scene seen in a mirror that holds the line of sight: left and right eye change places, the
// sun's azimuth its sign, and theta becomes 90 deg - theta, as both side quadrants are pink.
TEST(CylinderPicture, MirroredLightGivesTheMirroredPicture) {
  CylinderPictureParams params{
      .light = {.azimuth_rad = math::DegToRad(110.0)},
      .backdrop = {.contrast = 0.0, .hue_contrast = 0.0, .horizon_relief_m = 0.0}};
  // The upper half: the turntable's corners turn with the cylinder.
  const auto images = RenderCylinder(params, ViewAt(3.0, 25.0), kKey);
  params.light.azimuth_rad = -params.light.azimuth_rad;
  const auto mirrored = RenderCylinder(params, ViewAt(3.0, 65.0), kKey);
  const int columns = images[0][0].width();
  vision::ForEachPixel(columns, 240, [&](int column, int row) {
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_NEAR(images[0][i].At(column, row), mirrored[1][i].At(columns - 1 - column, row), 2e-3);
    }
  });
  params.light.azimuth_rad = -params.light.azimuth_rad;
  const auto same_light = RenderCylinder(params, ViewAt(3.0, 65.0), kKey);
  float most = 0.0F;
  for (int column = 0; column < columns; ++column) {
    most = std::max(most, std::abs(images[0][2].At(column, 235) -
                                   same_light[1][2].At(columns - 1 - column, 235)));
  }
  EXPECT_GT(most, 0.05F);  // the control: unlike light is unlike
}

TEST(CylinderPicture, WallsAreShadedByLambertsLaw) {
  CylinderPictureParams params;
  params.light.azimuth_rad = math::DegToRad(100.0);
  const CylinderView view = ViewAt(2.0, 45.0);
  const auto cameras = CylinderCameras(params, view);
  const auto images = RenderCylinder(params, view, kKey);
  const ColourLight light(params.light, ToColour(params.backdrop.ground));
  const math::Vector3 middle_L = CylinderPose(params, view).translation();
  // Away from where the sun grazes the wall, so that a half pixel changes little.
  for (const double turn_deg : {-30.0, 15.0, 25.0, 35.0}) {
    // A point of the blue wall, whose normal points that far off the cameras.
    const double azimuth = std::numbers::pi - math::DegToRad(turn_deg);
    const math::Vector3 normal(std::cos(azimuth), std::sin(azimuth), 0.0);
    const auto pixel = vision::Project(cameras[0], math::Vector3(middle_L + 0.096 * normal));
    ASSERT_TRUE(pixel.has_value());
    const Colour seen = PixelOf(images[0], static_cast<int>(std::lround(pixel->x())),
                                static_cast<int>(std::lround(pixel->y())));
    const Colour expected = ToColour(params.target.blue) * light.On(normal);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(seen[i] / expected[i], 1.0, 0.02) << turn_deg;
  }
}

TEST(CylinderPicture, SurroundingsStayWhereTheCylinderTurnsOrGoes) {
  CylinderPictureParams params{.clutter = {.rocks = 10.0, .hardware = 2.0}};
  const auto first = RenderCylinder(params, ViewAt(5.0, 0.0), kKey);
  const auto again = RenderCylinder(params, ViewAt(5.0, 0.0), kKey);
  const auto turned = RenderCylinder(params, ViewAt(5.0, 120.0), kKey);
  CylinderView without = ViewAt(5.0, 0.0);
  without.present = false;
  const auto alone = RenderCylinder(params, without, kKey);
  const auto other = RenderCylinder(params, ViewAt(5.0, 0.0), {7, 4});
  EXPECT_EQ(first, again);
  int unlike = 0, other_unlike = 0;
  for (int row = 0; row < 480; ++row) {
    for (int column = 0; column < 180; ++column) {  // the cylinder is right of it
      EXPECT_EQ(first[0][0].At(column, row), turned[0][0].At(column, row));
      if (first[0][0].At(column, row) != alone[0][0].At(column, row)) ++unlike;
      if (first[0][0].At(column, row) != other[0][0].At(column, row)) ++other_unlike;
    }
  }
  EXPECT_EQ(unlike, 0);
  EXPECT_GT(other_unlike, 10000);
  EXPECT_NE(first[0][0], alone[0][0]);
}

TEST(CylinderPicture, HorizonIsWhereItsElevationPutsIt) {
  CylinderPictureParams params;
  params.backdrop.ground = {0.0, 0.0, 0.0};
  params.backdrop.horizon_relief_m = 0.0;
  params.backdrop.horizon_elevation_rad = math::DegToRad(5.0);
  CylinderView view = ViewAt(5.0, 0.0);
  view.present = false;
  const auto images = RenderCylinder(params, view, kKey);
  const ColourLight light(params.light, Colour::Zero());
  double sky_rows = 0.0;
  for (int row = 0; row < 480; ++row) sky_rows += images[1][0].At(100, row) / light.sky()[0];
  const double height_m = 60.0 * std::tan(math::DegToRad(5.0));
  const double row = 239.5 - FocalOf(params.cameras) * (height_m - 1.0) / (60.0 - 0.076);
  EXPECT_NEAR(sky_rows, row + 0.5, 0.02);
}

TEST(CylinderPicture, GroundIsMottledAsMuchAsAskedForAndAlikeForBothEyes) {
  CylinderPictureParams params;
  params.backdrop.hue_contrast = 0.0;
  CylinderView view = ViewAt(5.0, 0.0);
  view.present = false;
  double variance = 0.0;
  constexpr int kScenes = 12;
  for (std::uint32_t scene = 0; scene < kScenes; ++scene) {
    const auto images = RenderCylinder(params, view, {1, scene});
    // Hills: pixels are square there.
    double sum = 0.0, squares = 0.0;
    for (int row = 20; row < 200; ++row) {
      for (int column = 0; column < 512; ++column) {
        const double light = images[0][1].At(column, row);
        sum += light;
        squares += light * light;
      }
    }
    constexpr double kPixels = 180.0 * 512.0;
    const double mean = sum / kPixels;
    variance += (squares / kPixels / (mean * mean) - 1.0) / kScenes;
    // 12 cm at 60 m are 1.96 px.
    for (int column = 100; column < 110; ++column) {
      const double right =
          0.96 * images[1][1].At(column - 2, 100) + 0.04 * images[1][1].At(column - 1, 100);
      EXPECT_NEAR(images[0][1].At(column, 100) / right, 1.0, 0.08);
    }
  }
  EXPECT_NEAR(std::sqrt(variance), 0.15, 0.03);
}

}  // namespace
}  // namespace rockyard::rendering
