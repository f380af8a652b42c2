#include "rendering/picture/picture_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "core/random.h"
#include "rendering/image_scene.h"
#include "rendering/line_kit.h"
#include "rendering/picture/picture_kit.h"
#include "rendering/picture/sun_shadows.h"
#include "terrain/placed_rocks.h"
#include "vision/each_pixel.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;
using terrain::EllipsoidRock;
using terrain::FlatWith;

// Pictures against closed forms: planes, shadows, silhouettes, textures that stay where they are.

SunParams SunAt(double elevation_deg, double azimuth_deg) {
  return {.elevation_rad = math::DegToRad(elevation_deg),
          .azimuth_rad = math::DegToRad(azimuth_deg)};
}

TEST(PictureRenderer, PlaneHasItsRangeAndRadiance) {
  const terrain::Terrain terrain = FlatWith({});
  const vision::CameraModel camera = PinholeAt({0.0, 0.1, 1.0}, 0.4, 48, 40, 0.9);
  const SunParams sun = SunAt(33.0, 70.0);
  const SunLight light = MakeSunLight(sun, 200e-9);
  for (const double share : {0.0, 0.6}) {
    LookParams look = PlainLook();
    look.lommel_seeliger_share = share;
    const PictureKit kit(terrain, sun, look, camera);
    const Picture picture = kit.Render();
    vision::ForEachPixel(48, 40, [&](int column, int row) {
      const Vector3 ray = BackProject(camera, vision::Pixel(column, row))->direction;
      const double mu = -ray.z();
      const double mu0 = light.toward_sun_W.z();
      if (mu < 0.006) return;  // at the horizon, where the plane ends for us
      EXPECT_NEAR(picture.range_m.At(column, row), 1.0 / mu, 1e-9 / mu);
      EXPECT_EQ(picture.surface.At(column, row), SurfacePoint::kGround);
      EXPECT_EQ(picture.sunlit.At(column, row), 1.0F);
      EXPECT_EQ(picture.normal_W.At(column, row), Eigen::Vector3f(0.0F, 0.0F, 1.0F));
      // McEwen 1991: (1 - S) Lambert + S Lommel-Seeliger, and an even sky.
      const double direct =
          light.direct_w_m2 * ((1.0 - share) * mu0 + share * 2.0 * mu0 / (mu0 + mu));
      const double radiance = sun.ground_albedo / std::numbers::pi * (direct + light.sky_w_m2);
      EXPECT_NEAR(picture.radiance_w_m2_sr.At(column, row), radiance, 1e-6 * radiance);
    });
  }
}

TEST(PictureRenderer, SkyIsEvenAndHasNoRange) {
  const terrain::Terrain terrain = FlatWith({});
  const PictureKit kit(terrain, SunAt(50.0, 0.0), {}, PinholeAt({0, 0, 1}, -0.6, 16, 16, 0.5));
  const Picture picture = kit.Render();
  const double sky = kit.scene.light().sky_w_m2 / std::numbers::pi;
  for (const int at : picture.surface.values()) EXPECT_EQ(at, SurfacePoint::kSky);
  for (const float at : picture.radiance_w_m2_sr.values()) EXPECT_NEAR(at, sky, 1e-6 * sky);
  for (const double at : picture.range_m.values()) EXPECT_TRUE(std::isinf(at));
}

// The brightness of a facet in direct light goes with the cosine to the sun: the step between sun
// and shade on level ground is E_direct sin h albedo / pi.
TEST(PictureRenderer, StepOfAShadowGoesWithTheSunsElevation) {
  const terrain::Terrain terrain = FlatWith({EllipsoidRock(0, 0, 0.3, 0.1, 0.1, 0.1)});
  for (const double elevation_deg : {70.0, 25.0}) {
    const SunParams sun = SunAt(elevation_deg, 90.0);
    LookParams look = PlainLook();
    look.edge_samples = 1;  // pixels of one surface only
    const PictureKit kit(terrain, sun, look, NadirAt(3.0, 200, 100, 0.01));
    const Picture picture = kit.Render();
    float least = 1e9F, most = 0.0F;
    for (std::size_t i = 0; i < picture.surface.values().size(); ++i) {
      if (picture.surface.values()[i] != SurfacePoint::kGround) continue;
      least = std::min(least, picture.radiance_w_m2_sr.values()[i]);
      most = std::max(most, picture.radiance_w_m2_sr.values()[i]);
    }
    const double step = sun.ground_albedo / std::numbers::pi * kit.scene.light().direct_w_m2 *
                        std::sin(sun.elevation_rad);
    EXPECT_NEAR(most - least, step, 1e-5 * step);
  }
}

