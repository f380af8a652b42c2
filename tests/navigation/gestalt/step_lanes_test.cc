#include "navigation/gestalt/step_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/random.h"

namespace rockyard::navigation {
namespace {

// One patch after the other, to the last bit.
TEST(StepLanesTest, FindsTheStepsThatItWouldFindOneByOne) {
  constexpr std::size_t kStride = 40;
  constexpr std::size_t kRoom = 8;
  core::RandomStream stream({4, 0}, core::Purpose::kTest, 41);
  std::array<std::vector<double>, 3> means_m;
  for (std::vector<double>& means : means_m) means.resize(7 * kStride + kRoom);
  for (std::size_t i = 0; i < means_m[0].size(); ++i) {
    const bool empty = core::SampleBernoulli(stream, 0.6);
    for (std::vector<double>& means : means_m) {
      means[i] =
          empty ? std::numeric_limits<double>::quiet_NaN() : core::SampleUniform(stream, -3.0, 3.0);
    }
  }
  std::vector<double> rise_x(kStride + kRoom), rise_y(kStride + kRoom);
  for (double& rise : rise_x) rise = core::SampleUniform(stream, -1.0, 1.0);
  for (double& rise : rise_y) rise = core::SampleUniform(stream, -1.0, 1.0);
  int flat = 0;
  for (const auto& [columns, rows] : {std::pair(1, 1), std::pair(2, 3), std::pair(5, 7)}) {
    const auto width = static_cast<std::size_t>(columns);
    const auto height = static_cast<std::size_t>(rows);
    for (std::size_t count = 0; count + width <= kStride; ++count) {
      std::vector<double> found(kStride + kRoom);
      FindSteps({{means_m[0].data(), means_m[1].data(), means_m[2].data()},
                 kStride,
                 width,
                 height,
                 rise_x.data(),
                 rise_y.data()},
                count, found.data());
      for (std::size_t patch = 0; patch < count; ++patch) {
        std::vector<double> above;
        for (std::size_t i = 0; i < width * height; ++i) {
          const std::size_t at = patch + i / width * kStride + i % width;
          const double z = means_m[2][at];
          if (z != z) continue;
          above.push_back(z - rise_x[patch] * means_m[0][at] - rise_y[patch] * means_m[1][at]);
        }
        const auto [low, high] = std::minmax_element(above.begin(), above.end());
        const double expected = above.empty() ? 0.0 : *high - *low;
        ASSERT_EQ(found[patch], expected) << columns << ", " << patch;
        flat += expected == 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(flat, 100);
}

}  // namespace
}  // namespace rockyard::navigation
