// Images of stripes against plain supersampling, and stereo images against plain ray casting.

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "image_kit.h"
#include "sensing/stereo_depth.h"
#include "stereo_scene.h"
#include "vision/each_pixel.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

// The renderer against plain supersampling, and bands against whole frames.

// Plain supersampling of the light on a pixel, for comparison with the renderer: many rays, every
// shadow and every laser by a query of the whole terrain, no sharing, no closed forms.
struct ReferenceLight {
  double sun_e_s = 0.0;
  std::vector<double> laser_e_s;  // by laser
};

class ReferenceRenderer {
 public:
  ReferenceRenderer(const LineView& line, const terrain::Terrain& terrain,
                    const math::Transform& X_WR)
      : line_(line),
        terrain_(terrain),
        X_WR_(X_WR),
        light_(rendering::MakeSunLight(line.sun, line.params.imager.filter_width_m)),
        beam_(line.params.laser.profile, line.params.laser.beam_width_rad) {}

  // Mean over rays_across x rays_down rays within the pixel.
  ReferenceLight Pixel(int camera, int column, int row, int rays_across, int rays_down) const {
    ReferenceLight sum;
    sum.laser_e_s.resize(line_.calibration.lasers.size());
    const double gain = rendering::RelativeIllumination(line_.Camera(camera), column, row) *
                        line_.ElectronsPerRadiance() / (rays_across * rays_down);
    vision::ForEachPixel(rays_across, rays_down, [&](int i, int j) {
      AddRay(camera, column + (i + 0.5) / rays_across - 0.5, row + (j + 0.5) / rays_down - 0.5,
             gain, sum);
    });
    return sum;
  }

 private:
  void AddRay(int camera, double column, double row, double gain, ReferenceLight& sum) const {
    const messages::Camera& eye = line_.Camera(camera);
    const math::Vector3 eye_W = X_WR_ * eye.X_RC.translation();
    const math::Vector3 ray_R = eye.X_RC.linear() * vision::PixelRay(eye, {column, row});
    const math::Vector3 ray_W = X_WR_.linear() * ray_R;
    const auto hit = terrain_.CastRay(eye_W, ray_W, 100.0);
    if (!hit) {
      sum.sun_e_s += gain * light_.sky_w_m2 * std::numbers::inv_pi;
      return;
    }
    const bool is_ground = hit->surface == terrain::Surface::kGround;
    const double albedo = is_ground ? line_.sun.ground_albedo : line_.sun.rock_albedo;
    const math::Vector3 above_W = hit->point_W + 1e-6 * hit->normal_W;
    const math::Transform X_RW = X_WR_.inverse();
    const math::Vector3 sun_R = X_RW.linear() * light_.toward_sun_W;
    const bool sunlit = hit->normal_W.dot(light_.toward_sun_W) > 0.0 &&
                        !terrain_.CastRay(above_W, light_.toward_sun_W, 50.0) &&
                        line_.body.Distance(X_RW * above_W, sun_R) == rendering::RoverBody::kFree;
    sum.sun_e_s += gain * rendering::SunRadiance(light_, albedo, hit->normal_W, sunlit);
    for (std::size_t i = 0; i < line_.calibration.lasers.size(); ++i) {
      sum.laser_e_s[i] += gain * albedo * std::numbers::inv_pi * Irradiance(i, *hit);
    }
  }

  double Irradiance(std::size_t laser, const terrain::RayHit& hit) const {
    const messages::StripeLaser& fan = line_.calibration.lasers[laser];
    const math::Vector3 emitter_W = X_WR_ * fan.p_RoE_R;
    const math::Vector3 away_W = hit.point_W - emitter_W;
    const math::Vector3 away_R = X_WR_.linear().transpose() * away_W;
    const double range = away_W.norm();
    const double cosine = -away_W.dot(hit.normal_W) / range;
    if (cosine <= 0.0 || terrain_.Occluded(emitter_W, hit.point_W, 5e-4)) return 0.0;
    if (fan.axis_R.dot(away_R) < std::cos(fan.half_fan_rad) * range) return 0.0;
    const double angle = std::asin(fan.normal_R.dot(away_R) / range);
    return FanPower(line_.params) * beam_.Density(angle) * cosine / (range * range);
  }

