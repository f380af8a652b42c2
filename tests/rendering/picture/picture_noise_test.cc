// Statistics of noise and faults of whole images.
#include <gtest/gtest.h>

#include <cmath>

#include "rendering/picture/picture_kit.h"
#include "rendering/picture/picture_readout.h"

namespace rockyard::rendering {
namespace {

constexpr int kSide = 200;
constexpr double kPixels = kSide * kSide;

PixelRays Rays() { return PixelRays(PinholeAt({0, 0, 1}, 0.0, kSide, kSide, 0.1)); }

// Whether a variance estimated from 40000 normal numbers agrees with what is expected, at alpha =
// 0.001: its relative deviation is sqrt(2 / n).
bool Agrees(double variance, double expected) {
  return std::abs(variance / expected - 1.0) < 3.29 * std::sqrt(2.0 / kPixels);
}

TEST(PictureNoise, VarianceIsThatOfShotDarkAndReadNoise) {
  PictureCameraParams params;
  params.imager.ccd.adc_bits = 12;
  params.imager.ccd.response_nonuniformity = 0.0;
  params.imager.ccd.offset_nonuniformity_e = 0.0;
  params.imager.ccd.dark_current_e_s = 3e5;
  params.imager.ccd.read_noise_e = 120.0;
  params.vignetting = Vignetting::kNone;
  params.stuck_share = 0.0;
  const PictureReadout readout(params, Rays(), 0, {4, 0});
  constexpr double kMean_e = 60000.0;
  constexpr double kExposure_s = 0.01;
  const vision::Image<float> rates(kSide, kSide, static_cast<float>(kMean_e / kExposure_s));
  const RawImage raw = readout.Read(rates, kExposure_s, 5);
  double mean = 0.0;
  for (const std::uint16_t count : raw.counts.values()) mean += count / kPixels;
  double variance = 0.0;
  for (const std::uint16_t count : raw.counts.values()) {
    variance += (count - mean) * (count - mean) / (kPixels - 1.0);
  }
  const double e_per_count = 170000.0 / (4095.0 * 0.98);
  // Poisson of light and dark charge, read noise, and 1/12 of rounding.
  const double dark_e = 3e5 * kExposure_s;
  const auto expected = [&](double read_e) {
    return (kMean_e + dark_e + read_e * read_e) / (e_per_count * e_per_count) + 1.0 / 12.0;
  };
  EXPECT_NEAR(mean, (kMean_e + dark_e) / e_per_count + 0.02 * 4095.0,
              3.29 * std::sqrt(variance / kPixels));
  EXPECT_TRUE(Agrees(variance, expected(120.0)));
  EXPECT_FALSE(Agrees(variance, expected(0.0)));  // the control: without read noise
}

TEST(PictureNoise, StuckPixelsAreAsManyAsStated) {
  const PictureCameraParams params{.vignetting = Vignetting::kNone, .stuck_share = 0.01};
  const PictureReadout readout(params, Rays(), 0, {4, 0});
  const vision::Image<float> rates(kSide, kSide, 5e6F);
  const RawImage raw = readout.Read(rates, 0.01, 0);
  double dark = 0.0, bright = 0.0;
  for (const std::uint16_t count : raw.counts.values()) {
    if (count == 0) ++dark;
    if (count == 255) ++bright;
  }
  // Poisson of mean 200 each, less those drawn twice (0.5 %); alpha 0.001.
  EXPECT_NEAR(dark, 199.0, 3.29 * std::sqrt(200.0));
  EXPECT_NEAR(bright, 199.0, 3.29 * std::sqrt(200.0));
  EXPECT_GT(std::abs(dark - 400.0), 3.29 * std::sqrt(400.0));  // the control
}

}  // namespace
}  // namespace rockyard::rendering
