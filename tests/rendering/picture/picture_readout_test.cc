// The camera of pictures: its parameters, its table of rays against the camera model itself, and
// its effects one by one.
#include "rendering/picture/picture_readout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/archive.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "rendering/picture/picture_kit.h"
#include "rendering/picture/picture_params.h"
#include "rendering/picture/pixel_rays.h"
#include "rendering/quiet_imager.h"
#include "rendering/radiometry.h"
#include "vision/each_pixel.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// Parameters of pictures: they read back, bounds hold, and the family of soils has its ends.

void ReadWith(std::string_view path, core::JsonValue value) {
  PictureParams params;
  core::JsonValue document = core::WriteParams(params);
  core::SetPath(document, path, std::move(value));
  core::ReadParams(document, params);
}

TEST(PictureParams, ReadBack) {
  PictureParams params;
  params.look.soil_graininess = 0.25;
  params.camera.vignetting = Vignetting::kPolynomial;
  params.camera.blur_px = 0.75;
  PictureParams again;
  core::ReadParams(core::WriteParams(params), again);
  EXPECT_EQ(core::DumpJson(core::WriteParams(again)), core::DumpJson(core::WriteParams(params)));
  EXPECT_EQ(again.camera.blur_px, 0.75);
}

TEST(PictureParams, AssumedValuesHaveARangeAndASource) {
  const core::FieldTable table = core::ListParams<PictureParams>();
  for (const core::ParameterInfo& info : table.parameters()) {
    if (info.kind != core::FieldKind::kReal && info.kind != core::FieldKind::kAngle) continue;
    EXPECT_TRUE(std::isfinite(info.min) && std::isfinite(info.max)) << info.path;
    if (info.origin != core::Origin::kAssumed) continue;
    EXPECT_FALSE(info.source.empty()) << info.path;
    EXPECT_TRUE(info.HasStudyRange()) << info.path;
  }
}

// What was fitted to an image says so; the same of other textures is assumed.
TEST(PictureParams, GravelIsCalibrated) {
  const core::FieldTable table = core::ListParams<PictureParams>();
  int calibrated = 0;
  for (const core::ParameterInfo& info : table.parameters()) {
    if (info.origin != core::Origin::kCalibrated) continue;
    ++calibrated;
    EXPECT_TRUE(info.path == "look.gravel.contrast" || info.path == "look.gravel.spectral_exponent")
        << info.path;
    EXPECT_THAT(info.source, testing::HasSubstr("Navcam"));
  }
  EXPECT_EQ(calibrated, 2);
}

TEST(PictureParams, ConditionsAcrossFieldsHold) {
  const auto reason = [](std::string_view path, core::JsonValue value) -> std::string {
    return core::RefusalOf([&] { ReadWith(path, std::move(value)); });
  };
  EXPECT_EQ(reason("look.drift.finest_wavelength_m", core::JsonValue(0.01)), "");
  EXPECT_THAT(reason("look.rock.finest_wavelength_m", core::JsonValue(0.9)),
              testing::HasSubstr("longest_wavelength_m"));
  EXPECT_THAT(reason("camera.vignetting_c2", core::JsonValue(-1.0)),
              testing::HasSubstr("without light"));
}

TEST(TextureParams, FamilyGoesFromDriftToGravel) {
  LookParams look{.soil_graininess = 0.0};
  EXPECT_EQ(look.Soil(), DriftTexture());
  look.soil_graininess = 1.0;
  const TextureParams gravel = look.Soil();
  EXPECT_EQ(gravel.spectral_exponent, GravelTexture().spectral_exponent);
  EXPECT_DOUBLE_EQ(gravel.longest_wavelength_m, GravelTexture().longest_wavelength_m);
  const TextureParams half = Between({0.1, 2.0, 4.0, 0.01, 0.0}, {0.3, 3.0, 1.0, 0.04, 0.2}, 0.5);
  EXPECT_DOUBLE_EQ(half.contrast, 0.2);
  EXPECT_DOUBLE_EQ(half.spectral_exponent, 2.5);
  EXPECT_DOUBLE_EQ(half.longest_wavelength_m, 2.0);
  EXPECT_DOUBLE_EQ(half.finest_wavelength_m, 0.02);
  EXPECT_DOUBLE_EQ(half.relief_slope, 0.1);
}