// What a black ball hides of bright ground, and what its shadow takes of the light, by area.
TEST(PictureRenderer, EdgesAreSmoothByArea) {
  constexpr double kHeight_m = 10.0;
  constexpr double kPixel_m = 0.01;
  constexpr double kRadius_m = 0.0737;
  const terrain::Terrain terrain =
      FlatWith({EllipsoidRock(0.003, 0.004, 0.0, kRadius_m, kRadius_m, kRadius_m)});
  SunParams sun = SunAt(90.0, 0.0);  // no shadow to be seen
  sun.rock_albedo = 0.0;
  const auto missing_pixels = [&](std::int64_t edge_samples) {
    LookParams look = PlainLook();
    look.edge_samples = edge_samples;
    const PictureKit kit(terrain, sun, look, NadirAt(kHeight_m, 40, 40, kPixel_m));
    const Picture picture = kit.Render();
    const float bright = picture.radiance_w_m2_sr.At(0, 0);
    double missing = 0.0;
    for (const float at : picture.radiance_w_m2_sr.values()) missing += 1.0 - at / bright;
    return missing;
  };
  // A ball whose centre is at z = 0 is seen from the height H as a disc of radius r / sqrt(1 -
  // (r/H)^2) in that plane.
  const double radius_px =
      kRadius_m / std::sqrt(1.0 - std::pow(kRadius_m / kHeight_m, 2)) / kPixel_m;
  const double expected = std::numbers::pi * radius_px * radius_px;
  EXPECT_NEAR(missing_pixels(4), expected, 0.004 * expected);
  EXPECT_NEAR(missing_pixels(8), expected, 0.002 * expected);
  EXPECT_GT(std::abs(missing_pixels(1) - expected), 0.004 * expected);  // the control
}

// A straight shadow: the pixel in which it ends has the share of its area that is lit.
TEST(PictureRenderer, EdgeOfAShadowIsWhereItBelongs) {
  const terrain::Terrain terrain = FlatWith({});
  const RoverBody body({{{-0.4, -0.4, 0.5}, {0.0, 0.4, 0.6}}}, {});
  SunParams sun = SunAt(45.0, 180.0);  // from behind: shadows fall to +x
  for (const double shift_m : {0.0, 0.0025, 0.005, 0.0075}) {
    const math::Transform X_WR = math::MakePose({shift_m, 0.0, 0.0}, 0.0, 0.0, 0.0);
    LookParams look = PlainLook();
    look.sun_diameter_rad = 0.0;
    look.edge_samples = 8;
    // One centimetre a pixel, rows along -x: the shadow of the upper front edge ends at 0.6 m.
    const PictureKit kit(terrain, sun, look, NadirAt(1.8, 4, 200, 0.01), {&body, X_WR});
    const Picture picture = kit.Render();
    const double bright = picture.radiance_w_m2_sr.At(1, 10);
    double dark = 1e9, lit = 0.0;
    // From x = 0.7 down to 0.5 m.
    for (int row = 30; row < 50; ++row) {
      dark = std::min(dark, static_cast<double>(picture.radiance_w_m2_sr.At(1, row)));
    }
    for (int row = 30; row < 50; ++row) {
      lit += (picture.radiance_w_m2_sr.At(1, row) - dark) / (bright - dark);
    }
    EXPECT_NEAR(lit, 10.0 - shift_m / 0.01, 0.13) << shift_m;
  }
}

// Relief shades the parts of a pixel that is split as it shades whole ones: a straight shadow
// leaves the same share of light in all pixels of its edge.
TEST(PictureRenderer, EdgesKeepTheRelief) {
  const terrain::Terrain terrain = FlatWith({});
  LookParams look = PlainLook();
  look.sun_diameter_rad = 0.0;
  look.drift.relief_slope = look.gravel.relief_slope = 0.2;
  // As above; the shadow ends at x = front + 0.603 m, within row 39 where front is 0.
  const auto row_behind = [&](double front_m) {
    const RoverBody body({{{-0.4, -0.4, 0.5}, {front_m, 0.4, 0.6}}}, {});
    const math::Transform X_WR = math::MakePose({0.003, 0.0, 0.0}, 0.0, 0.0, 0.0);
    const PictureKit kit(terrain, SunAt(45.0, 180.0), look, NadirAt(1.8, 40, 200, 0.01),
                         {&body, X_WR});
    const Picture picture = kit.Render();
    const auto row = picture.radiance_w_m2_sr.Row(39);
    return std::vector<double>(row.begin(), row.end());
  };
  const std::vector<double> lit = row_behind(-0.05);
  const std::vector<double> dark = row_behind(0.05);
  const std::vector<double> edge = row_behind(0.0);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    EXPECT_NEAR((edge[i] - dark[i]) / (lit[i] - dark[i]), 0.75, 1e-3) << i;
  }
}

