// Rays and bodies of the coloured cylinder, and counts of the colour camera, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_scene.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// Rays and bodies against closed forms.

BodyCaster Body(BodyShape shape, const Vector3& half, double heading_rad = 0.0) {
  return BodyCaster({shape, {5.0, 0.0, 0.0}, half, heading_rad, {}});
}

TEST(ColouredBody, SphereIsMetAtItsNearSide) {
  const BodyCaster sphere = Body(BodyShape::kEllipsoid, {1.0, 1.0, 1.0});
  const auto hit = sphere.Cast({Vector3::Zero(), {2.0, 0.0, 0.0}});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->along, 2.0, 1e-12);
  EXPECT_NEAR((hit->normal + Vector3::UnitX()).norm(), 0.0, 1e-12);
  EXPECT_FALSE(sphere.Cast({Vector3::Zero(), -Vector3::UnitX()}).has_value());
  EXPECT_FALSE(sphere.Cast({{0.0, 1.001, 0.0}, Vector3::UnitX()}).has_value());
  EXPECT_TRUE(sphere.Cast({{0.0, 0.999, 0.0}, Vector3::UnitX()}).has_value());
}

TEST(ColouredBody, EllipsoidTurnsWithItsHeading) {
  const BodyCaster body = Body(BodyShape::kEllipsoid, {2.0, 1.0, 0.5}, 0.5 * std::numbers::pi);
  EXPECT_NEAR(body.Cast({Vector3::Zero(), Vector3::UnitX()})->along, 4.0, 1e-9);
  EXPECT_NEAR(body.Cast({{5.0, 9.0, 0.0}, -Vector3::UnitY()})->along, 7.0, 1e-9);
}

TEST(ColouredBody, BoxShowsTheFaceThatTheRayEntersBy) {
  const BodyCaster box = Body(BodyShape::kBox, {1.0, 2.0, 0.5});
  const auto front = box.Cast({Vector3::Zero(), Vector3::UnitX()});
  ASSERT_TRUE(front.has_value());
  EXPECT_EQ(front->part, 0);
  EXPECT_NEAR(front->along, 4.0, 1e-12);
  EXPECT_NEAR((front->normal + Vector3::UnitX()).norm(), 0.0, 1e-12);
  const auto top = box.Cast({{5.0, 0.0, 3.0}, -Vector3::UnitZ()});
  ASSERT_TRUE(top.has_value());
  EXPECT_EQ(top->part, 5);
  EXPECT_NEAR(top->along, 2.5, 1e-12);
  EXPECT_FALSE(box.Cast({{0.0, 2.01, 0.0}, Vector3::UnitX()}).has_value());
  EXPECT_FALSE(box.Cast({Vector3::Zero(), {1.0, 1.0, 0.0}}).has_value());
}

TEST(ColouredBody, QuadrantsOfTheCylinderGoCounterClockwise) {
  const BodyCaster cylinder = Body(BodyShape::kCylinder, {0.5, 0.5, 1.0}, 0.3);
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    for (const double within_deg : {5.0, 45.0, 85.0}) {
      const double azimuth = 0.3 + math::DegToRad(90.0 * quadrant + within_deg);
      const Vector3 outward(std::cos(azimuth), std::sin(azimuth), 0.0);
      const auto hit = cylinder.Cast({Vector3(5.0, 0.0, 0.2) + 3.0 * outward, -outward});
      ASSERT_TRUE(hit.has_value());
      EXPECT_EQ(hit->part, quadrant);
      EXPECT_NEAR(hit->along, 2.5, 1e-9);
      EXPECT_NEAR((hit->normal - outward).norm(), 0.0, 1e-9);
    }
  }
}

TEST(ColouredBody, TopOfTheCylinderIsSeenFromAboveAlone) {
  const BodyCaster cylinder = Body(BodyShape::kCylinder, {0.5, 0.5, 1.0});
  const auto top = cylinder.Cast({{0.0, 0.0, 3.0}, {5.0, 0.0, -2.0}});
  ASSERT_TRUE(top.has_value());
  EXPECT_EQ(top->part, 4);
  EXPECT_NEAR(top->along, 1.0, 1e-12);
  EXPECT_FALSE(cylinder.Cast({{0.0, 0.0, -3.0}, {5.0, 0.0, 2.0}}).has_value());
  EXPECT_FALSE(cylinder.Cast({{0.0, 0.0, 1.01}, Vector3::UnitX()}).has_value());
  EXPECT_TRUE(cylinder.Cast({{0.0, 0.0, 0.99}, Vector3::UnitX()}).has_value());
}

