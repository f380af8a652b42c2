// Windows between pixels: bits as a plain loop has them, and what a plane of grey levels shows.
#include "vision/odometry/window_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "vision/each_pixel.h"
#include "vision/stereo/instruction_sets.h"

namespace rockyard::vision {
namespace {

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

}  // namespace
}  // namespace rockyard::vision
