// What an image shows between its pixels over a window, and its gradients there.
#pragma once

#include <array>
#include <cstddef>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"
#include "vision/odometry/template_sums.h"
#include "vision/odometry/view_change.h"

namespace rockyard::vision {

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

}  // namespace rockyard::vision