// Counts of the colour camera against closed forms.

constexpr core::TrialKey kKey{5, 9};
const Colour kGround(0.45, 0.27, 0.16);

ColourPlanes Even(const Colour& light, int columns = 64, int rows = 64) {
  ColourPlanes planes = MakePlanes(columns, rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) SetPixel(planes, column, row, light);
  }
  return planes;
}

ColourCameraParams Quiet() { return {.full_well_e = 1e12, .read_noise_counts = 0.0}; }

// Without dust all light comes from the sun and, by the ground, from below.
TEST(ColourLight, SunSkyAndGroundAreThoseOfClosedForms) {
  const CylinderLightParams clear{.elevation_rad = math::DegToRad(30.0),
                                  .azimuth_rad = math::DegToRad(90.0),
                                  .optical_depth = 0.0,
                                  .sun = {1.0, 0.5, 0.25}};
  const ColourLight light(clear, kGround);
  const math::Vector3 up = math::Vector3::UnitZ();
  EXPECT_NEAR((light.toward_sun_L() - math::Vector3(0.0, std::sqrt(0.75), 0.5)).norm(), 0.0, 1e-12);
  // Level: sin 30 deg of the beam. Below: what the ground sends back of it. Away from the sun, on
  // a wall: half of that.
  const double beam = light.On(math::Vector3::UnitY())[0] - 0.5 * light.On(-up)[0];
  EXPECT_NEAR(light.On(up)[0], beam * 0.5 / std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(light.On(up)[1] / light.On(up)[0], 0.5, 1e-12);
  EXPECT_NEAR(light.On(-up)[0], kGround[0] * light.On(up)[0], 1e-12);
  EXPECT_NEAR(light.On(-math::Vector3::UnitY())[2], 0.5 * kGround[2] * light.On(up)[2], 1e-12);
  CylinderLightParams dusty = clear;
  dusty.optical_depth = 2.0;
  const ColourLight haze(dusty, Colour::Zero());
  EXPECT_NEAR((haze.On(up) - haze.sky()).maxCoeff() / light.On(up)[0], std::exp(-4.0), 1e-9);
  EXPECT_NEAR(haze.On(-math::Vector3::UnitY())[0], 0.5 * haze.sky()[0], 1e-12);
}

TEST(ColourReadout, WhiteIsGreyAtTheElevationOfTheBalanceAlone) {
  ColourCameraParams camera = Quiet();
  CylinderLightParams light{.elevation_rad = camera.balance_elevation_rad};
  const ColourReadout readout(camera, light, kGround);
  const Colour white = readout.CountsOf(ColourLight(light, kGround).On(math::Vector3::UnitZ()));
  EXPECT_NEAR(white[0], white[1], 1e-9 * white[0]);
  EXPECT_NEAR(white[0], white[2], 1e-9 * white[0]);
  light.elevation_rad = math::DegToRad(10.0);
  const ColourReadout low(camera, light, kGround);
  const Colour redder = low.CountsOf(ColourLight(light, kGround).On(math::Vector3::UnitZ()));
  EXPECT_GT(redder[0], 1.05 * redder[2]);
}

TEST(ColourReadout, LevelGroundHasTheCountOfTheExposure) {
  const ColourCameraParams camera = Quiet();
  for (const double elevation_deg : {10.0, 60.0}) {
    const CylinderLightParams light{.elevation_rad = math::DegToRad(elevation_deg)};
    const ColourReadout readout(camera, light, kGround);
    const Colour up = ColourLight(light, kGround).On(math::Vector3::UnitZ());
    EXPECT_NEAR(readout.CountsOf(kGround * up).maxCoeff(), 0.35 * 255.0, 1e-9);
  }
}

TEST(ColourReadout, CrosstalkMixesNeighboursInTheSpectrum) {
  ColourCameraParams camera = Quiet();
  camera.crosstalk = 0.2;
  CylinderLightParams light;
  light.sun = light.sky = {1.0, 1.0, 1.0};
  const Colour grey(0.4, 0.4, 0.4);
  const ColourReadout readout(camera, light, grey);
  const double gain = readout.CountsOf({1.0, 1.0, 1.0})[0];
  const Colour green = readout.CountsOf({0.0, 1.0, 0.0}) / gain;
  const Colour red = readout.CountsOf({1.0, 0.0, 0.0}) / gain;
  EXPECT_NEAR(green[0], 0.2, 1e-9);
  EXPECT_NEAR(green[1], 0.8, 1e-9);
  EXPECT_NEAR(green[2], 0.2, 1e-9);
  EXPECT_NEAR(red[0], 0.8, 1e-9);
  EXPECT_NEAR(red[1], 0.1, 1e-9);
  EXPECT_NEAR(red[2], 0.0, 1e-9);
}

TEST(ColourReadout, EvenLightStaysEvenAndPlanesAgreeWithPoints) {
  const ColourReadout readout(Quiet(), {}, kGround);
  const Colour light(0.3, 0.2, 0.1);
  const ColourPlanes counts = readout.Counts(Even(light));
  const Colour expected = readout.CountsOf(light);
  const vision::ColourImage image = readout.Read(counts, kKey, 0);
  for (int at : {0, 17, 63}) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(PixelOf(counts, at, 63 - at)[i], expected[i], 1e-3);
    EXPECT_EQ(image.At(at, at).red, static_cast<int>(std::lround(expected[0])));
    EXPECT_EQ(image.At(at, at).blue, static_cast<int>(std::lround(expected[2])));
  }
}