// The table of rays against the camera model itself.

vision::CameraModel Distorted() {
  vision::CameraModel camera = PinholeAt({0.1, 0.2, 0.9}, 0.3, 70, 50, 1.0);
  auto& lens = std::get<vision::BrownPinhole>(camera.lens);
  lens.k1 = -0.2;
  lens.p1 = 0.002;
  return camera;
}

// A fisheye whose pupil moves, and which sees a circle within its image.
vision::CameraModel Fisheye() {
  vision::Cahvore lens;
  lens.linear.C = {0.3, -0.1, 0.8};
  lens.linear.A = lens.O = Vector3::UnitX();
  lens.linear.H = 40.0 * -Vector3::UnitY() + 47.5 * Vector3::UnitX();
  lens.linear.V = 40.0 * -Vector3::UnitZ() + 31.5 * Vector3::UnitX();
  lens.E = {0.001, 0.0005, 0.0};
  lens.R = {0.0, -0.1, 0.0};
  lens.type = vision::CahvoreType::kFisheye;
  return {lens, {96, 64}};
}

TEST(PixelRays, AreThoseOfTheCamera) {
  for (const vision::CameraModel& camera : {Distorted(), Fisheye()}) {
    const PixelRays rays(camera);
    ASSERT_EQ(rays.columns(), camera.size.columns);
    ASSERT_EQ(rays.rows(), camera.size.rows);
    vision::ForEachPixel(rays.columns(), rays.rows(), [&](int column, int row) {
      if (!rays.Sees(column, row)) return;
      const auto expected = BackProject(camera, vision::Pixel(column, row));
      ASSERT_TRUE(expected);
      EXPECT_EQ(rays.At(column, row).origin, expected->origin);
      EXPECT_EQ(rays.At(column, row).direction, expected->direction);
    });
  }
}

TEST(PixelRays, BesideThePixelThereIsTheRayOfThatPosition) {
  const vision::CameraModel camera = Distorted();
  const PixelRays rays(camera);
  const double pixel_rad = rays.ByColumn(35, 25).norm();
  for (const int row : {0, 11, 49}) {
    for (const int column : {0, 30, 69}) {
      for (const double right : {-0.5, 0.25}) {
        const double down = 0.375;
        const Vector3 ray = rays.Beside(column, row, right, down).direction;
        const auto expected = BackProject(camera, vision::Pixel(column + right, row + down));
        ASSERT_TRUE(expected);
        EXPECT_NEAR(ray.norm(), 1.0, 1e-14);
        EXPECT_LT((ray - expected->direction).norm(), 0.01 * pixel_rad) << column << ' ' << row;
      }
    }
  }
}

TEST(PixelRays, PixelsAtTheEdgeOfALensAreBlind) {
  // Rows of a fisheye end where its radial polynomial stops growing: pixel 0, 0 is beyond.
  const vision::CameraModel camera = Fisheye();
  const PixelRays rays(camera);
  ASSERT_FALSE(BackProject(camera, vision::Pixel(0, 0)));
  EXPECT_FALSE(rays.Sees(0, 0));
  EXPECT_TRUE(rays.Sees(47, 31));
  for (int row = 1; row < rays.rows() - 1; ++row) {
    for (int column = 1; column < rays.columns() - 1; ++column) {
      bool all = true;
      for (int r = -1; r <= 1; ++r) {
        for (int c = -1; c <= 1; ++c) {
          all = all && BackProject(camera, vision::Pixel(column + c, row + r)).has_value();
        }
      }
      EXPECT_EQ(rays.Sees(column, row), all);
    }
  }
}

TEST(PixelRays, TilesHoldTheirRays) {
  for (const vision::CameraModel& camera : {Distorted(), Fisheye()}) {
    const PixelRays rays(camera);
    vision::ForEachPixel(rays.columns(), rays.rows(), [&](int column, int row) {
      if (!rays.Sees(column, row)) return;
      const PixelRays::Tile& tile = rays.TileAt(column / PixelRays::kTile, row / PixelRays::kTile);
      EXPECT_TRUE(tile.sees);
      EXPECT_NEAR(tile.cone.half_sine, std::sin(std::acos(tile.cone.half_cosine)), 1e-9);
      for (const double right : {-0.5, 0.5}) {
        for (const double down : {-0.5, 0.5}) {
          const vision::Ray ray = rays.Beside(column, row, right, down);
          EXPECT_GE(ray.direction.dot(tile.cone.axis), tile.cone.half_cosine - 1e-12);
          EXPECT_LE((ray.origin - tile.origin_A).norm(), tile.origin_spread_m + 1e-12);
        }
      }
    });
  }
}

