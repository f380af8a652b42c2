// The exposure time of a camera.
#include "rendering/exposure_control.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rockyard::rendering {
namespace {

TEST(ExposureControl, BringsTheBrightPixelsToTheTarget) {
  ImagerParams imager;  // 60000 e full well, target 0.4, 1000 e/s dark current
  imager.exposure.brightest_share = 0.1;
  std::vector<double> rates;
  for (int i = 1; i <= 100; ++i) rates.push_back(1e4 * i);
  // Ten of the hundred may be brighter than 9e5 e/s.
  EXPECT_NEAR(ExposureTime(imager, rates), 24000.0 / 901000.0, 1e-12);
  std::reverse(rates.begin(), rates.end());
  EXPECT_NEAR(ExposureTime(imager, rates), 24000.0 / 901000.0, 1e-12);
  EXPECT_EQ(ExposureTime(imager, std::vector<double>(9, 1e12)), imager.exposure.shortest_s);
  EXPECT_EQ(ExposureTime(imager, std::vector<double>(9, 0.0)), imager.exposure.longest_s);
  EXPECT_EQ(ExposureTime(imager, {}), imager.exposure.longest_s);
}

}  // namespace
}  // namespace rockyard::rendering
