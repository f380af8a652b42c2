// The sums of refine_match.h over a window, lane by lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rockyard::vision {

// 15 rows of 16 values, of which the last is not of the window.
inline constexpr std::size_t kTemplateRows = 15;
inline constexpr std::size_t kTemplateLanes = 16;

struct TemplateRows {
  const float* values;  // less their mean
  const float* across;  // gradients, 0 in the last lane
  const float* down;
  float mean;
};

// Where the window lies: its upper left pixel, and what is left of a pixel, 0 <= u, v < 1. 17
// columns and 16 rows are read.
struct TemplatePlace {
  const std::uint8_t* pixels;
  std::size_t stride;
  float u;
  float v;
};

// By lane, down the rows, d = what is seen there less the mean and the value. The last lane of d
// and of its squares says nothing.
struct TemplateSums {
  std::array<float, kTemplateLanes> d{};
  std::array<float, kTemplateLanes> across_d{};
  std::array<float, kTemplateLanes> down_d{};
  std::array<float, kTemplateLanes> squares{};
};

// The same bits on every instruction set: no lane depends on another, and nothing is fused.
void SumTemplate(const TemplateRows& rows, const TemplatePlace& place, TemplateSums& sums);

}  // namespace rockyard::vision
