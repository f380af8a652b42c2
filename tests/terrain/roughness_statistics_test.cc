// The roughness of the ground against the asked RMS and scaling.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "terrain/ground.h"

namespace rockyard::terrain {
namespace {

// Mean square over many grounds, at points far apart.
double MeanSquare(double hurst,
                  const std::function<double(const Ground&, double x_m, double y_m)>& value_m) {
  constexpr std::uint32_t kTrials = 40;
  constexpr int kPoints = 400;
  GroundParams params{.roughness_rms_m = 0.05, .hurst_exponent = hurst};
  double sum = 0.0;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    const Ground ground(params, {81, trial});
    for (int i = 0; i < kPoints; ++i) {
      sum += std::pow(value_m(ground, 1.37 * (i % 20) - 8.0, 1.61 * (i / 20) - 9.0), 2);
    }
  }
  return sum / kTrials / kPoints;
}

// 16000 heights, neighbours 1.4 m apart and so nearly independent: the mean square scatters by
// about 1.5 %. Alpha about 1e-3 at 5 %.
TEST(RoughnessStatisticsTest, RmsIsAsAsked) {
  const auto height_m = [](const Ground& ground, double x_m, double y_m) {
    return ground.Height(x_m, y_m);
  };
  EXPECT_NEAR(MeanSquare(0.8, height_m) / 0.0025, 1.0, 0.05);
  EXPECT_NEAR(MeanSquare(0.5, height_m) / 0.0025, 1.0, 0.05);
}

// Between the octaves' ends height differences grow as distance^H, within what a band-limited sum
// of five octaves allows; another exponent is told apart.
TEST(RoughnessStatisticsTest, DifferencesGrowWithTheHurstExponent) {
  // Structure function: mean squared height difference over a distance.
  const auto structure = [](double hurst, double distance_m) {
    return MeanSquare(hurst, [distance_m](const Ground& ground, double x_m, double y_m) {
      return ground.Height(x_m + distance_m, y_m) - ground.Height(x_m, y_m);
    });
  };
  const auto slope = [&](double hurst) {
    return 0.5 * std::log2(structure(hurst, 0.4) / structure(hurst, 0.1)) / 2.0;
  };
  const double rough = slope(0.4);
  const double smooth = slope(0.8);
  EXPECT_NEAR(rough, 0.4, 0.12);
  EXPECT_NEAR(smooth, 0.8, 0.12);
  EXPECT_GT(smooth - rough, 0.2);
}

}  // namespace
}  // namespace rockyard::terrain
