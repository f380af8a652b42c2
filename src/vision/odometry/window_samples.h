// What an image shows between its pixels over a window, its gradients there, and the sums of
// refine_match.h over it, lane by lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"
#include "vision/odometry/feature.h"

namespace rockyard::vision {

// Windows have an odd side of up to 15 pixels: as many rows of 16 values, of which those behind the
// side are not of the window.
inline constexpr std::size_t kTemplateRows = 15;
inline constexpr std::size_t kTemplateLanes = 16;

struct TemplateRows {
  const float* values;  // less their mean
  const float* across;  // gradients, 0 behind the side
  const float* down;
  float mean;
  std::size_t side;
};

// Where the window lies: its upper left pixel, and what is left of a pixel, 0 <= u, v < 1. 17
// columns and side + 1 rows are read.
struct TemplatePlace {
  const std::uint8_t* pixels;
  std::size_t stride;
  float u;
  float v;
};

// By lane, down the rows, d = what is seen there less the mean and the value. Behind the side d and
// its squares say nothing.
struct TemplateSums {
  std::array<float, kTemplateLanes> d{};
  std::array<float, kTemplateLanes> across_d{};
  std::array<float, kTemplateLanes> down_d{};
  std::array<float, kTemplateLanes> squares{};
};

// Whether an image has a window about `middle`, with two columns more to the right and a row below,
// which are interpolated, and whatever SumTemplate reads behind a small one.
bool HasTemplate(const GrayImage& image, const Pixel& middle, std::size_t side);

// The same bits on every instruction set: no lane depends on another, and nothing is fused.
void SumTemplate(const TemplateRows& rows, const TemplatePlace& place, TemplateSums& sums);

// Which gradients of a window are found: half the difference of its neighbours.
enum class WindowGradients {
  kBoth,
  kAlongRow,  // in place of that down the rows the one along them times the row, from the middle
};

// A window of up to 15 x 15 pixels and its gradients; rows and lanes behind its side are 0.
struct WindowSamples {
  using Rows = std::array<float, kTemplateRows * kTemplateLanes>;
  // Of every lane, down the rows.
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

// Interpolates between four pixels at `middle` + by_offset o / (1 + by_distance . o) for the
// offsets o of the window and of one pixel about it; what lies outside of the image repeats its
// edge. The middle lies inside the image; 1 + by_distance . o >= 1/2 there, else it counts as 1/2.
// The side is odd.
// The same bits on every instruction set: numbers of 32 bits, no lane depends on another, and
// nothing is fused. Cost: 0.5 us with 64 bytes a vector, 0.2 us where the view does not change,
// more at the edge of the image.
WindowSamples SampleWindow(const GrayImage& image, const Pixel& middle, const ViewChange& view,
                           std::size_t side = kTemplateRows,
                           WindowGradients gradients = WindowGradients::kBoth);

// Places of a window's pixels in another view, in numbers of 32 bits: the window and a pixel about
// it, row by row.
inline constexpr int kWideReach = 8;
inline constexpr std::size_t kWideSide = 2 * kWideReach + 1;
// Whole vectors of up to 16 lanes: what comes behind the last pixel repeats the middle.
inline constexpr std::size_t kWidePixels = (kWideSide * kWideSide + 15) / 16 * 16;

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

// ViewChange about a pixel: (x, y) + (by_column across + by_row down) / (1 + near).
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