// A line of light across the columns spreads with the variance of both blurs; of grey light with
// that of the first alone.
TEST(ColourReadout, ColoursAreBlurredMoreThanBrightness) {
  ColourCameraParams camera = Quiet();
  camera.crosstalk = 0.0;
  CylinderLightParams light;
  light.sun = light.sky = {1.0, 1.0, 1.0};
  const ColourReadout readout(camera, light, {0.4, 0.4, 0.4});
  const auto spread = [&](const Colour& colour, std::size_t channel) {
    ColourPlanes planes = MakePlanes(64, 8);
    for (int row = 0; row < 8; ++row) SetPixel(planes, 30, row, colour);
    const ColourPlanes counts = readout.Counts(planes);
    double sum = 0.0, squares = 0.0;
    for (int column = 0; column < 64; ++column) {
      const double value = counts[channel].At(column, 4);
      sum += value;
      squares += value * (column - 30) * (column - 30);
    }
    return squares / sum;
  };
  EXPECT_NEAR(spread({1.0, 1.0, 1.0}, 0), 0.25, 1e-4);
  // Blue alone: brightness has 0.114 of it, the rest is blurred by 1 px more.
  EXPECT_NEAR(spread({0.0, 0.0, 1.0}, 2), 0.25 + 0.886 * 0.98, 0.03);
}

TEST(ColourReadout, NoiseHasTheVarianceOfReadAndShotNoise) {
  const ColourCameraParams camera{.full_well_e = 5000.0, .read_noise_counts = 2.0};
  const ColourReadout readout(camera, {}, kGround);
  const ColourPlanes counts = Even({100.25, 50.25, 150.25}, 256, 256);
  const vision::ColourImage first = readout.Read(counts, kKey, 0);
  const vision::ColourImage second = readout.Read(counts, kKey, 1);
  EXPECT_EQ(first, readout.Read(counts, kKey, 0));
  double squares = 0.0, product = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < first.values().size(); ++i) {
    const double a = first.values()[i].red - 100.25;
    sum += a;
    squares += a * a;
    product += a * (second.values()[i].red - 100.25);
  }
  const double pixels = 256.0 * 256.0;
  // Read 4, shot n N / W, rounding 1/12; 65536 samples know it to 0.6 %.
  EXPECT_NEAR(squares / pixels, 4.0 + 100.25 * 255.0 / 5000.0 + 1.0 / 12.0, 0.2);
  EXPECT_NEAR(sum / pixels, 0.0, 0.05);
  EXPECT_NEAR(product / pixels, 0.0, 0.15);
}

TEST(ColourReadout, CountsEndAtTheLargestAndGammaBendsThem) {
  ColourCameraParams camera = Quiet();
  const ColourPlanes counts = Even({300.0, 64.0, -5.0});
  const auto plain = ColourReadout(camera, {}, kGround).Read(counts, kKey, 0).At(3, 3);
  EXPECT_EQ(plain, (vision::Rgb{255, 64, 0}));
  camera.gamma = 0.5;
  const auto bent = ColourReadout(camera, {}, kGround).Read(counts, kKey, 0).At(3, 3);
  EXPECT_EQ(bent, (vision::Rgb{255, 128, 0}));
}

}  // namespace
}  // namespace rockyard::rendering
