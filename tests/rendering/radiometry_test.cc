// Light against closed forms.
#include "rendering/radiometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "rendering/line_kit.h"
#include "rendering/row_renderer.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

constexpr double kPi = std::numbers::pi;

TEST(SunLight, FollowsBeerAndLambert) {
  const SunParams sun{.elevation_rad = math::DegToRad(30.0),
                      .azimuth_rad = math::DegToRad(180.0),
                      .irradiance_w_m2_nm = 1.2,
                      .distance_au = 2.0,
                      .optical_depth = 0.4,
                      .diffuse_share = 0.5};
  const SunLight light = MakeSunLight(sun, 20e-9);
  // 1.2 / 4 W/m2/nm over 20 nm; the path is 1 / sin 30 = 2 atmospheres long.
  const double direct = 6.0 * std::exp(-0.8);
  EXPECT_NEAR(light.direct_w_m2, direct, 1e-12);
  EXPECT_NEAR(light.sky_w_m2, 0.5 * (6.0 - direct) * 0.5, 1e-12);
  EXPECT_NEAR(light.toward_sun_W.x(), -std::cos(math::DegToRad(30.0)), 1e-12);
  EXPECT_NEAR(light.toward_sun_W.z(), 0.5, 1e-12);

  // A wall that faces the sun sees half of the sky; one that faces away no sun at all.
  const double facing = SunRadiance(light, 0.4, -Vector3::UnitX(), true);
  EXPECT_NEAR(facing, 0.4 / kPi * (direct * std::cos(math::DegToRad(30.0)) + 0.5 * light.sky_w_m2),
              1e-12);
  EXPECT_NEAR(SunRadiance(light, 0.4, Vector3::UnitX(), true), 0.4 / kPi * 0.5 * light.sky_w_m2,
              1e-12);
}

TEST(SunLight, IsNoneAtTheHorizon) {
  const SunParams sun{.elevation_rad = 0.0};
  const SunLight light = MakeSunLight(sun, 20e-9);
  EXPECT_EQ(light.direct_w_m2, 0.0);
  EXPECT_EQ(light.sky_w_m2, 0.0);
}

TEST(SunParams, BadDescriptionsAreRefused) {
  SunParams sun;
  EXPECT_THROW(core::ReadParams(core::ParseJson(R"({"elevation_deg": 95})", "test"), sun),
               core::UserError);
  EXPECT_THROW(core::ReadParams(core::ParseJson(R"({"distance_au": 0})", "test"), sun),
               core::UserError);
}

// Off the axis an equidistant_rows pixel covers cos(a) of the solid angle, and the pupil appears
// cos(theta) = cos(a) cos(b) as large; a pinhole has cos^4.
TEST(Radiometry, LightFallsOffTowardsTheEdge) {
  messages::Camera camera{.column_pitch_rad = 0.0089 / 768 / 0.0048,
                          .row_pitch_rad = 0.0066 / 484 / 0.0048};
  const double a = 300.0 * camera.column_pitch_rad;
  const double b = 100.0 * camera.row_pitch_rad;
  EXPECT_NEAR(RelativeIllumination(camera, 300.0, 100.0), std::cos(a) * std::cos(a) * std::cos(b),
              1e-5);
  camera.lens = messages::Lens::kEquidistant;
  const double theta = std::hypot(a, b);
  EXPECT_NEAR(RelativeIllumination(camera, 300.0, 100.0), std::sin(theta) / theta * std::cos(theta),
              1e-5);
  camera.lens = messages::Lens::kPinhole;
  const double cosine = 1.0 / std::sqrt(1.0 + a * a + b * b);
  EXPECT_NEAR(RelativeIllumination(camera, 300.0, 100.0), std::pow(cosine, 4), 1e-5);
}

// A Gaussian of 1.2 pixels: the light stays, its variance along the line grows by 1.2^2.
TEST(ImageBlur, SpreadsLightAndKeepsIt) {
  RenderedRow row;
  row.sun_e_s.assign(101, 5.0);
  row.sun_e_s[50] = 105.0;
  row.lamps = {{40, 1, 7.0}, {41, 1, 3.0}, {2, 0, 1.0}};
  const RenderedRow sharp = row;
  ImageBlur(0.0).Apply(row);
  EXPECT_EQ(row.sun_e_s, sharp.sun_e_s);
  EXPECT_EQ(row.lamps.size(), 3U);
  ImageBlur(1.2).Apply(row);
  double variance = 0.0;
  for (int i = 0; i <= 100; ++i) {
    variance += (row.sun_e_s[static_cast<std::size_t>(i)] - 5.0) / 100.0 * (i - 50) * (i - 50);
  }
  EXPECT_NEAR(variance, 1.44, 0.001);
  EXPECT_NEAR(std::accumulate(row.sun_e_s.begin(), row.sun_e_s.end(), 0.0), 605.0, 1e-9);
  EXPECT_NEAR(row.sun_e_s[0], 5.0, 1e-12);
  const auto stripe = LampRates(row, 1);
  EXPECT_NEAR(std::accumulate(stripe.begin(), stripe.end(), 0.0), 10.0, 1e-9);
  double mean = 0.0;
  for (std::size_t i = 0; i < stripe.size(); ++i) mean += stripe[i] * static_cast<double>(i) / 10.0;
  EXPECT_NEAR(mean, 40.3, 1e-9);
  // Near the edge some of it leaves the image.
  const auto edge = LampRates(row, 0);
  EXPECT_LT(std::accumulate(edge.begin(), edge.end(), 0.0), 0.99);
}

TEST(ExposureControl, BringsTheBrightPixelsToTheTarget) {
  ImagerParams imager;  // 60000 e full well, target 0.4, 1000 e/s dark current
  imager.exposure.brightest_share = 0.1;
  std::vector<double> rates;
  for (int i = 1; i <= 100; ++i) rates.push_back(1e4 * i);
  // Ten of the hundred may be brighter than 9e5 e/s.
  EXPECT_NEAR(ExposureTime(imager, rates), 24000.0 / 901000.0, 1e-12);
  std::reverse(rates.begin(), rates.end());
  EXPECT_NEAR(ExposureTime(imager, rates), 24000.0 / 901000.0, 1e-12);
  EXPECT_EQ(ExposureTime(imager, std::vector<double>(9, 1e12)), imager.exposure.shortest_s);
  EXPECT_EQ(ExposureTime(imager, std::vector<double>(9, 0.0)), imager.exposure.longest_s);
  EXPECT_EQ(ExposureTime(imager, {}), imager.exposure.longest_s);
}

}  // namespace
}  // namespace rockyard::rendering
