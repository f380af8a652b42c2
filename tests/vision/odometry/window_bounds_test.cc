// Bounds of differences: their definition, with every instruction set, and that they are bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/random.h"
#include "plain_features.h"
#include "textured_image.h"
#include "vision/odometry/best_matches.h"
#include "vision/stereo/instruction_sets.h"

namespace rockyard::vision {
namespace {

// 9 sum |m_a - m_b| - 200 over blocks of 3 x 3 pixels, or 0.
int PlainBound(const PlainWindow& a, const PlainWindow& b, int side) {
  const auto mean = [side](const PlainWindow& window, int block_x, int block_y) {
    int sum = 0;
    for (int y = 3 * block_y; y < std::min(3 * block_y + 3, side); ++y) {
      for (int x = 3 * block_x; x < std::min(3 * block_x + 3, side); ++x) {
        sum += window[static_cast<std::size_t>(y * side + x)];
      }
    }
    return sum / 9;
  };
  int sum = 0;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) sum += std::abs(mean(a, x, y) - mean(b, x, y));
  }
  return std::max(0, 9 * sum - 200);
}

struct Windows {
  std::vector<PlainWindow> plain;
  WindowSet set;
};

Windows WindowsOf(const GrayImage& image, int count, int side, std::uint32_t number) {
  core::RandomStream stream({2018, 0}, core::Purpose::kTest, number);
  Windows windows{{}, WindowSet(static_cast<std::size_t>(count))};
  for (int i = 0; i < count; ++i) {
    const auto at = [&stream](int size) {
      return static_cast<std::int16_t>(core::SampleUniform(stream, 8.0, size - 8.0));
    };
    const Feature feature{at(image.width()), at(image.height()), 0};
    windows.plain.push_back(PlainWindowAt(image, feature, side));
    CopyWindow(image, feature, side, windows.set.At(static_cast<std::size_t>(i)));
  }
  return windows;
}

// One image against another, bounds of all from a group on.
void ExpectBounds(const GrayImage& first, const GrayImage& second, int count, int side,
                  std::size_t from) {
  const Windows own = WindowsOf(first, 9, side, 1);
  const Windows others = WindowsOf(second, count, side, 2);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    const SignatureSet signatures(others.set);
    const std::size_t whole = (others.plain.size() + SignatureSet::kGroup - 1) /
                              SignatureSet::kGroup * SignatureSet::kGroup;
    AlignedBuffer<std::uint16_t> bounds(whole - from);
    for (std::size_t i = 0; i < own.plain.size(); ++i) {
      signatures.FindBounds(SignatureOf(own.set.At(i)), from, {bounds.data(), bounds.size()});
      for (std::size_t j = from; j < others.plain.size(); ++j) {
        const int bound = bounds.data()[j - from];
        ASSERT_EQ(bound, PlainBound(own.plain[i], others.plain[j], side))
            << i << " and " << j << " of " << count << ", " << InstructionSet();
        ASSERT_LE(bound, PlainDifference(own.plain[i], others.plain[j]));
      }
    }
  }
}

TEST(WindowBoundsTest, AreThoseOfTheMeansOfBlocks) {
  for (const int side : {3, 9, 13, 15}) {
    for (const int count : {1, 4, 31, 32, 33, 130}) {
      ExpectBounds(RandomImage(60, 50, 256, 96U), RandomImage(60, 50, 256, 97U), count, side, 0);
    }
  }
  ExpectBounds(RandomImage(60, 50, 256, 96U), RandomImage(60, 50, 2, 97U), 130, 15, 64);
}

// Two grey levels at the limits: the largest sums fit into 16 bits.
TEST(WindowBoundsTest, WhiteAgainstBlack) {
  ExpectBounds(GrayImage(40, 40, 255), GrayImage(40, 40, 0), 40, 15, 0);
  ExpectBounds(GrayImage(40, 40, 9), GrayImage(40, 40, 8), 40, 15, 0);
}

// What they are good for: over smooth texture they say most of the difference, over noise little.
TEST(WindowBoundsTest, SayMostOfTheDifferenceOfSmoothImages) {
  const auto share = [](const GrayImage& image) {
    const Windows own = WindowsOf(image, 32, 15, 3);
    const Windows others = WindowsOf(image, 32, 15, 4);
    const SignatureSet signatures(others.set);
    AlignedBuffer<std::uint16_t> bounds(SignatureSet::kGroup);
    double bound = 0.0;
    double difference = 0.0;
    for (std::size_t i = 0; i < own.plain.size(); ++i) {
      signatures.FindBounds(SignatureOf(own.set.At(i)), 0, {bounds.data(), bounds.size()});
      for (std::size_t j = 0; j < others.plain.size(); ++j) {
        bound += bounds.data()[j];
        difference += PlainDifference(own.plain[i], others.plain[j]);
      }
    }
    return bound / difference;
  };
  EXPECT_GT(share(WaveTexture(3, 8.0, 40.0).Render(120, 90, 0.0, 0.0, 25.0, 1.5, 0)), 0.8);
  EXPECT_LT(share(RandomImage(120, 90, 256, 98U)), 0.4);
}

}  // namespace
}  // namespace rockyard::vision
