// Parameters of pictures: they read back, bounds hold, and the family of soils has its ends.
#include "rendering/picture/picture_params.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/archive.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"

namespace rockyard::rendering {
namespace {

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

}  // namespace
}  // namespace rockyard::rendering