TEST(PictureRenderer, RoverIsInThePictureAndMasked) {
  const terrain::Terrain terrain = FlatWith({});
  const RoverBody body = SmallBody();
  const SunParams sun = SunAt(60.0, 0.0);
  const PictureKit kit(terrain, sun, PlainLook(), NadirAt(2.0, 60, 60, 0.01),
                       {&body, math::Transform::Identity()});
  const Picture picture = kit.Render();
  // The top of the chassis, 0.2 m wide at a height of 0.2 m, as large as 0.2 * 2 / 1.8 on the
  // ground.
  int columns = 0;
  for (int column = 0; column < 60; ++column) {
    if (picture.surface.At(column, 30) != SurfacePoint::kRover) continue;
    // Beside it the wheels, half as high.
    if (picture.range_m.At(column, 30) > 1.85) continue;
    ++columns;
    EXPECT_NEAR(picture.range_m.At(column, 30), 1.8, 0.02);
  }
  EXPECT_NEAR(columns, 22, 1);
  const double top = SunRadiance(kit.scene.light(), sun.rover_albedo, Vector3::UnitZ(), true);
  EXPECT_NEAR(picture.radiance_w_m2_sr.At(30, 30), top, 1e-6 * top);
}

Picture BusyPicture(int bands, bool in_threads) {
  const terrain::Terrain terrain = FlatWith({EllipsoidRock(2.0, 0.3, 0.05, 0.3, 0.2, 0.2),
                                             EllipsoidRock(1.4, -0.3, 0, 0.1, 0.1, 0.2),
                                             EllipsoidRock(4.0, -0.2, 0.1, 0.5, 0.5, 0.4)});
  const PictureKit kit(terrain, SunAt(25.0, 100.0), {}, PinholeAt({0, 0, 1}, 0.3, 80, 77, 0.8));
  Picture picture(80, 77);
  const PictureRenderer renderer(kit.scene, kit.look, kit.rays, math::Transform::Identity());
  std::vector<std::thread> threads;
  for (int band = 0; band < bands; ++band) {
    const auto render = [&, band] {
      TerrainLook look(terrain, kit.sun, kit.look, kit.key);
      renderer.RenderRows(77 * band / bands, 77 * (band + 1) / bands, look, picture);
    };
    if (in_threads) {
      threads.emplace_back(render);
    } else {
      render();
    }
  }
  for (std::thread& thread : threads) thread.join();
  return picture;
}

TEST(PictureRenderer, BandsAndThreadsChangeNoBit) {
  const Picture whole = BusyPicture(1, false);
  for (const Picture& other : {BusyPicture(1, false), BusyPicture(5, false), BusyPicture(77, false),
                               BusyPicture(3, true)}) {
    EXPECT_EQ(other.radiance_w_m2_sr, whole.radiance_w_m2_sr);
    EXPECT_EQ(other.range_m, whole.range_m);
    EXPECT_EQ(other.surface, whole.surface);
    EXPECT_EQ(other.normal_W, whole.normal_W);
    EXPECT_EQ(other.sunlit, whole.sunlit);
  }
}

// Two cameras of the same height look straight down from 0.15 m apart: the same point of the ground
// has the same light, up to what the filter leaves of its place within a pixel.
TEST(PictureRenderer, TextureIsFixedToTheGround) {
  const terrain::Terrain terrain = FlatWith({});
  const LookParams look;
  constexpr double kPixel_m = 0.01;
  const auto render = [&](double y_m, double yaw_rad) {
    const vision::CameraModel camera =
        Moved(math::MakePose({0.0, y_m, 0.0}, yaw_rad, 0.0, 0.0), NadirAt(5.0, 65, 65, kPixel_m));
    return PictureKit(terrain, SunAt(60.0, 0.0), look, camera).Render();
  };
  const Picture here = render(0.0, 0.0);
  const Picture aside = render(15.0 * kPixel_m, 0.0);
  const Picture turned = render(0.0, std::numbers::pi);
  double mean = 0.0;
  for (const float at : here.radiance_w_m2_sr.values()) mean += at / (65.0 * 65.0);
  double variance = 0.0;
  vision::ForEachPixel(65, 65, [&](int column, int row) {
    const double at = here.radiance_w_m2_sr.At(column, row);
    variance += (at - mean) * (at - mean) / (65.0 * 65.0);
    // Columns run along -y.
    if (column >= 15) {
      EXPECT_NEAR(aside.radiance_w_m2_sr.At(column, row),
                  here.radiance_w_m2_sr.At(column - 15, row), 1e-4 * mean);
    }
    EXPECT_NEAR(turned.radiance_w_m2_sr.At(64 - column, 64 - row), at, 1e-4 * mean);
  });
  EXPECT_GT(std::sqrt(variance), 0.03 * mean);  // there is a texture to compare
}