// Camera effects one by one.

constexpr core::TrialKey kKey{9, 2};

PictureCameraParams Quiet() {
  PictureCameraParams params;
  Quieten(params.imager);
  params.imager.black_level = 0.02;
  params.blur_px = 0.0;
  params.vignetting = Vignetting::kNone;
  params.flat_field = FlatField::kRaw;
  params.stuck_share = 0.0;
  return params;
}

PixelRays Wide() { return PixelRays(PinholeAt({0, 0, 1}, 0.0, 65, 49, 1.4)); }

Picture Even(float radiance) {
  Picture picture(65, 49);
  std::fill(picture.radiance_w_m2_sr.values().begin(), picture.radiance_w_m2_sr.values().end(),
            radiance);
  return picture;
}

TEST(PictureReadout, NaturalVignettingOfAPinholeIsCosToTheFourth) {
  PictureCameraParams params = Quiet();
  params.vignetting = Vignetting::kNatural;
  const PixelRays rays = Wide();
  const PictureReadout readout(params, rays, 0, kKey);
  const auto rates = readout.Rates(Even(2.0F));
  const double on_axis =
      2.0 * ElectronsPerRadiance(params.imager, 12e-6 * 12e-6, params.wavelength_m);
  for (const int row : {1, 24, 40}) {
    for (const int column : {2, 32, 60}) {
      const double cosine = rays.At(column, row).direction.dot(rays.At(32, 24).direction);
      EXPECT_NEAR(rates.At(column, row), on_axis * std::pow(cosine, 4), 0.002 * on_axis);
    }
  }
}

TEST(PictureReadout, PolynomialVignettingEndsInTheCorners) {
  PictureCameraParams params = Quiet();
  params.vignetting = Vignetting::kPolynomial;
  params.vignetting_c2 = -0.3;
  params.vignetting_c4 = 0.1;
  const PixelRays rays = Wide();
  const PictureReadout readout(params, rays, 0, kKey);
  EXPECT_FLOAT_EQ(readout.Gain(32, 24), 1.0F);
  EXPECT_FLOAT_EQ(readout.Gain(0, 0), 0.8F);
  const auto angle = [&](int column, int row) {
    return std::acos(rays.At(column, row).direction.dot(rays.At(32, 24).direction));
  };
  const double x = angle(50, 30) / angle(0, 0);
  EXPECT_NEAR(readout.Gain(50, 30), 1.0 - 0.3 * x * x + 0.1 * x * x * x * x, 1e-6);
}

TEST(PictureReadout, BlurSpreadsAPointAndKeepsTheLight) {
  vision::Image<float> point(41, 31);
  point.At(20, 15) = 1.0F;
  const vision::Image<float> blurred = Blurred(point, 1.5);
  double sum = 0.0, columns2 = 0.0, rows2 = 0.0;
  vision::ForEachPixel(41, 31, [&](int column, int row) {
    const double at = blurred.At(column, row);
    sum += at;
    columns2 += at * (column - 20) * (column - 20);
    rows2 += at * (row - 15) * (row - 15);
  });
  EXPECT_NEAR(sum, 1.0, 1e-5);
  EXPECT_NEAR(columns2, 1.5 * 1.5, 0.01);
  EXPECT_NEAR(rows2, 1.5 * 1.5, 0.01);
  EXPECT_NEAR(blurred.At(21, 15) / blurred.At(20, 15), std::exp(-0.5 / 2.25), 1e-5);
  // Beyond the edges the image goes on: an even one stays even.
  const vision::Image<float> even = Blurred(vision::Image<float>(9, 7, 3.0F), 2.0);
  for (const float at : even.values()) EXPECT_NEAR(at, 3.0F, 1e-5);
  EXPECT_EQ(Blurred(point, 0.0), point);
}

