#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rendering/picture/picture.h"
#include "rendering/picture/picture_kit.h"
#include "terrain/field.h"
#include "terrain/placed_rocks.h"
#include "vision/each_pixel.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// Every pixel of pictures over random fields against rays of the terrain itself.

terrain::Terrain Field(double roughness_m, double pointedness, terrain::ArenaKind arena) {
  terrain::TerrainParams params;
  params.rocks.k_per_m2 = 0.013;
  params.rocks.pointedness = pointedness;
  params.arena.kind = arena;
  params.ground.roughness_rms_m = roughness_m;
  return terrain::BuildField(params, {3, 1}, terrain::Course{}).terrain;
}

void ExpectRaysOfTheTerrain(const terrain::Terrain& terrain, const vision::CameraModel& camera) {
  const SunParams sun{.elevation_rad = 0.4};
  const PictureKit kit(terrain, sun, {}, camera);
  const Picture picture = kit.Render();
  const std::vector<terrain::RockShape> shapes(terrain.rocks().begin(), terrain.rocks().end());
  int rocks = 0;
  for (int row = 0; row < picture.rows(); ++row) {
    for (int column = 0; column < picture.columns(); ++column) {
      const auto ray = BackProject(camera, vision::Pixel(column, row));
      ASSERT_TRUE(ray);
      const auto hit = terrain.CastRay(ray->origin, ray->direction, PictureScene::kFarthest_m);
      const int surface = picture.surface.At(column, row);
      if (!hit) {
        EXPECT_EQ(surface, SurfacePoint::kSky);
        continue;
      }
      // To the last bit but over rough ground, where rays take another way.
      EXPECT_NEAR(picture.range_m.At(column, row), hit->distance_m,
                  terrain.ground().IsPlane() ? 0.0 : 1e-9);
      EXPECT_LT((picture.normal_W.At(column, row).cast<double>() - hit->normal_W).norm(), 1e-6);
      switch (hit->surface) {
        case terrain::Surface::kGround:
          EXPECT_EQ(surface, SurfacePoint::kGround);
          break;
        case terrain::Surface::kWall:
          EXPECT_EQ(surface, SurfacePoint::kWall);
          break;
        case terrain::Surface::kRock:
          EXPECT_EQ(surface, hit->rock);
          ++rocks;
      }
      // A long way to the sun through everything, walls excepted.
      const Vector3 off_W = hit->point_W + 1e-9 * hit->normal_W;
      const Vector3& toward_W = kit.scene.light().toward_sun_W;
      bool shaded = hit->normal_W.dot(toward_W) <= 0.0;
      for (std::size_t i = 0; i < shapes.size() && !shaded; ++i) {
        if (static_cast<int>(i) == surface) continue;
        shaded = shapes[i].Distance(off_W, toward_W) < terrain::RockShape::kNoHit;
      }
      const float sunlit = picture.sunlit.At(column, row);
      if (terrain.ground().IsPlane() && (sunlit == 0.0F || sunlit == 1.0F)) {
        EXPECT_EQ(sunlit, shaded ? 0.0F : 1.0F) << column << ' ' << row;
      }
    }
  }
  EXPECT_GT(rocks, 200);
}

TEST(PictureDifferential, EveryPixelIsWhereTheTerrainSays) {
  vision::CameraModel camera = PinholeAt({0.0, 0.0, 0.9}, 0.35, 120, 90, 1.1);
  std::get<vision::BrownPinhole>(camera.lens).k1 = -0.1;
  ExpectRaysOfTheTerrain(Field(0.0, 0.0, terrain::ArenaKind::kVirtualUnfolded), camera);
  ExpectRaysOfTheTerrain(Field(0.0, 0.85, terrain::ArenaKind::kOpen), camera);
  ExpectRaysOfTheTerrain(Field(0.0, 0.0, terrain::ArenaKind::kWalled), camera);
  ExpectRaysOfTheTerrain(Field(0.02, 0.0, terrain::ArenaKind::kOpen),
                         PinholeAt({0.0, 0.0, 0.9}, 0.5, 40, 30, 1.0));
}