  const LineView& line_;
  const terrain::Terrain& terrain_;
  math::Transform X_WR_;
  rendering::SunLight light_;
  BeamCrossSection beam_;
};

terrain::Terrain RandomRocks(std::uint32_t seed) {
  core::RandomStream stream({seed, 0}, core::Purpose::kTest);
  std::vector<terrain::Rock> rocks;
  for (int i = 0; i < 30; ++i) {
    const double a = core::SampleUniform(stream, 0.02, 0.10);
    const double b = a * core::SampleUniform(stream, 0.5, 1.0);
    const double c = a * core::SampleUniform(stream, 0.4, 0.9);
    const double x = core::SampleUniform(stream, 0.45, 1.5);
    const double y = core::SampleUniform(stream, -0.8, 0.8);
    rocks.push_back(EllipsoidRock(x, y, core::SampleUniform(stream, -0.5, 0.5) * c, a, b, c,
                                  core::SampleUniform(stream, 0.0, 3.0)));
  }
  return FlatWith(std::move(rocks));
}

struct Difference {
  double sun = 0.0;      // mean absolute difference over the mean
  double lasers = 0.0;   // the same of all lasers together
  double laser_sum = 0;  // of the sum over the line
};

LineView LowSun() {
  LineView line{QuietParams(), SunParams{}};
  line.sun.elevation_rad = math::DegToRad(25.0);
  return line;
}

// One line of camera 0, the renderer against so many rays across and down each pixel.
Difference CompareLine(const LineView& line, const terrain::Terrain& terrain,
                       const math::Transform& X_WR, int row_px, int rays_across, int rays_down) {
  const RenderedRow row = line.Render(terrain, X_WR, 0, row_px);
  const ReferenceRenderer reference(line, terrain, X_WR);
  const std::size_t lasers = line.calibration.lasers.size();
  std::vector<std::vector<double>> rates;
  for (std::size_t i = 0; i < lasers; ++i) rates.push_back(LampRates(row, static_cast<int>(i)));
  Difference difference;
  double sun = 0.0, light = 0.0;
  for (std::size_t pixel = 0; pixel < row.sun_e_s.size(); ++pixel) {
    const int column = static_cast<int>(pixel) - 384;
    const ReferenceLight expected = reference.Pixel(0, column, row_px, rays_across, rays_down);
    sun += expected.sun_e_s;
    difference.sun += std::abs(row.sun_e_s[pixel] - expected.sun_e_s);
    for (std::size_t i = 0; i < lasers; ++i) {
      light += expected.laser_e_s[i];
      difference.lasers += std::abs(rates[i][pixel] - expected.laser_e_s[i]);
      difference.laser_sum += rates[i][pixel] - expected.laser_e_s[i];
    }
  }
  difference.sun /= sun;
  difference.lasers /= light;
  difference.laser_sum = std::abs(difference.laser_sum) / light;
  return difference;
}

// Along the middle of a line the closed forms stand for the rays.
TEST(StripeImage, AgreesWithManyRaysAlongTheLine) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    const terrain::Terrain terrain = RandomRocks(seed);
    for (const BeamProfile profile : {BeamProfile::kGaussian, BeamProfile::kTopHat}) {
      LineView line = LowSun();
      line.params.laser.profile = profile;
      const auto row_px = line.calibration.scanline_px[seed % 4];
      const Difference d = CompareLine(line, terrain, PoseAt(0.0, 0.0, 0.0), row_px, 128, 1);
      // Sun: pixels with the edge of a shadow. Lasers: pixels in which light or shadow ends.
      EXPECT_LT(d.sun, 0.003) << seed;
      EXPECT_LT(d.lasers, 0.01) << seed;
      EXPECT_LT(d.laser_sum, 0.003) << seed;
    }
  }
}

// What sampling along the middle of a line alone costs: the surface and the stripe turn within it.
TEST(StripeImage, IsNearTheMeanOverTheWholePixel) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    const terrain::Terrain terrain = RandomRocks(seed);
    const LineView line = LowSun();
    const auto row_px = line.calibration.scanline_px[seed % 4];
    const Difference d = CompareLine(line, terrain, PoseAt(0.0, 0.0, 0.0), row_px, 48, 8);
    EXPECT_LT(d.sun, 0.003) << seed;
    EXPECT_LT(d.lasers, 0.03) << seed;
    EXPECT_LT(d.laser_sum, 0.003) << seed;
  }
}

