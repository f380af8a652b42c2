#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "rendering/picture/picture_kit.h"
#include "rendering/picture/terrain_look.h"
#include "rendering/picture/texture_field.h"
#include "terrain/placed_rocks.h"
#include "vision/each_pixel.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// Variance and spectrum of textures.

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
    vision::ForEachPixel(kSide, kSide, [&](int k, int i) {
      const TextureSample at = field.Mean(0.0371 * i, 0.0371 * k, {{1e-7, 0.0}, {0.0, 1e-7}});
      sum += at.value;
      square += at.value * at.value;
      slope_u += at.slope_u * at.slope_u;
      slope_v += at.slope_v * at.slope_v;
    });
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

// Albedo and relief on soil and rocks.

constexpr core::TrialKey kKey{6, 1};
const Vector3 kTinyX(1e-6, 0.0, 0.0);
const Vector3 kTinyY(0.0, 1e-6, 0.0);

SurfacePoint PointAt(const Vector3& p_W, const Vector3& normal_W, int surface) {
  return {.p_W = p_W, .normal_W = normal_W.normalized(), .surface = surface};
}

TEST(TerrainLook, WithoutTextureSurfacesAreAsTheSunSays) {
  const terrain::Terrain terrain =
      terrain::FlatWith({terrain::EllipsoidRock(1.0, 0.0, 0.0, 0.2, 0.2, 0.2)});
  const SunParams sun;
  TerrainLook look(terrain, sun, PlainLook(), kKey);
  const Vector3 n = Vector3(0.3, 0.2, 0.8).normalized();
  const auto at = [&](int surface) {
    return look.At(PointAt({1.0, 0.0, 0.2}, n, surface), kTinyX, kTinyY);
  };
  EXPECT_DOUBLE_EQ(at(SurfacePoint::kGround).albedo, sun.ground_albedo);
  EXPECT_DOUBLE_EQ(at(0).albedo, sun.rock_albedo);
  EXPECT_DOUBLE_EQ(at(SurfacePoint::kWall).albedo, sun.rock_albedo);
  EXPECT_DOUBLE_EQ(at(SurfacePoint::kRover).albedo, sun.rover_albedo);
  for (const int surface : {SurfacePoint::kGround, 0, SurfacePoint::kWall, SurfacePoint::kRover}) {
    EXPECT_LT((at(surface).normal_W - n).norm(), 1e-12) << surface;
  }
}

// The normal on soil is that of the surface z = relief * v, by differences of the albedo.
TEST(TerrainLook, ReliefGoesWithTheAlbedo) {
  const LookParams params{.soil_graininess = 0.0, .drift = {0.1, 3.0, 0.4, 0.1, 0.2}};
  const SunParams sun;
  const terrain::Terrain terrain = terrain::FlatWith({});
  TerrainLook look(terrain, sun, params, kKey);
  TextureField field(params.drift, kKey, core::Purpose::kSoilTexture);
  const auto albedo = [&](double x, double y) {
    return look.At(PointAt({x, y, 0.0}, Vector3::UnitZ(), SurfacePoint::kGround), kTinyX, kTinyY);
  };
  double square = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.731 * i;
    const double y = -0.413 * i;
    constexpr double kStep_m = 1e-3;
    // v = (albedo / mean - 1) / contrast; relief = slope / deviation of the gradient.
    const double relief_m = 0.2 / field.SlopeDeviation();
    const double per_albedo = relief_m / (0.1 * sun.ground_albedo);
    const Vector3 normal(
        -per_albedo * (albedo(x + kStep_m, y).albedo - albedo(x - kStep_m, y).albedo) /
            (2 * kStep_m),
        -per_albedo * (albedo(x, y + kStep_m).albedo - albedo(x, y - kStep_m).albedo) /
            (2 * kStep_m),
        1.0);
    const Vector3 seen = albedo(x, y).normal_W;
    EXPECT_LT((seen - normal.normalized()).norm(), 0.003);
    square += std::pow(seen.x() / seen.z(), 2) / 100;
  }
  EXPECT_NEAR(std::sqrt(square), 0.2, 0.05);
}