// Shadows against closed forms and against rays over the sun's disc.

constexpr int kGround = SurfacePoint::kGround;

Vector3 Toward(double elevation_deg, double azimuth_deg) {
  const double h = math::DegToRad(elevation_deg);
  const double a = math::DegToRad(azimuth_deg);
  return {std::cos(h) * std::cos(a), std::cos(h) * std::sin(a), std::sin(h)};
}

// The shadow of a ball on level ground is an ellipse of semi-axes r and r / sin h around the point
// z / tan h behind it. Under a disc the edge is half lit, and the penumbra as wide as the disc.
TEST(SunShadows, BallCastsAnEllipseWithAPenumbra) {
  const Vector3 sun = Toward(35.0, 120.0);
  const double sine = sun.z();
  constexpr double kRadius = 0.1;
  const Vector3 ball(1.5, 0.2, 0.25);
  const terrain::Terrain terrain =
      FlatWith({EllipsoidRock(ball.x(), ball.y(), ball.z(), kRadius, kRadius, kRadius)});
  const double diameter = math::DegToRad(0.35);
  const SunShadows disc(terrain, sun, diameter, {});
  const SunShadows point(terrain, sun, 0.0, {});
  const Vector3 away = Vector3(-sun.x(), -sun.y(), 0.0).normalized();
  const Vector3 across(-away.y(), away.x(), 0.0);
  const Vector3 middle =
      Vector3(ball.x(), ball.y(), 0.0) + ball.z() * std::sqrt(1.0 - sine * sine) / sine * away;
  for (int i = 0; i < 24; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 24;
    const auto at = [&](double radius_m) {
      return Vector3(middle + radius_m * (std::cos(turn) * across + std::sin(turn) / sine * away));
    };
    const auto lit = [&](const SunShadows& shadows, double radius_m) {
      return shadows.Visible(at(radius_m), Vector3::UnitZ(), kGround);
    };
    EXPECT_EQ(lit(point, 0.999 * kRadius), 0.0);
    EXPECT_EQ(lit(point, 1.001 * kRadius), 1.0);
    EXPECT_NEAR(lit(disc, kRadius), 0.5, 1e-9);
    // Half of the disc from the edge, seen from where the ray is nearest to the ball.
    const double half_m = 0.5 * diameter * (ball - at(kRadius)).dot(sun);
    EXPECT_EQ(lit(disc, kRadius - 1.01 * half_m), 0.0);
    EXPECT_EQ(lit(disc, kRadius + 1.01 * half_m), 1.0);
    // At a quarter of the diameter: 1/2 + (sqrt(3)/4 + pi/6) / pi.
    EXPECT_NEAR(lit(disc, kRadius + 0.5 * half_m), 0.804499, 0.004);
    EXPECT_NEAR(lit(disc, kRadius - 0.5 * half_m), 0.195501, 0.004);
  }
}

// Rays spread evenly over the disc, by Vogel's spiral.
double ShareOfRays(const terrain::Rock& rock, const Vector3& p, const Vector3& sun,
                   double diameter_rad) {
  const terrain::RockShape shape(rock);
  const Vector3 x = sun.unitOrthogonal();
  const Vector3 y = sun.cross(x);
  constexpr int kRays = 1500;
  int seen = 0;
  for (int i = 0; i < kRays; ++i) {
    const double r = 0.5 * diameter_rad * std::sqrt((i + 0.5) / kRays);
    const double turn = 2.399963229728653 * i;
    const Vector3 ray = (sun + r * (std::cos(turn) * x + std::sin(turn) * y)).normalized();
    if (shape.Distance(p, ray) == terrain::RockShape::kNoHit) ++seen;
  }
  return static_cast<double>(seen) / kRays;
}