TEST(StripeImager, BandsAreLinesOfTheWholeFrame) {
  LightStripeParams params;
  params.imager.margin_rows = 1;
  const StripeImager imager(params, SunParams{}, rover::RoverGeometryParams{});
  const terrain::Terrain terrain = RandomRocks(5);
  const math::Transform X_WR = PoseAt(0.05, 0.02, 0.01, 0.1);
  const messages::StripeImages images = imager.Expose(terrain, X_WR, {3, 8}, 17);
  ASSERT_EQ(images.exposures.size(), 5U);
  for (const messages::StripeExposure& exposure : images.exposures) {
    const messages::StripeExposure frame =
        imager.FullFrame(terrain, X_WR, {3, 8}, 17, exposure.camera, exposure.group);
    ASSERT_EQ(frame.lit.size(), 1U);
    EXPECT_EQ(frame.lit[0].rows, 484);
    EXPECT_EQ(frame.lit[0].columns, 768);
    EXPECT_EQ(frame.lit[0].counts.size(), 484U * 768U);
    ASSERT_EQ(exposure.lit.size(), 4U);
    ASSERT_EQ(exposure.dark.size(), 4U);
    for (std::size_t band = 0; band < 4; ++band) {
      const messages::ImageBand& lit = exposure.lit[band];
      EXPECT_EQ(lit.rows, 7);
      EXPECT_EQ(lit.first_row, imager.calibration().scanline_px[band] - 3);
      EXPECT_EQ(exposure.dark[band].first_row, lit.first_row);
      for (int row = lit.first_row; row < lit.first_row + lit.rows; ++row) {
        for (int column = lit.first_column; column < lit.first_column + lit.columns; ++column) {
          ASSERT_EQ(lit.At(row, column), frame.lit[0].At(row, column));
          ASSERT_EQ(exposure.dark[band].At(row, column), frame.dark[0].At(row, column));
        }
      }
    }
  }
}

// Stereo images against plain ray casting, in random fields and at random poses.

// The same image as StereoScene, pixel by pixel through the terrain's own ray casting.
DepthImage ReferenceInverseDepths(const terrain::Terrain& terrain, const StereoView& view_W,
                                  double max_range_m) {
  DepthImage image = DepthImage::Zero(view_W.rows, view_W.columns);
  vision::ForEachPixel(view_W.columns, view_W.rows, [&](int column, int row) {
    const math::Vector3 ray_W = view_W.Ray(column, row);
    const auto hit = terrain.CastRay(view_W.eye, ray_W.normalized(), max_range_m);
    if (hit && hit->distance_m > 0.0) image(row, column) = ray_W.norm() / hit->distance_m;
  });
  return image;
}

void ReferenceHideFromRightEye(const terrain::Terrain& terrain, const StereoView& view_W,
                               DepthImage& image) {
  constexpr double kMargin_m = 0.0005;
  vision::ForEachPixel(view_W.columns, view_W.rows, [&](int column, int row) {
    double& pixel = image(row, column);
    if (pixel <= 0.0) return;
    const math::Vector3 p_W = view_W.eye + view_W.Ray(column, row) / pixel;
    // The image begins half a pixel left of the middle of its first column.
    const bool outside = view_W.focal_px * view_W.baseline_m * pixel > column + 0.5;
    if (outside || terrain.Occluded(view_W.right_eye, p_W, kMargin_m)) pixel = 0.0;
  });
}

struct Scene {
  terrain::Terrain terrain;
  math::Transform X_WR;
  messages::LookDirection direction;
};

