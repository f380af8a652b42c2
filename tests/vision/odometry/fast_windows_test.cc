// Windows and peaks have the bits of their plain definitions, with every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/random.h"
#include "plain_features.h"
#include "textured_image.h"
#include "vision/each_pixel.h"
#include "vision/odometry/best_matches.h"
#include "vision/odometry/harris.h"
#include "vision/odometry/window_samples.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/instruction_sets.h"

namespace rockyard::vision {
namespace {

// Windows between pixels: bits as a plain loop has them, and what a plane of grey levels shows.

GrayImage Noise(int width, int height) {
  core::RandomStream stream({260, 0}, core::Purpose::kTest, 0);
  return ImageOf(width, height, [&](int, int) { return stream.NextU32() & 0xFF; });
}

float PlainGrey(const GrayImage& image, const Pixel& middle, const ViewChange& view, float across,
                float down) {
  const auto number = [](double value) { return static_cast<float>(value); };
  const int column = static_cast<int>(middle.x());
  const int row = static_cast<int>(middle.y());
  const float distance = std::max(
      1.0F + (number(view.by_distance.x()) * across + number(view.by_distance.y()) * down), 0.5F);
  const auto place = [&](int i) {
    return (number(view.by_offset(i, 0)) * across + number(view.by_offset(i, 1)) * down) / distance;
  };
  // Inside of the image and without a change of view fractions are the middle's; else they are
  // those of each place, which rounds otherwise.
  const bool inside = middle.minCoeff() >= 8.0 && middle.x() + 8.0 + 3.0 < image.width() &&
                      middle.y() + 8.0 + 1.0 < image.height();
  const bool same = inside && view.by_offset.isIdentity(0.0) && view.by_distance.isZero(0.0);
  const float x_of_pixel = same ? 0.0F : number(middle.x() - column);
  const float y_of_pixel = same ? 0.0F : number(middle.y() - row);
  const float x = x_of_pixel + place(0);
  const float y = y_of_pixel + place(1);
  const auto grey = [&](int right, int below) {
    return static_cast<float>(
        image.At(std::clamp(column + static_cast<int>(std::floor(x)) + right, 0, image.width() - 1),
                 std::clamp(row + static_cast<int>(std::floor(y)) + below, 0, image.height() - 1)));
  };
  const float u = same ? number(middle.x() - column) : x - std::floor(x);
  const float v = same ? number(middle.y() - row) : y - std::floor(y);
  const float above = grey(0, 0) + u * (grey(1, 0) - grey(0, 0));
  const float below = grey(0, 1) + u * (grey(1, 1) - grey(0, 1));
  return above + v * (below - above);
}

WindowSamples PlainSamples(const GrayImage& image, const Pixel& middle, const ViewChange& view,
                           std::size_t side, WindowGradients gradients) {
  WindowSamples plain{};
  const auto reach = static_cast<float>(side / 2);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      const float across = static_cast<float>(column) - reach;
      const float down = static_cast<float>(row) - reach;
      const auto grey = [&](float x, float y) {
        return PlainGrey(image, middle, view, across + x, down + y);
      };
      const float value = grey(0, 0);
      const float gx = 0.5F * (grey(1, 0) - grey(-1, 0));
      const float gy =
          gradients == WindowGradients::kBoth ? 0.5F * (grey(0, 1) - grey(0, -1)) : gx * down;
      const std::size_t at = row * kTemplateLanes + column;
      plain.values[at] = value;
      plain.across[at] = gx;
      plain.down[at] = gy;
      plain.sum[column] += value;
      plain.across_sum[column] += gx;
      plain.down_sum[column] += gy;
      plain.across_across[column] += gx * gx;
      plain.across_down[column] += gx * gy;
      plain.down_down[column] += gy * gy;
    }
  }
  return plain;
}

void ExpectSame(const WindowSamples& a, const WindowSamples& b) {
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.across, b.across);
  EXPECT_EQ(a.down, b.down);
  EXPECT_EQ(a.sum, b.sum);
  EXPECT_EQ(a.across_sum, b.across_sum);
  EXPECT_EQ(a.down_sum, b.down_sum);
  EXPECT_EQ(a.across_across, b.across_across);
  EXPECT_EQ(a.across_down, b.across_down);
  EXPECT_EQ(a.down_down, b.down_down);
}

// In the middle, at whole pixels, where the last column and row are just read, and over the edge;
// views that turn, shrink, and vanish towards a horizon.
TEST(WindowSamplesTest, HaveTheBitsOfAPlainLoop) {
  const GrayImage image = Noise(61, 47);
  std::vector<ViewChange> views(4);
  views[1].by_offset << 0.8, 0.3, -0.25, 1.2;
  views[2].by_offset << 1.1, 0.1, 0.05, 1.3;
  views[2].by_distance << 0.004, -0.02;
  views[3].by_offset << 3.0, -2.0, 2.0, 3.0;
  views[3].by_distance << 0.1, 0.1;  // nearer than half at a corner
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    for (const ViewChange& view : views) {
      for (const Pixel& middle :
           {Pixel(30.3, 22.8), Pixel(25.0, 20.0), Pixel(8.0, 8.0), Pixel(49.9, 37.9),
            Pixel(50.1, 38.2), Pixel(0.2, 46.0), Pixel(60.0, 0.0)}) {
        for (const auto gradients : {WindowGradients::kBoth, WindowGradients::kAlongRow}) {
          for (const std::size_t side : {5U, 7U, 9U, 15U}) {
            SCOPED_TRACE(middle.transpose());
            ExpectSame(SampleWindow(image, middle, view, side, gradients),
                       PlainSamples(image, middle, view, side, gradients));
          }
        }
      }
    }
  }
}

// Grey levels that rise by 2 a column and 3 a row show where each pixel of the window was taken.
TEST(WindowSamplesTest, ShowWhatLiesWhereTheViewPutsIt) {
  const GrayImage image = ImageOf(60, 40, [](int x, int y) { return 2 * x + 3 * y; });
  ViewChange view;
  view.by_offset << 0.9, 0.2, 0.1, 0.7;
  view.by_distance << 0.01, -0.015;
  const Pixel middle(28.25, 19.5);
  const WindowSamples samples = SampleWindow(image, middle, view);
  ForEachPixel(15, 15, [&](int column, int row) {
    const Pixel offset(column - 7, row - 7);
    const Pixel place = middle + view.by_offset * offset / (1.0 + view.by_distance.dot(offset));
    const auto at =
        static_cast<std::size_t>(row) * kTemplateLanes + static_cast<std::size_t>(column);
    EXPECT_NEAR(samples.values[at], 2.0 * place.x() + 3.0 * place.y(), 1e-4);
  });
}

// Bounds of differences: their definition, with every instruction set, and that they are bounds.

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
  ForEachPixel(5, 5, [&](int x, int y) { sum += std::abs(mean(a, x, y) - mean(b, x, y)); });
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
    double bound = 0.0, difference = 0.0;
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

// Peaks of any responses are those of their definition, with every instruction set.

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