TEST(SunShadows, EllipsoidsAndCapsAgreeWithRaysOverTheDisc) {
  core::RandomStream stream({5, 0}, core::Purpose::kTest, 0);
  const double diameter = math::DegToRad(1.0);
  int partly = 0;
  for (int i = 0; i < 2000; ++i) {
    terrain::Rock rock =
        EllipsoidRock(0.0, 0.0, 0.03, 0.15, 0.11, 0.09, core::SampleUniform(stream, 0.0, 3.0));
    const bool is_cap = i % 4 == 0;
    if (is_cap) {
      rock.cap_growth = 0.7;
      rock.center_W.z() = 0.0;
    }
    const Vector3 sun =
        Toward(core::SampleUniform(stream, 10.0, 80.0), core::SampleUniform(stream, 0.0, 360.0));
    const terrain::Terrain terrain = FlatWith({rock});
    const SunShadows shadows(terrain, sun, diameter, {});
    // Points near the edge of the shadow of the rock's upper part.
    const double down = core::SampleUniform(stream, 0.3, 0.9) * 0.1 / sun.z();
    const Vector3 p(-down * sun.x() + core::SampleUniform(stream, -0.18, 0.18),
                    -down * sun.y() + core::SampleUniform(stream, -0.18, 0.18), 0.0);
    if (terrain::RockShape(rock).Distance(p, Vector3::UnitZ()) == 0.0) continue;
    const double expected = ShareOfRays(rock, p, sun, diameter);
    const double share = shadows.Visible(p, Vector3::UnitZ(), kGround);
    if (expected > 0.0 && expected < 1.0) ++partly;
    // A straight edge for a curved one; a cap's eight rays are worth 1/8 each.
    EXPECT_NEAR(share, expected, is_cap ? 0.3 : 0.04) << i;
  }
  EXPECT_GT(partly, 15);
}

TEST(SunShadows, NeitherItselfNorWhatLiesBehindShades) {
  const terrain::Terrain terrain = FlatWith(
      {EllipsoidRock(0.0, 0.0, 0.0, 0.1, 0.1, 0.1), EllipsoidRock(-0.35, 0.0, 0.0, 0.2, 0.2, 0.2)});
  const Vector3 sun = Toward(20.0, 0.0);
  const SunShadows shadows(terrain, sun, 0.006, {});
  const Vector3 facing = Vector3(1.0, 0.0, 0.2).normalized();
  EXPECT_EQ(shadows.Visible(0.1 * facing, facing, 0), 1.0);
  const Vector3 averted(-1.0, 0.0, 0.0);
  EXPECT_EQ(shadows.Visible(0.1 * averted, averted, 0), 0.0);
  // Between the two, in the shadow of the first only; sunward of both.
  EXPECT_EQ(shadows.Visible({-0.12, 0.0, 0.0}, Vector3::UnitZ(), kGround), 0.0);
  EXPECT_EQ(shadows.Visible({0.2, 0.0, 0.0}, Vector3::UnitZ(), kGround), 1.0);
  // The second rock, in the first one's shadow.
  const Vector3 low(0.9, 0.0, 0.1);
  EXPECT_EQ(shadows.Visible(Vector3(-0.35, 0.0, 0.0) + 0.2 * low.normalized(), low.normalized(), 1),
            0.0);
}

// A box throws the shadow of its upper edge to z / tan h behind that.
TEST(SunShadows, RoverCastsTheShadowOfABox) {
  const RoverBody body = SmallBody();  // a box over |x| <= 0.1, z from 0.1 to 0.2
  const terrain::Terrain terrain = FlatWith({});
  const math::Transform X_WR = math::MakePose({2.0, 1.0, 0.0}, 0.0, 0.0, 0.0);
  const Vector3 sun = Toward(45.0, 0.0);
  const SunShadows shadows(terrain, sun, 0.006, {&body, X_WR});
  const auto lit = [&](double x) {
    return shadows.Visible({2.0 + x, 1.0, 0.0}, Vector3::UnitZ(), kGround);
  };
  EXPECT_EQ(lit(-0.1 - 0.2 + 0.001), 0.0);
  EXPECT_EQ(lit(-0.1 - 0.2 - 0.001), 1.0);
  EXPECT_EQ(lit(0.1 - 0.1 - 0.001), 0.0);
  EXPECT_EQ(lit(0.1 - 0.1 + 0.001), 1.0);
}

TEST(SunShadows, GroundShadesItself) {
  terrain::GroundParams ground{.pits = {{0.0}, {0.0}, {0.6}, {0.2}, {0.05}}};
  const terrain::Terrain terrain(terrain::Ground(ground, {1, 0}), {}, {});
  const SunShadows shadows(terrain, Toward(20.0, 0.0), 0.006, {});
  const auto lit = [&](double x) {
    return shadows.Visible({x, 0.0, terrain.ground().Height(x, 0.0)}, Vector3::UnitZ(), kGround);
  };
  EXPECT_EQ(lit(0.2), 0.0);  // at the sunward wall of the pit
  EXPECT_EQ(lit(0.5), 1.0);  // beside it
}

}  // namespace
}  // namespace rockyard::rendering