// Rocks of all sizes, some beside and above the cameras, sloping ground, and walls.
Scene RandomScene(std::uint32_t number, bool rough) {
  using core::SampleUniform;
  core::RandomStream stream({20260501, 0}, core::Purpose::kTest, number);
  terrain::GroundParams ground{.slope_rad = SampleUniform(stream, 0.0, 0.25),
                               .slope_direction_rad = SampleUniform(stream, -3.0, 3.0)};
  if (rough) ground.roughness_rms_m = 0.03;
  const terrain::Ground surface(ground, {1, number});
  std::vector<terrain::Rock> rocks;
  for (int i = 0; i < 60; ++i) {
    const double a = SampleUniform(stream, 0.02, i < 5 ? 0.6 : 0.2);
    const double x = SampleUniform(stream, -4.0, 4.0);
    const double y = SampleUniform(stream, -4.0, 4.0);
    const double b = a * SampleUniform(stream, 0.6, 1.0);
    const double c = a * SampleUniform(stream, 0.4, 1.2);
    const double z = surface.Height(x, y) + c * SampleUniform(stream, -0.5, 0.4);
    rocks.push_back(EllipsoidRock(x, y, z, a, b, c, SampleUniform(stream, 0.0, 3.1)));
  }
  const double side = SampleUniform(stream, 1.0, 3.0);
  std::vector<terrain::Wall> walls{{math::Vector3::UnitY(), side}, {-math::Vector3::UnitX(), 2.0}};
  const double x = SampleUniform(stream, -0.5, 0.5);
  const double y = SampleUniform(stream, -0.3, 0.3);
  const double heading = SampleUniform(stream, -3.1, 3.1);
  const double pitch = SampleUniform(stream, -0.3, 0.3);
  const double roll = SampleUniform(stream, -0.3, 0.3);
  return {{surface, std::move(rocks), std::move(walls)},
          math::MakePose({x, y, surface.Height(x, y) + 0.05}, heading, pitch, roll),
          number % 2 == 0 ? messages::LookDirection::kAhead : messages::LookDirection::kBehind};
}

struct Tally {
  int pixels = 0;
  int shown = 0;
  int hidden = 0;  // seen by the left eye alone
  int differ = 0;  // depth of the left eye by more than 1e-9 m, or shown and not
  int hiding_differs = 0;
};

Tally Compare(int scenes, bool rough, const StereoParams& params, double range_m) {
  Tally tally;
  for (int number = 0; number < scenes; ++number) {
    const Scene scene = RandomScene(static_cast<std::uint32_t>(number), rough);
    const StereoView view_W = MakeStereoView(params, scene.direction).From(scene.X_WR);
    const StereoScene fast(scene.terrain, view_W, params.max_range_m);
    DepthImage actual = fast.InverseDepths();
    DepthImage expected = ReferenceInverseDepths(scene.terrain, view_W, range_m);
    const auto shown = actual > 0.0 && expected > 0.0;
    const DepthImage apart_m = shown.select(actual.inverse() - expected.inverse(),
                                            DepthImage::Zero(view_W.rows, view_W.columns));
    tally.pixels += static_cast<int>(actual.size());
    tally.shown += static_cast<int>((expected > 0.0).count());
    tally.differ +=
        static_cast<int>(((actual > 0.0) != (expected > 0.0) || apart_m.abs() > 1e-9).count());
    const DepthImage left = expected;
    actual = left;
    fast.HideFromRightEye(actual);
    ReferenceHideFromRightEye(scene.terrain, view_W, expected);
    tally.hidden += static_cast<int>((left > 0.0 && expected == 0.0).count());
    tally.hiding_differs += static_cast<int>(((actual > 0.0) != (expected > 0.0)).count());
  }
  return tally;
}

StereoParams SmallImage() { return StereoParams{.columns = 96, .rows = 64}; }

TEST(StereoDifferentialTest, AgreesWithPlainRayCastingOnPlaneGround) {
  const Tally tally = Compare(60, false, SmallImage(), 4.0);
  EXPECT_GT(tally.shown, tally.pixels / 2);
  EXPECT_GT(tally.hidden, 5000);
  EXPECT_EQ(tally.differ, 0);
  // Points that a rock's limb hides by just the margin.
  EXPECT_LE(tally.hiding_differs, 2);
}

TEST(StereoDifferentialTest, AgreesWithPlainRayCastingOnRoughGround) {
  const Tally tally = Compare(6, true, SmallImage(), 4.0);
  EXPECT_GT(tally.shown, tally.pixels / 2);
  EXPECT_EQ(tally.differ, 0);
  EXPECT_GT(tally.hidden, 500);
  EXPECT_LE(tally.hiding_differs, tally.hidden / 20);
}

TEST(StereoDifferentialTest, TellsAnImageWithAnotherRange) {
  // Negative control: one millimetre of range shows.
  EXPECT_GT(Compare(6, false, SmallImage(), 3.999).differ, 0);
}

}  // namespace
}  // namespace rockyard::sensing