// On a rock that is turned, the texture turns with it; it moves with it, too.
TEST(TerrainLook, TextureIsFixedToTheRock) {
  const auto look_at = [](const terrain::Rock& rock, const Vector3& p, const Vector3& n) {
    const terrain::Terrain terrain = terrain::FlatWith({rock});
    TerrainLook look(terrain, SunParams{}, LookParams{}, kKey);
    return look.At(PointAt(p, n, 0), kTinyX, kTinyY);
  };
  const terrain::Rock one = terrain::EllipsoidRock(1.0, 0.5, 0.1, 0.3, 0.3, 0.3);
  terrain::Rock other = terrain::EllipsoidRock(-2.0, 3.0, 0.2, 0.3, 0.3, 0.3, 0.7);
  const auto turn = Eigen::AngleAxisd(0.7, Vector3::UnitZ()).toRotationMatrix();
  double least = 1.0, most = 0.0;
  for (int i = 0; i < 40; ++i) {
    const Vector3 n = Vector3(std::cos(i), std::sin(i), 0.05 * i - 0.6).normalized();
    const SurfaceLook here = look_at(one, one.center_W + 0.3 * n, n);
    const SurfaceLook there = look_at(other, other.center_W + 0.3 * turn * n, turn * n);
    EXPECT_NEAR(there.albedo, here.albedo, 1e-6);
    EXPECT_LT((there.normal_W - turn * here.normal_W).norm(), 1e-4);
    EXPECT_LT(std::abs(here.normal_W.norm() - 1.0), 1e-12);
    least = std::min(least, here.albedo);
    most = std::max(most, here.albedo);
  }
  EXPECT_GT(most - least, 0.01);
}

// Over many rocks: mean and deviation of their albedos, and of the texture where faces blend.
TEST(TerrainLook, RocksDifferAsMuchAsStated) {
  std::vector<terrain::Rock> rocks(2000, terrain::EllipsoidRock(0, 0, 0, 0.1, 0.1, 0.1));
  const terrain::Terrain terrain = terrain::FlatWith(rocks);
  const auto statistics = [&](double spread, double contrast, const Vector3& n) {
    LookParams params = PlainLook();
    params.rock_albedo_spread = spread;
    params.rock.contrast = contrast;
    TerrainLook look(terrain, SunParams{}, params, kKey);
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double ratio = look.At(PointAt(0.1 * n, n, i), kTinyX, kTinyY).albedo / 0.2;
      sum += ratio / 2000;
      square += ratio * ratio / 2000;
    }
    return std::pair(sum, std::sqrt(square - sum * sum));
  };
  // A deviation from 2000 is good to 1.6 %: 3.29 times that for alpha 0.001. The control is 10 %
  // off. Texture pieces repeat and neighbour each other, so theirs is good to a few percent.
  const auto [mean, spread] = statistics(0.15, 0.0, Vector3::UnitZ());
  EXPECT_NEAR(mean, 1.0, 3.29 * 0.15 / std::sqrt(2000.0));
  EXPECT_NEAR(spread, 0.15, 0.15 * 0.052);
  EXPECT_GT(std::abs(spread - 1.1 * 0.15), 0.15 * 0.052);
  for (const Vector3& n : {Vector3(1, 0, 0), Vector3(1, 1, 1), Vector3(1, -1, 0.1)}) {
    EXPECT_NEAR(statistics(0.0, 0.1, n.normalized()).second, 0.1, 0.012);
  }
}

// With few taps a strip of ground is blurred across: its texture is paler.
TEST(TerrainLook, TapsKeepTheTextureOfStrips) {
  const terrain::Terrain terrain = terrain::FlatWith({});
  const auto deviation = [&](std::int64_t taps) {
    const LookParams params{
        .soil_graininess = 0.0, .drift = {0.1, 2.0, 0.05, 0.003125, 0.0}, .texture_taps = taps};
    TerrainLook look(terrain, {}, params, kKey);
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < 400; ++i) {
      const auto point =
          PointAt({0.31 * i, 0.17 * i, 0.0}, Vector3::UnitZ(), SurfacePoint::kGround);
      const double albedo = look.At(point, {0.01, 0.0, 0.0}, {0.0, 0.08, 0.0}).albedo;
      sum += albedo / 400;
      square += albedo * albedo / 400;
    }
    return std::sqrt(std::max(square - sum * sum, 0.0));  // rounding, of one value
  };
  EXPECT_LT(deviation(1), 0.8 * deviation(4));
  EXPECT_LT(deviation(4), 0.95 * deviation(8));
  // The strip is eight times as long as wide: more taps would be the same.
  EXPECT_DOUBLE_EQ(deviation(8), deviation(16));
}

}  // namespace
}  // namespace rockyard::rendering
