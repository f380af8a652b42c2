// The renderer against plain supersampling, and bands against whole frames.
#include <gtest/gtest.h>

#include <cmath>

#include "core/distributions.h"
#include "image_reference.h"

namespace rockyard::sensing {
namespace {

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
  double sun = 0.0;
  double light = 0.0;
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

}  // namespace
}  // namespace rockyard::sensing
