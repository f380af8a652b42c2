// Peaks of any responses are those of their definition, with every instruction set.
#include <gtest/gtest.h>

#include <cstdint>

#include "core/random.h"
#include "plain_features.h"
#include "vision/each_pixel.h"
#include "vision/odometry/harris.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/instruction_sets.h"

namespace rockyard::vision {
namespace {

// Whole numbers from `least` to `most`, of which many are equal.
Image<std::int64_t> RandomResponses(int width, int height, int least, int most) {
  core::RandomStream stream({2017, 0}, core::Purpose::kTest,
                            static_cast<std::uint32_t>(100 * width + height));
  return ImageOf<std::int64_t>(
      width, height, [&](int, int) { return core::SampleUniform(stream, least, most + 1); });
}

// Of an area by what `all` has, which is at (0, 0).
Features PlainPeaks(const Image<std::int64_t>& responses, const ImageArea& area, int reach,
                    std::int32_t threshold) {
  Features peaks;
  for (int y = area.top; y < area.bottom; ++y) {
    for (int x = area.left; x < area.right; ++x) {
      if (responses.At(x, y) < threshold || !IsPeak(responses, x, y, reach)) continue;
      peaks.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
                       static_cast<std::int32_t>(responses.At(x, y))});
    }
  }
  return peaks;
}

void ExpectSamePeaks(const Image<std::int64_t>& responses, const ImageArea& area, int reach,
                     std::int32_t threshold) {
  const auto write = [&](int row, std::int32_t* values) {
    for (int x = 0; x < responses.width(); ++x) {
      values[x] = static_cast<std::int32_t>(responses.At(x, row));
    }
  };
  const ImageArea all{0, responses.width(), 0, responses.height()};
  const Features expected = PlainPeaks(responses, area, reach, threshold);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    ASSERT_EQ(LocalMaxima(write, all, area, reach, threshold), expected)
        << responses.width() << " x " << responses.height() << ", reach " << reach << ", threshold "
        << threshold << ", " << InstructionSet();
  }
}

// What lies outside is smaller than the least response: -9 is a peak at an edge too.
TEST(LocalMaximaTest, NegativeResponsesUpToTheEdges) {
  for (const int width : {1, 2, 7, 31, 32, 33, 70}) {
    for (const int height : {1, 3, 4, 9, 22}) {
      const Image<std::int64_t> responses = RandomResponses(width, height, -9, -1);
      for (const int reach : {1, 2, 3, 6, 33}) {
        for (const std::int32_t threshold : {-100, -9, -2, 0}) {
          ExpectSamePeaks(responses, {0, width, 0, height}, reach, threshold);
        }
      }
    }
  }
}

// What lies around an area counts.
TEST(LocalMaximaTest, PeaksOfAPart) {
  const Image<std::int64_t> responses = RandomResponses(64, 40, -50, 50);
  for (const ImageArea& area :
       {ImageArea{0, 64, 0, 40}, ImageArea{5, 60, 7, 33}, ImageArea{0, 9, 0, 2},
        ImageArea{63, 64, 39, 40}, ImageArea{31, 33, 1, 39}, ImageArea{20, 20, 3, 9}}) {
    for (const int reach : {1, 3, 4, 11}) {
      for (const std::int32_t threshold : {-50, 0, 45}) {
        ExpectSamePeaks(responses, area, reach, threshold);
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::vision
