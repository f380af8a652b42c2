// Windows between pixels, for the searches of refine_match.h: what an image shows there
// (SampleWindow), and sums of differences to another window (SumTemplate). Records depend on every
// bit: both give the same on every instruction set, as they use numbers of 32 bits, no lane depends
// on another, and nothing is fused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"
#include "vision/odometry/feature.h"

namespace rockyard::vision {

// Windows have an odd side of up to 15 pixels, and as many rows of 16 values each; values behind
// the side do not belong to the window.
inline constexpr std::size_t kTemplateRows = 15;
inline constexpr std::size_t kTemplateLanes = 16;

// The window that is searched for.
struct TemplateRows {
  const float* values;  // less their mean
  const float* across;  // gradients, 0 behind the side
  const float* down;
  float mean;
  std::size_t side;
};

// Where in the other image the window is compared: its upper left pixel, and the fractions of a
// pixel 0 <= u, v < 1. 17 columns and side + 1 rows are read.
struct TemplatePlace {
  const std::uint8_t* pixels;
  std::size_t stride;
  float u;
  float v;
};

// Sums of each lane (column of the window) over its rows, with d = the grey level at the place less
// mean and value of the TemplateRows. Behind the side d and its squares mean nothing.
struct TemplateSums {
  std::array<float, kTemplateLanes> d{};
  std::array<float, kTemplateLanes> across_d{};
  std::array<float, kTemplateLanes> down_d{};
  std::array<float, kTemplateLanes> squares{};
};

// Returns whether SumTemplate may be called: the image has the window about `middle`, two columns
// to its right and a row below, between which it interpolates, and what else it reads.
bool HasTemplate(const GrayImage& image, const Pixel& middle, std::size_t side);

// Fills `sums`. Requires HasTemplate.
void SumTemplate(const TemplateRows& rows, const TemplatePlace& place, TemplateSums& sums);

// Which gradients SampleWindow finds. A gradient is half the difference of a pixel's neighbours.
enum class WindowGradients {
  kBoth,
  kAlongRow,  // `down` becomes the gradient along the row times the row, counted from the middle
};

// A window of up to 15 x 15 pixels and its gradients; rows and lanes behind its side are 0.
struct WindowSamples {
  using Rows = std::array<float, kTemplateRows * kTemplateLanes>;
  // Sums of every lane over its rows.
  using Lanes = std::array<float, kTemplateLanes>;

  Rows values;
  Rows across;
  Rows down;
  Lanes sum;
  Lanes across_sum;
  Lanes down_sum;
  Lanes across_across;
  Lanes across_down;
  Lanes down_down;
};

// Samples a window as another view has it: interpolates between four pixels at
// `middle` + by_offset o / (1 + by_distance . o) for the offsets o of the window and of one pixel
// about it. Outside of the image its edge repeats. `middle` lies inside the image;
// 1 + by_distance . o counts as 1/2 where it is smaller. The side is odd. Cost: 0.5 us with 64
// bytes a vector, 0.2 us where the view does not change, more at the edge of the image. Must stay:
// which of its three loops runs (by the exact test for an unchanged view and by HasAll), as an
// unchanged view is rounded otherwise at the edge of the image than inside.
WindowSamples SampleWindow(const GrayImage& image, const Pixel& middle, const ViewChange& view,
                           std::size_t side = kTemplateRows,
                           WindowGradients gradients = WindowGradients::kBoth);

// A wide window is a window of 15 x 15 pixels with one pixel about it, row by row.
inline constexpr int kWideReach = 8;
inline constexpr std::size_t kWideSide = 2 * kWideReach + 1;
// Whole vectors of up to 16 lanes; behind the last pixel they repeat the middle.
inline constexpr std::size_t kWidePixels = (kWideSide * kWideSide + 15) / 16 * 16;

// The offsets o of the pixels of a wide window.
struct WideOffsets {
  std::array<float, kWidePixels> across{};
  std::array<float, kWidePixels> down{};
};

inline constexpr WideOffsets kWideOffsets = [] {
  WideOffsets offsets;
  for (std::size_t i = 0; i < kWideSide * kWideSide; ++i) {
    const std::size_t row = i / kWideSide;
    offsets.across[i] = static_cast<float>(i % kWideSide) - static_cast<float>(kWideReach);
    offsets.down[i] = static_cast<float>(row) - static_cast<float>(kWideReach);
  }
  return offsets;
}();

// A ViewChange about a pixel: the place of the offset (across, down) is (x, y) +
// (by_column across + by_row down) / (1 + near_by_column across + near_by_row down).
struct WindowView {
  float x;
  float y;
  float x_by_column;
  float x_by_row;
  float y_by_column;
  float y_by_row;
  float near_by_column;
  float near_by_row;
};

}  // namespace rockyard::vision
