// Camera effects one by one.
#include "rendering/picture/picture_readout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rendering/picture/picture_kit.h"
#include "rendering/quiet_imager.h"
#include "rendering/radiometry.h"

namespace rockyard::rendering {
namespace {

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
  for (int row = 0; row < 31; ++row) {
    for (int column = 0; column < 41; ++column) {
      const double at = blurred.At(column, row);
      sum += at;
      columns2 += at * (column - 20) * (column - 20);
      rows2 += at * (row - 15) * (row - 15);
    }
  }
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
  const RawImage again = PictureReadout(params, rays, 1, kKey).Read(rates, 0.01, 0);
  EXPECT_EQ(a.counts, again.counts);
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
