// The roughness of the ground against the asked RMS and scaling.
#include <gtest/gtest.h>

#include "terrain/ground.h"

namespace rockyard::terrain {
namespace {

Ground Rough(double hurst, std::uint32_t trial) {
  GroundParams params;
  params.roughness_rms_m = 0.05;
  params.hurst_exponent = hurst;
  return Ground(params, {81, trial});
}

// Mean square height over many grounds, at points far apart.
double MeanSquare(double hurst) {
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t trial = 0; trial < 40; ++trial) {
    const Ground ground = Rough(hurst, trial);
    for (int i = 0; i < 400; ++i) {
      const double height = ground.Height(1.37 * (i % 20) - 8.0, 1.61 * (i / 20) - 9.0);
      sum += height * height;
      ++count;
    }
  }
  return sum / count;
}

// 16000 heights, neighbours 1.4 m apart and so nearly independent: the mean square scatters by
// about 1.5 %. Alpha about 1e-3 at 5 %.
TEST(RoughnessStatisticsTest, RmsIsAsAsked) {
  EXPECT_NEAR(MeanSquare(0.8) / 0.0025, 1.0, 0.05);
  EXPECT_NEAR(MeanSquare(0.5) / 0.0025, 1.0, 0.05);
}

// Structure function: mean squared height difference over a distance.
double Structure(double hurst, double distance_m) {
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t trial = 0; trial < 40; ++trial) {
    const Ground ground = Rough(hurst, trial);
    for (int i = 0; i < 400; ++i) {
      const double x = 1.37 * (i % 20) - 8.0;
      const double y = 1.61 * (i / 20) - 9.0;
      const double difference = ground.Height(x + distance_m, y) - ground.Height(x, y);
      sum += difference * difference;
      ++count;
    }
  }
  return sum / count;
}

// Between the octaves' ends height differences grow as distance^H, within what a band-limited sum
// of five octaves allows; another exponent is told apart.
TEST(RoughnessStatisticsTest, DifferencesGrowWithTheHurstExponent) {
  const auto slope = [](double hurst) {
    return 0.5 * std::log2(Structure(hurst, 0.4) / Structure(hurst, 0.1)) / 2.0;
  };
  const double rough = slope(0.4);
  const double smooth = slope(0.8);
  EXPECT_NEAR(rough, 0.4, 0.12);
  EXPECT_NEAR(smooth, 0.8, 0.12);
  EXPECT_GT(smooth - rough, 0.2);
}

}  // namespace
}  // namespace rockyard::terrain
