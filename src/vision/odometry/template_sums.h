// The sums of refine_match.h over a window, lane by lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"

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

}  // namespace rockyard::vision
