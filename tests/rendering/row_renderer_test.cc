// Lines of pictures: light against closed forms, what a ray meets and what lies in the shade, and
// lines of simple scenes.
#include "rendering/row_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "rendering/image_scene.h"
#include "rendering/line_kit.h"
#include "rendering/quiet_imager.h"
#include "rendering/radiometry.h"
#include "terrain/placed_rocks.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;
using terrain::EllipsoidRock;
using terrain::FlatWith;

// Light against closed forms.

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

// What a ray meets, and what lies in the shade.

// The shadow of a ball on level ground is an ellipse with semi-axes r and r / sin(h) around the
// point h_c / tan(h) behind it.
TEST(ImageScene, ShadowOfABallIsAnEllipse) {
  const SunParams sun{.elevation_rad = math::DegToRad(35.0), .azimuth_rad = math::DegToRad(120.0)};
  const SunLight light = MakeSunLight(sun, 40e-9);
  constexpr double kRadius = 0.1;
  constexpr double kCenter = 0.13;
  const Vector3 ball(1.5, 0.2, kCenter);
  const terrain::Terrain terrain =
      FlatWith({EllipsoidRock(ball.x(), ball.y(), kCenter, kRadius, kRadius, kRadius)});
  const RoverBody body = SmallBody();
  const ImageScene scene(terrain, math::Transform::Identity(), light, sun, body, 4.0);
  const Vector3 away(-std::cos(sun.azimuth_rad), -std::sin(sun.azimuth_rad), 0.0);
  const Vector3 across(-away.y(), away.x(), 0.0);
  const Vector3 middle =
      Vector3(ball.x(), ball.y(), 0.0) + kCenter / std::tan(sun.elevation_rad) * away;
  std::vector<int> shading;
  const double bright = SunRadiance(light, sun.ground_albedo, Vector3::UnitZ(), true);
  const double shaded = SunRadiance(light, sun.ground_albedo, Vector3::UnitZ(), false);
  for (int i = 0; i < 48; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 48;
    for (const double scale : {0.99, 1.01}) {
      const Vector3 ground = middle + scale * kRadius *
                                          (std::cos(turn) * across +
                                           std::sin(turn) / std::sin(sun.elevation_rad) * away);
      const Vector3 eye = ground + Vector3(0.0, 0.0, 0.02);
      if ((eye - ball).norm() <= kRadius) continue;  // under the ball
      SurfacePoint point = scene.Meet(eye, -Vector3::UnitZ(), RoverBody::kFree, {});
      scene.RocksBeforeSun({point.p_W, 0.0}, shading);
      scene.Light(shading, point);
      EXPECT_NEAR(point.radiance_w_m2_sr, scale < 1.0 ? shaded : bright, 1e-12) << i;
    }
  }
}

TEST(ImageScene, FarSideOfARockIsDarkAndWallsCastNoShadow) {
  SunParams sun{.elevation_rad = math::DegToRad(30.0)};
  sun.azimuth_rad = 0.0;  // in front
  const SunLight light = MakeSunLight(sun, 40e-9);
  const RoverBody body = SmallBody();
  const terrain::Terrain terrain =
      FlatWith({EllipsoidRock(1.0, 0.0, 0.0, 0.1, 0.1, 0.1)}, {{Vector3::UnitX(), 1.5}});
  const ImageScene scene(terrain, math::Transform::Identity(), light, sun, body, 4.0);
  const std::vector<int> rock{0};
  SurfacePoint facing_rover =
      scene.Meet(Vector3(0.5, 0.0, 0.05), Vector3::UnitX(), RoverBody::kFree, rock);
  scene.Light(rock, facing_rover);
  EXPECT_EQ(facing_rover.surface, 0);
  EXPECT_NEAR(facing_rover.radiance_w_m2_sr,
              SunRadiance(light, sun.rock_albedo, facing_rover.normal_W, false), 1e-12);
  SurfacePoint ground =
      scene.Meet(Vector3(1.4, 0.0, 0.5), -Vector3::UnitZ(), RoverBody::kFree, rock);
  scene.Light(rock, ground);
  EXPECT_NEAR(ground.radiance_w_m2_sr,
              SunRadiance(light, sun.ground_albedo, Vector3::UnitZ(), true), 1e-12);
}

// Lines of pictures of simple scenes, in sunlight and in the light of a lamp.

constexpr int kColumns = 96;
constexpr double kPixel_m2 = 1.4e-10;
constexpr double kWavelength_m = 850e-9;

// One lamp that lights everything alike: a surface sends back its albedo.
class EvenLamp final : public Lamps {
 public:
  void Add(const SurfacePoint& left, const SurfacePoint& right, int pixel, double gain,
           RenderedRow& row) const override {
    const auto radiance = [](const SurfacePoint& point) {
      return point.TakesLampLight() ? point.albedo : 0.0;
    };
    row.lamps.push_back({pixel, 0, 0.5 * gain * (radiance(left) + radiance(right))});
  }
};