// Exposure control wants all but brightest_share of the pixels below target_fill: an even picture
// comes out at that share of the counts above black.
TEST(PictureReadout, ExposureFillsTheWellAsFarAsWanted) {
  PictureCameraParams params = Quiet();
  params.imager.ccd.adc_bits = 12;
  params.imager.exposure.longest_s = 100.0;
  params.imager.exposure.shortest_s = 1e-6;
  const PixelRays rays = Wide();
  const PictureReadout plain(params, rays, 0, kKey);
  // Where corners are brightened on board, it is the delivered image that is metered.
  params.vignetting = Vignetting::kNatural;
  params.flat_field = FlatField::kCorrected;
  const PictureReadout corrected(params, rays, 0, kKey);
  for (const auto& [readout, radiance] :
       {std::pair(&plain, 0.5F), std::pair(&plain, 40.0F), std::pair(&corrected, 10.0F)}) {
    const auto rates = readout->Rates(Even(radiance));
    const RawImage raw = readout->Read(rates, readout->Exposure(rates), 7);
    double mean = 0.0;
    for (const std::uint16_t count : raw.counts.values()) mean += count / (65.0 * 49.0);
    // round(N / g + black) with g = well / (4095 (1 - 0.02)).
    EXPECT_NEAR(mean, 4095.0 * (0.02 + 0.8 * 0.98), 1.0) << radiance;
  }
}

TEST(PictureReadout, CorrectedImagesAreFlat) {
  PictureCameraParams params = Quiet();
  params.imager.ccd.full_well_e = 1e7;  // hardly any shot noise
  params.imager.ccd.response_nonuniformity = 0.05;
  params.vignetting = Vignetting::kNatural;
  const PixelRays rays = Wide();
  const auto spread = [&](FlatField flat_field) {
    params.flat_field = flat_field;
    const PictureReadout readout(params, rays, 0, kKey);
    const auto rates = readout.Rates(Even(10.0F));
    const double exposure_s = 5e6 / rates.At(32, 24);
    const RawImage raw = readout.Read(rates, exposure_s, 0);
    const auto [least, most] =
        std::minmax_element(raw.counts.values().begin(), raw.counts.values().end());
    // What the middle has: half a well.
    EXPECT_NEAR(raw.counts.At(32, 24), 65535 * (0.02 + 0.49), 65535 * 0.1);
    return (*most - *least) / 65535.0;
  };
  EXPECT_LT(spread(FlatField::kCorrected), 0.01);
  EXPECT_GT(spread(FlatField::kRaw), 0.2);
}

TEST(PictureReadout, ImagesDifferAndPatternsStay) {
  const PictureCameraParams params{.stuck_share = 0.01};
  const PixelRays rays = Wide();
  const PictureReadout readout(params, rays, 1, kKey);
  const auto rates = readout.Rates(Even(10.0F));
  const RawImage a = readout.Read(rates, 0.01, 0);
  EXPECT_EQ(a.counts, PictureReadout(params, rays, 1, kKey).Read(rates, 0.01, 0).counts);
  EXPECT_NE(readout.Read(rates, 0.01, 1).counts, a.counts);
  EXPECT_NE(PictureReadout(params, rays, 0, kKey).Read(rates, 0.01, 0).counts, a.counts);
  EXPECT_EQ(a.exposure_s, 0.01);
  // Stuck pixels are where they were, whatever the light.
  const auto dark = readout.Read(readout.Rates(Even(0.0F)), 0.01, 2).counts;
  int bright = 0;
  for (std::size_t i = 0; i < dark.values().size(); ++i) {
    if (dark.values()[i] < 200) continue;
    ++bright;
    EXPECT_EQ(a.counts.values()[i], 255);
  }
  EXPECT_GT(bright, 5);
}

TEST(PictureReadout, GrayKeepsTheHighestBits) {
  vision::Image<std::uint16_t> counts(3, 1);
  counts.At(0, 0) = 4095;
  counts.At(1, 0) = 16;
  counts.At(2, 0) = 15;
  const vision::GrayImage gray = ToGray(counts, 12);
  EXPECT_EQ(gray.At(0, 0), 255);
  EXPECT_EQ(gray.At(1, 0), 1);
  EXPECT_EQ(gray.At(2, 0), 0);
}

}  // namespace
}  // namespace rockyard::rendering
