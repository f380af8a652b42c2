// Variance and spectrum of textures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "rendering/picture/picture_kit.h"
#include "rendering/picture/texture_field.h"
#include "terrain/placed_rocks.h"

namespace rockyard::rendering {
namespace {

struct MeanAndError {
  double mean;
  double error;
};
MeanAndError Summarize(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  double square = 0.0;
  for (const double value : values) square += (value - mean) * (value - mean);
  const auto n = static_cast<double>(values.size());
  return {mean, std::sqrt(square / (n * (n - 1.0)))};
}

// Student's t of 15 degrees of freedom at alpha = 0.001, two-sided.
constexpr double kT15 = 4.073;

// Fields of 16 seeds; alpha 0.001 each for mean, variance and slope.
TEST(TextureStatistics, MeanVarianceAndSlopeAreAsStated) {
  std::vector<double> means, variances, slopes_u, slopes_v;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    TextureField field({1.0, 2.3, 0.1, 0.0125, 0.1}, {seed, 0}, core::Purpose::kTest);
    double sum = 0.0, square = 0.0, slope_u = 0.0, slope_v = 0.0;
    constexpr int kSide = 60;
    for (int i = 0; i < kSide; ++i) {
      for (int k = 0; k < kSide; ++k) {
        const TextureSample at = field.Mean(0.0371 * i, 0.0371 * k, {{1e-7, 0.0}, {0.0, 1e-7}});
        sum += at.value;
        square += at.value * at.value;
        slope_u += at.slope_u * at.slope_u;
        slope_v += at.slope_v * at.slope_v;
      }
    }
    constexpr double kSamples = kSide * kSide;
    const double slope = field.SlopeDeviation();
    means.push_back(sum / kSamples);
    variances.push_back(square / kSamples);
    slopes_u.push_back(slope_u / kSamples / (slope * slope));
    slopes_v.push_back(slope_v / kSamples / (slope * slope));
  }
  const MeanAndError mean = Summarize(means);
  EXPECT_LT(std::abs(mean.mean), kT15 * mean.error);
  for (const auto& ratios : {variances, slopes_u, slopes_v}) {
    const MeanAndError ratio = Summarize(ratios);
    EXPECT_LT(std::abs(ratio.mean - 1.0), kT15 * ratio.error);
    // The control: 5 % more would not pass.
    EXPECT_GT(std::abs(1.05 * ratio.mean - 1.0), kT15 * ratio.error);
  }
}

// Slope of the power spectrum over the plane of a square image, by a least-squares line through
// its logarithm over rings, from 1.5 to 20 cycles per longest wavelength.
double SpectralSlope(const std::vector<double>& image, int side, double pixel_m,
                     double lowest_per_m, double highest_per_m) {
  using Complex = std::complex<double>;
  const auto n = static_cast<std::size_t>(side);
  double mean = 0.0;
  for (const double value : image) mean += value / static_cast<double>(image.size());
  const auto window = [&](std::size_t i) {  // Hann's
    return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / side);
  };
  std::vector<Complex> turns(n);
  for (std::size_t i = 0; i < n; ++i) {
    turns[i] = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(i) / side);
  }
  const auto transform = [&](std::vector<Complex>& line) {
    std::vector<Complex> out(n);
    for (std::size_t f = 0; f < n; ++f) {
      for (std::size_t i = 0; i < n; ++i) out[f] += line[i] * turns[f * i % n];
    }
    line = out;
  };
  std::vector<std::vector<Complex>> rows(n);
  for (std::size_t y = 0; y < n; ++y) {
    for (std::size_t x = 0; x < n; ++x) {
      rows[y].push_back((image[y * n + x] - mean) * window(x) * window(y));
    }
    transform(rows[y]);
  }
  constexpr int kRings = 8;
  std::vector<double> power(kRings), count(kRings);
  for (std::size_t x = 0; x < n; ++x) {
    std::vector<Complex> column(n);
    for (std::size_t y = 0; y < n; ++y) column[y] = rows[y][x];
    transform(column);
    for (std::size_t y = 0; y < n; ++y) {
      const auto frequency = [&](std::size_t i) {
        const auto k = static_cast<double>(i);
        return std::min(k, side - k) / (side * pixel_m);
      };
      const double f = std::hypot(frequency(x), frequency(y));
      const double ring =
          kRings * std::log(f / lowest_per_m) / std::log(highest_per_m / lowest_per_m);
      if (!(ring >= 0.0 && ring < kRings)) continue;
      power[static_cast<std::size_t>(ring)] += std::norm(column[y]);
      count[static_cast<std::size_t>(ring)] += 1.0;
    }
  }
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t r = 0; r < kRings; ++r) {
    const double x =
        (static_cast<double>(r) + 0.5) / kRings * std::log(highest_per_m / lowest_per_m);
    const double y = std::log(power[r] / count[r]);
    sx += x / kRings;
    sy += y / kRings;
    sxx += x * x / kRings;
    sxy += x * y / kRings;
  }
  return (sxy - sx * sy) / (sxx - sx * sx);
}

// A view straight down on soil without relief, in even light: 160 x 160 pixels of 4 mm.
double SlopeOfNadirView(double exponent) {
  LookParams look = PlainLook();
  look.drift = {0.1, exponent, 0.32, 0.005, 0.0};
  look.soil_graininess = 0.0;
  constexpr int kSide = 160;
  constexpr double kPixel_m = 0.004;
  const terrain::Terrain terrain = terrain::FlatWith({});
  const PictureKit kit(terrain, SunParams{}, look, NadirAt(20.0, kSide, kSide, kPixel_m));
  const Picture picture = kit.Render();
  const auto values = picture.radiance_w_m2_sr.values();
  return SpectralSlope({values.begin(), values.end()}, kSide, kPixel_m, 1.5 / 0.32, 16.0 / 0.32);
}

// Rings of some tens to thousands of frequencies over 3.4 octaves: the scatter of the slope is
// below 0.1 (over 8 seeds), and steps of an octave add as much. A texture whose exponent is off by
// 0.8 does not pass.
TEST(TextureStatistics, SpectrumOfANadirViewHasTheStatedExponent) {
  constexpr double kTolerance = 0.35;
  for (const double exponent : {1.8, 2.6, 3.4}) {
    const double slope = SlopeOfNadirView(exponent);
    EXPECT_NEAR(-slope, exponent, kTolerance);
    EXPECT_GT(std::abs(-slope - (exponent + 0.8)), kTolerance);
    EXPECT_GT(std::abs(-slope - (exponent - 0.8)), kTolerance);
  }
}

}  // namespace
}  // namespace rockyard::rendering
