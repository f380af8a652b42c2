// A camera that moves by parts of a pixel: its pictures change as the light that falls on its
// pixels does, and no more.
#include <gtest/gtest.h>

#include <vector>

#include "rendering/picture/picture_kit.h"
#include "terrain/placed_rocks.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

constexpr double kContrast = 0.1;
constexpr int kSide = 40;
constexpr core::TrialKey kKey{5, 2};

// Soil with octaves down to far below a pixel, all of which vary alike; nothing is shaded.
LookParams FineSoil() {
  LookParams look = PlainLook();
  look.drift = {kContrast, 2.0, 0.4, 0.003125, 0.0};
  look.soil_graininess = 0.0;
  return look;
}

// How the texture looks from a camera, in its standard deviations, by pixel.
using Values = std::vector<double>;

Values Rendered(const vision::CameraModel& camera) {
  const terrain::Terrain terrain = terrain::FlatWith({});
  const PictureKit kit(terrain, {}, FineSoil(), camera, {}, kKey);
  const PictureKit plain(terrain, {}, PlainLook(), camera, {}, kKey);
  const Picture picture = kit.Render();
  const Picture mean = plain.Render();
  Values values;
  for (std::size_t i = 0; i < picture.radiance_w_m2_sr.values().size(); ++i) {
    const double share = static_cast<double>(picture.radiance_w_m2_sr.values()[i]) /
                         static_cast<double>(mean.radiance_w_m2_sr.values()[i]);
    values.push_back((share - 1.0) / kContrast);
  }
  return values;
}

// The mean of samples^2 rays within each pixel, to single points of level ground; 1 leaves the
// texture without a filter.
Values Sampled(const vision::CameraModel& camera, int samples) {
  TextureField field(FineSoil().Soil(), kKey, core::Purpose::kSoilTexture);
  const Footprint point{{1e-7, 0.0}, {0.0, 1e-7}};
  Values values;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      double sum = 0.0;
      for (int i = 0; i < samples * samples; ++i) {
        const vision::Pixel at(column + (i % samples + 0.5) / samples - 0.5,
                               row + (i / samples + 0.5) / samples - 0.5);
        const vision::Ray ray = *BackProject(camera, at);
        const Vector3 p = ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
        sum += field.Mean(p.x(), p.y(), point).value;
      }
      values.push_back(sum / (samples * samples));
    }
  }
  return values;
}

double MeanSquare(const Values& a, const Values& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

struct Changes {
  double of_light = 0.0;  // mean squares, between two places of the camera
  double of_picture = 0.0;
  double of_points = 0.0;
  double unexplained = 0.0;  // of what the picture changes beyond the light
};

template <typename CameraAt>
Changes BetweenPlaces(const CameraAt& camera_at, double shift_m) {
  const auto here = camera_at(0.0);
  const auto there = camera_at(shift_m);
  const Values light[] = {Sampled(here, 8), Sampled(there, 8)};
  const Values picture[] = {Rendered(here), Rendered(there)};
  Values off[] = {picture[0], picture[1]};
  for (int k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < off[k].size(); ++i) off[k][i] -= light[k][i];
  }
  return {MeanSquare(light[0], light[1]), MeanSquare(picture[0], picture[1]),
          MeanSquare(Sampled(here, 1), Sampled(there, 1)), MeanSquare(off[0], off[1])};
}

template <typename CameraAt>
void ExpectNoFlicker(const CameraAt& camera_at, double pixel_m) {
  for (const double shift_px : {0.125, 0.25, 0.5}) {
    const Changes changes = BetweenPlaces(camera_at, shift_px * pixel_m);
    const auto is_still = [&](double change) { return change < 1.3 * changes.of_light; };
    EXPECT_TRUE(is_still(changes.of_picture))
        << shift_px << ": " << changes.of_picture << " for " << changes.of_light;
    EXPECT_GT(changes.of_picture, 0.5 * changes.of_light) << shift_px;
    EXPECT_LT(changes.unexplained, 0.6 * changes.of_light) << shift_px;
    // The control: a texture without a filter.
    EXPECT_FALSE(is_still(changes.of_points)) << shift_px;
    EXPECT_GT(changes.of_points, 2.0 * changes.of_light) << shift_px;
  }
}

TEST(Flicker, PicturesChangeAsTheLightDoes) {
  constexpr double kPixel_m = 0.02;
  ExpectNoFlicker(
      [](double x_m) {
        vision::CameraModel camera = NadirAt(2.0, kSide, kSide, kPixel_m);
        std::get<vision::BrownPinhole>(camera.lens).X_AC.translation().x() = x_m;
        return camera;
      },
      kPixel_m);
}

// Pixels of 20 mrad that see strips of ground up to four times as long as wide.
TEST(Flicker, SlantedPicturesChangeAsTheLightDoes) {
  ExpectNoFlicker(
      [](double x_m) {
        return PinholeAt({0.0, x_m, 1.0}, math::DegToRad(40.0), kSide, kSide, math::DegToRad(45.0));
      },
      0.03);
}

}  // namespace
}  // namespace rockyard::rendering