// Rectified eyes over level ground: d = f B / Z with the depth Z along the axis.
TEST(StereoTruth, DisparityAndOcclusionFollowFromTheGeometry) {
  const terrain::Terrain terrain = Field(0.0, 0.0, terrain::ArenaKind::kOpen);
  constexpr double kBaseline_m = 0.3;
  constexpr double kPitch = 0.2;
  const vision::CameraModel left = PinholeAt({0.0, 0.15, 0.9}, kPitch, 120, 90, 0.9);
  const vision::CameraModel right = PinholeAt({0.0, -0.15, 0.9}, kPitch, 120, 90, 0.9);
  const double f_px = std::get<vision::BrownPinhole>(left.lens).fx_px;
  const PictureKit kit(terrain, {}, {}, left);
  const Picture picture = kit.Render();
  const StereoTruth truth =
      SeenFromOtherEye(kit.scene, picture, kit.rays, math::Transform::Identity(), right);
  const std::vector<terrain::RockShape> shapes(terrain.rocks().begin(), terrain.rocks().end());
  int occluded = 0, outside = 0, none = 0;
  const Vector3 axis(std::cos(kPitch), 0.0, -std::sin(kPitch));
  for (int row = 0; row < 90; ++row) {
    for (int column = 0; column < 120; ++column) {
      const OtherEye other = truth.other.At(column, row);
      if (picture.surface.At(column, row) == SurfacePoint::kSky) {
        EXPECT_EQ(other, OtherEye::kNone);
        ++none;
        continue;
      }
      const auto ray = BackProject(left, vision::Pixel(column, row));
      const double range_m = picture.range_m.At(column, row);
      const double disparity = f_px * kBaseline_m / (range_m * ray->direction.dot(axis));
      EXPECT_NEAR(column - truth.other_column.At(column, row), disparity, 1e-9 * (1 + disparity));
      EXPECT_NEAR(truth.other_row.At(column, row), row, 1e-9);
      if (column - disparity < -0.5) {
        EXPECT_EQ(other, OtherEye::kOutside);
        ++outside;
        continue;
      }
      // Whether any rock lies between, by where the line of sight is nearest to its centre, in the
      // coordinates in which it is the unit sphere.
      const Vector3 p = ray->origin + range_m * ray->direction;
      const Vector3 eye(0.0, -0.15, 0.9);
      double nearest = 2.0;
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Vector3 q = shapes[i].Map(p - terrain.rocks()[i].center_W);
        const Vector3 e = shapes[i].Map(eye - p);
        const double t = std::clamp(-q.dot(e) / e.squaredNorm(), 0.0, 1.0);
        // A rock's own point lies on it.
        if (static_cast<int>(i) == picture.surface.At(column, row) && t == 0.0) continue;
        nearest = std::min(nearest, (q + t * e).norm());
      }
      const bool hidden = nearest < 0.98;
      const bool grazed = nearest < 1.001;
      if (hidden) {
        ++occluded;
        EXPECT_EQ(other, OtherEye::kOccluded) << column << ' ' << row;
      } else if (!grazed) {
        EXPECT_EQ(other, OtherEye::kVisible) << column << ' ' << row;
      }
    }
  }
  EXPECT_GT(occluded, 30);
  EXPECT_GT(outside, 30);
  EXPECT_GT(none, 30);
}

TEST(StereoTruth, RoverHidesThePoint) {
  const terrain::Terrain terrain = terrain::Terrain(terrain::Ground(), {}, {});
  const RoverBody body({{{0.4, -0.3, 0.3}, {0.5, 0.0, 0.5}}}, {});
  const vision::CameraModel left = PinholeAt({0.0, 0.15, 0.9}, 0.6, 40, 40, 0.9);
  const vision::CameraModel right = PinholeAt({0.0, -0.15, 0.9}, 0.6, 40, 40, 0.9);
  const PictureKit kit(terrain, {}, {}, left, {&body, math::Transform::Identity()});
  const Picture picture = kit.Render();
  const StereoTruth truth =
      SeenFromOtherEye(kit.scene, picture, kit.rays, math::Transform::Identity(), right);
  // The ground at (1, y): seen from the right eye (y = -0.15) at half way, x = 0.45 and z = 0.495,
  // through the box where its y is below 0.
  int hidden = 0, seen = 0;
  vision::ForEachPixel(40, 40, [&](int column, int row) {
    if (picture.surface.At(column, row) != SurfacePoint::kGround) return;
    const auto ray = BackProject(left, vision::Pixel(column, row));
    const Vector3 p = ray->origin + picture.range_m.At(column, row) * ray->direction;
    const OtherEye other = truth.other.At(column, row);
    if (other == OtherEye::kOutside) return;
    const Vector3 eye(0.0, -0.15, 0.9);
    bool inside = false;
    for (int step = 0; step < 2000; ++step) {
      const Vector3 at = eye + step / 2000.0 * (p - eye);
      inside = inside || (at.x() > 0.4 && at.x() < 0.5 && at.y() > -0.3 && at.y() < 0.0 &&
                          at.z() > 0.3 && at.z() < 0.5);
    }
    // Lines that touch an edge within a step of the march may be told either way.
    if (inside) {
      EXPECT_EQ(other, OtherEye::kOccluded);
      ++hidden;
    } else {
      ++seen;
      EXPECT_TRUE(other == OtherEye::kVisible || other == OtherEye::kOccluded);
      if (p.x() > 1.6 || p.y() > 0.4) {
        EXPECT_EQ(other, OtherEye::kVisible);
      }
    }
  });
  EXPECT_GT(hidden, 20);
  EXPECT_GT(seen, 20);
}

// A camera that moves by parts of a pixel: its pictures change as the light that falls on its
// pixels does, and no more.

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
  vision::ForEachPixel(kSide, kSide, [&](int column, int row) {
    double sum = 0.0;
    for (int i = 0; i < samples * samples; ++i) {
      const vision::Pixel at(column + (i % samples + 0.5) / samples - 0.5,
                             row + (i / samples + 0.5) / samples - 0.5);
      const vision::Ray ray = *BackProject(camera, at);
      const Vector3 p = ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
      sum += field.Mean(p.x(), p.y(), point).value;
    }
    values.push_back(sum / (samples * samples));
  });
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