// A pinhole 1 m above the ground, 1 m ahead of the rover, that looks straight down on 1 m of it.
messages::Camera CameraAbove() {
  messages::Camera camera{.lens = messages::Lens::kPinhole};
  camera.X_RC.translation() = Vector3(1.0, 0.0, 1.0);
  camera.X_RC.linear() =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitY()).toRotationMatrix();
  camera.column_pitch_rad = 1.0 / kColumns;
  camera.row_pitch_rad = camera.column_pitch_rad;
  camera.columns = kColumns;
  camera.rows = kColumns;
  return camera;
}

// Its middle line, with the rover at the origin.
struct Line {
  messages::Camera camera = CameraAbove();
  RoverBody body = SmallBody();
  SunParams sun;
  ImagerParams imager = QuietImager();

  ViewRow View() const { return MakeViewRow(camera, body, 0, -kColumns / 2, kColumns); }
  SunLight Light() const { return MakeSunLight(sun, imager.filter_width_m); }
  RenderedRow Render(const terrain::Terrain& terrain) const {
    const ImageScene scene(terrain, math::Transform::Identity(), Light(), sun, body, 4.0);
    return RowRenderer(imager, kPixel_m2, kWavelength_m)
        .Render(scene, EvenLamp(), camera.X_RC.translation(), View());
  }
};

TEST(RowRenderer, LevelGroundIsAsBrightAsTheSunMakesIt) {
  const Line line;
  const RenderedRow row = line.Render(terrain::FlatWith({}));
  const ViewRow view = line.View();
  const double electrons = ElectronsPerRadiance(line.imager, kPixel_m2, kWavelength_m);
  const double radiance = SunRadiance(line.Light(), line.sun.ground_albedo, Vector3::UnitZ(), true);
  const auto lamp = LampRates(row, 0);
  ASSERT_EQ(row.sun_e_s.size(), std::size_t{kColumns});
  for (std::size_t i = 0; i < row.sun_e_s.size(); ++i) {
    EXPECT_NEAR(row.sun_e_s[i] / (view.gain[i] * electrons * radiance), 1.0, 1e-12) << i;
    EXPECT_NEAR(lamp[i] / (view.gain[i] * electrons * line.sun.ground_albedo), 1.0, 1e-12) << i;
  }
}

// A ball of 20 cm under the camera: its outline is seen where the ray touches it, at the slope
// r / sqrt(h^2 - r^2), and cuts a pixel into parts.
TEST(RowRenderer, PixelsAreSplitWhereASurfaceEnds) {
  constexpr double kRadius = 0.2;
  const Line line;
  const RenderedRow row = line.Render(
      terrain::FlatWith({terrain::EllipsoidRock(1.0, 0.0, 0.0, kRadius, kRadius, kRadius)}));
  const ViewRow view = line.View();
  const double electrons = ElectronsPerRadiance(line.imager, kPixel_m2, kWavelength_m);
  const double edge_px = kRadius / std::sqrt(1.0 - kRadius * kRadius) * kColumns;
  const auto lamp = LampRates(row, 0);
  for (std::size_t i = 0; i < lamp.size(); ++i) {
    const double column_px = view.first_column + static_cast<double>(i);
    // Share of the pixel on the ball; its parts tell it to one of them.
    const double on_ball = std::clamp(edge_px - std::abs(column_px) + 0.5, 0.0, 1.0);
    const double albedo = on_ball * line.sun.rock_albedo + (1.0 - on_ball) * line.sun.ground_albedo;
    const double coarse = on_ball > 0.0 && on_ball < 1.0 ? 1.0 / RowRenderer::kParts : 1e-12;
    EXPECT_NEAR(lamp[i] / (view.gain[i] * electrons), albedo, coarse * 0.15 + 1e-12) << i;
  }
  // Every pixel has one term, those with the two edges one for each part.
  EXPECT_EQ(row.lamps.size(), std::size_t{kColumns + 2 * (RowRenderer::kParts - 1)});
}

// Under a rover that stands where the camera looks there is its own part, without a lamp's light.
TEST(RowRenderer, TheRoverItselfTakesNoLightOfLamps) {
  Line line;
  line.camera.X_RC.translation() = Vector3(0.0, 0.0, 1.0);
  const RenderedRow row = line.Render(terrain::FlatWith({}));
  const auto lamp = LampRates(row, 0);
  EXPECT_EQ(lamp[kColumns / 2], 0.0);
  EXPECT_GT(row.sun_e_s[kColumns / 2], 0.0);
  EXPECT_GT(lamp[0], 0.0);
}

// What the lens blurs it blurs of both lights, which change at the edge of the rock.
TEST(RowRenderer, BlursSunAndLamps) {
  Line line;
  const terrain::Terrain terrain =
      terrain::FlatWith({terrain::EllipsoidRock(1.0, 0.0, 0.0, 0.2, 0.2, 0.2)});
  const RenderedRow sharp = line.Render(terrain);
  line.imager.blur_px = 1.0;
  RenderedRow blurred = sharp;
  ImageBlur(1.0).Apply(blurred);
  const RenderedRow row = line.Render(terrain);
  EXPECT_EQ(row.sun_e_s, blurred.sun_e_s);
  EXPECT_EQ(LampRates(row, 0), LampRates(blurred, 0));
  EXPECT_NE(row.sun_e_s, sharp.sun_e_s);
}

}  // namespace
}  // namespace rockyard::rendering
