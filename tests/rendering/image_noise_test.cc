#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "rendering/image_readout.h"
#include "rendering/picture/picture_kit.h"
#include "rendering/picture/picture_readout.h"
#include "rendering/quiet_imager.h"

namespace rockyard::rendering {
namespace {

// Noise of the images against theory. Every test has fixed seeds; a bound is the two-sided quantile
// of its statistic at alpha = 1e-4, and a statistic that must not fit is shown to break it.

constexpr double kAlpha = 1e-4;
constexpr core::TrialKey kKey{11, 5};

bool FitsVariance(double sum_of_squares, double variance, double degrees) {
  const boost::math::chi_squared law(degrees);
  const double statistic = sum_of_squares / variance;
  return statistic > quantile(law, 0.5 * kAlpha) &&
         statistic < quantile(complement(law, 0.5 * kAlpha));
}

// z for which a standard normal number exceeds it in size with probability kAlpha.
constexpr double kNormalBound = 3.8906;

TEST(PixelNoise, IsStandardNormal) {
  const PixelNoise noise(kKey, core::Purpose::kTest, 3);
  constexpr int kColumns = 768;
  constexpr int kRows = 200;
  constexpr int kBins = 32;
  std::vector<double> counts(kBins);
  double sum = 0.0, squares = 0.0, neighbours = 0.0;
  for (int row = -kRows / 2; row < kRows / 2; ++row) {
    double last = 0.0;
    ForEachPixelNoise(noise, row, -kColumns / 2, kColumns, [&](int, float z) {
      sum += z;
      squares += double{z} * z;
      neighbours += last * z;
      last = z;
      const double p = 0.5 * std::erfc(-z / std::numbers::sqrt2);
      ++counts[static_cast<std::size_t>(p * kBins)];
    });
  }
  constexpr double kCount = double{kColumns} * kRows;
  EXPECT_LT(std::abs(sum), kNormalBound * std::sqrt(kCount));
  EXPECT_LT(std::abs(neighbours), kNormalBound * std::sqrt(kCount));
  EXPECT_TRUE(FitsVariance(squares, 1.0, kCount));
  EXPECT_FALSE(FitsVariance(squares, 1.03, kCount));
  double statistic = 0.0;
  for (const double count : counts) {
    statistic += std::pow(count - kCount / kBins, 2) / (kCount / kBins);
  }
  EXPECT_LT(statistic, quantile(complement(boost::math::chi_squared(kBins - 1.0), kAlpha)));
}

// Lines are drawn side by side; the reference is one block of core::Philox4x32 after the other.
TEST(PixelNoise, CellsOfALineAreThoseOfItsBlocks) {
  const PixelNoise noise(kKey, core::Purpose::kTest, 3);
  const auto numbers = PixelNoise::NumbersOfCells();
  for (const int row : {-(1 << 15), -3, 0, (1 << 15) - 1}) {
    for (const int blocks : {1, 2, 3, 5, 16, 37}) {
      for (const int first : {-(1 << 15), -2, 0, (1 << 15) - blocks}) {
        std::vector<std::uint16_t> cells(static_cast<std::size_t>(8 * blocks));
        noise.Cells(row, first, cells);
        for (int block = 0; block < blocks; ++block) {
          const auto expected = noise.Block(row, first + block);
          for (std::size_t i = 0; i < expected.size(); ++i) {
            ASSERT_EQ(numbers[cells[static_cast<std::size_t>(8 * block) + i]], expected[i]);
          }
        }
      }
    }
  }
  EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
}

// The table: odd, largest number 4.27, variance 0.99995 over all of its cells.
TEST(PixelNoise, NumbersBelongToThePixel) {
  const PixelNoise noise(kKey, core::Purpose::kTest, 3);
  std::map<int, float> all;
  ForEachPixelNoise(noise, 7, -384, 768, [&](int column, float z) { all[column] = z; });
  EXPECT_EQ(all.size(), 768U);
  // The same whatever part of the line is asked for.
  ForEachPixelNoise(noise, 7, -13, 30, [&](int column, float z) { EXPECT_EQ(all[column], z); });
  EXPECT_EQ(noise.At(7, -381), all[-381]);
  EXPECT_EQ(noise.At(7, 380), all[380]);
  EXPECT_NE(noise.At(8, 380), all[380]);
  EXPECT_NE(PixelNoise(kKey, core::Purpose::kTest, 4).At(7, 380), all[380]);
}

RenderedRow EvenRow(double rate_e_s, int columns) {
  RenderedRow row;
  row.row = 3;
  row.sun_e_s.assign(static_cast<std::size_t>(columns), rate_e_s);
  return row;
}

void ReadRow(const ImageReadout& readout, const RenderedRow& row, double exposure_s,
             core::TrialKey key, int camera, ImageNumber image, const std::vector<bool>& lamp_is_on,
             std::vector<std::uint16_t>& counts) {
  constexpr int kFirst = -384;
  const auto columns = static_cast<int>(row.sun_e_s.size());
  const PixelPattern pattern = readout.Pattern(camera, row.row, kFirst, columns, key);
  readout.Read(row, pattern, kFirst, exposure_s, key, image, lamp_is_on, counts);
}

struct Counts {
  double mean = 0.0;
  double sum_of_squares = 0.0;  // about the mean
  double size = 0.0;
};

Counts ReadEven(const ImagerParams& imager, double rate_e_s, double exposure_s,
                ImageNumber images) {
  const ImageReadout readout(imager, 0.0);
  std::vector<std::uint16_t> counts;
  for (ImageNumber image = 0; image < images; ++image) {
    ReadRow(readout, EvenRow(rate_e_s, 768), exposure_s, kKey, 0, image, {}, counts);
  }
  Counts result{.size = static_cast<double>(counts.size())};
  result.mean = std::accumulate(counts.begin(), counts.end(), 0.0) / result.size;
  for (const double count : counts) result.sum_of_squares += std::pow(count - result.mean, 2);
  return result;
}

// Variance of a count: (R t + D t + s^2) / g^2 for shot, dark and read noise, and 1/12 for
// rounding.
TEST(ImageReadout, TemporalNoiseIsShotReadDarkAndRounding) {
  ImagerParams imager = QuietImager();
  imager.ccd.adc_bits = 10;
  imager.ccd.read_noise_e = 60.0;
  imager.ccd.dark_current_e_s = 40000.0;
  const double gain = ImageReadout(imager, 0.0).electrons_per_count();
  for (const double rate_e_s : {2e3, 2e5, 1e6}) {
    constexpr double kTime_s = 0.02;
    const Counts counts = ReadEven(imager, rate_e_s, kTime_s, 40);
    const double electrons = (rate_e_s + 40000.0) * kTime_s;
    const double variance = (electrons + 3600.0) / (gain * gain) + 1.0 / 12.0;
    EXPECT_TRUE(FitsVariance(counts.sum_of_squares, variance, counts.size - 1.0)) << rate_e_s;
    EXPECT_FALSE(FitsVariance(counts.sum_of_squares, 1.05 * variance, counts.size - 1.0));
    const double black = 0.02 * 1023.0;
    EXPECT_NEAR(counts.mean, electrons / gain + black,
                kNormalBound * std::sqrt(variance / counts.size))
        << rate_e_s;
  }
}

// The mean over many images of a pixel keeps its own response and offset.
TEST(ImageReadout, PatternIsFixedForTheTrial) {
  ImagerParams imager = QuietImager();
  imager.ccd.response_nonuniformity = 0.02;
  imager.ccd.offset_nonuniformity_e = 50.0;
  const ImageReadout readout(imager, 0.0);
  constexpr int kColumns = 768;
  constexpr ImageNumber kImages = 200;
  constexpr double kElectrons = 20000.0;
  const auto means = [&](core::TrialKey key, int camera) {
    std::vector<double> mean(kColumns);
    for (ImageNumber image = 0; image < kImages; ++image) {
      std::vector<std::uint16_t> counts;
      ReadRow(readout, EvenRow(kElectrons, kColumns), 1.0, key, camera, image, {}, counts);
      for (std::size_t i = 0; i < counts.size(); ++i) {
        mean[i] += counts[i] * readout.electrons_per_count() / kImages;
      }
    }
    const double all = std::accumulate(mean.begin(), mean.end(), 0.0) / kColumns;
    for (double& m : mean) m -= all;
    return mean;
  };
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  const std::vector<double> first = means(kKey, 0);
  const double shot2 = kElectrons / kImages;
  const double pattern2 = std::pow(0.02 * kElectrons, 2) + 50.0 * 50.0;
  EXPECT_TRUE(FitsVariance(product(first, first), pattern2 + shot2, kColumns - 1.0));
  EXPECT_FALSE(FitsVariance(product(first, first), shot2, kColumns - 1.0));
  // Another camera and another trial have other patterns.
  const double bound = kNormalBound * std::sqrt(double{kColumns}) * (pattern2 + shot2);
  EXPECT_LT(std::abs(product(first, means(kKey, 1))), bound);
  EXPECT_LT(std::abs(product(first, means({kKey.seed, kKey.trial + 1}, 0))), bound);
  EXPECT_GT(product(first, means(kKey, 0)), bound);
}

// Relative standard deviation of a lamp's light alone: speckle and shot noise in quadrature.
TEST(ImageReadout, LampsHaveSpeckle) {
  ImagerParams imager = QuietImager();
  const auto sum_of_squares = [&](double contrast, bool lit) {
    const ImageReadout readout(imager, contrast);
    RenderedRow row = EvenRow(0.0, 768);
    for (int i = 0; i < 768; ++i) row.lamps.push_back({i, 0, 10000.0});
    std::vector<std::uint16_t> counts;
    for (ImageNumber image = 0; image < 20; ++image) {
      ReadRow(readout, row, 1.0, kKey, 0, image, {lit}, counts);
    }
    double sum = 0.0;
    for (const double count : counts) {
      const double electrons = (count - 0.02 * 65535.0) * readout.electrons_per_count();
      sum += std::pow(electrons - (lit ? 10000.0 : 0.0), 2);
    }
    return sum;
  };
  constexpr double kDegrees = 768.0 * 20.0;
  const double variance = 10000.0 + std::pow(0.2 * 10000.0, 2);
  EXPECT_TRUE(FitsVariance(sum_of_squares(0.2, true), variance, kDegrees));
  EXPECT_FALSE(FitsVariance(sum_of_squares(0.0, true), variance, kDegrees));
  EXPECT_TRUE(FitsVariance(sum_of_squares(0.0, true), 10000.0, kDegrees));
  EXPECT_LT(sum_of_squares(0.2, false), kDegrees);  // no light: rounding alone
}

// The two exposure times of a pair differ by the stated share.
TEST(ImageReadout, ExposureTimesRepeatWithinTheirTolerance) {
  ImagerParams imager;
  imager.exposure.repeatability = 0.004;
  const ImageReadout readout(imager, 0.0);
  double sum_of_squares = 0.0;
  constexpr ImageNumber kImages = 4000;
  for (ImageNumber image = 0; image < kImages; ++image) {
    const double ratio = readout.RepeatedTime(0.02, kKey, image) / 0.02;
    sum_of_squares += std::pow(ratio - 1.0, 2);
  }
  EXPECT_TRUE(FitsVariance(sum_of_squares, 0.004 * 0.004, kImages));
  EXPECT_FALSE(FitsVariance(sum_of_squares, 0.0044 * 0.0044, kImages));
}

// Statistics of noise and faults of whole images.

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
