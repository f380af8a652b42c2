// Stereo by the scalar stages, with the buffers that they need.
#pragma once

#include <cstdint>
#include <vector>

#include "scalar_stages.h"
#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// How far a row is taken: a benchmark has the time of a stage as a difference.
enum class RowStage {
  kPrepare,  // sums of all candidates
  kCompare,  // and the best match of each left and right pixel
  kDecide,   // and checks and sub-pixel
};

// Goldberg 2002 as printed: a difference of Gaussians for the Laplacian, a parabola. The filter has
// the sides, gain and limit that were chosen for it on synthetic pairs.
StereoPipelineParams AsPrinted();

// Takes the Laplacian alone.
class ScalarPipeline {
 public:
  ScalarPipeline(const ScalarStages& stages, int width, const StereoPipelineParams& params);

  GrayImage Reduce(const GrayImage& image, int level) const;

  // Difference of Gaussians; `out` is of the image's size.
  void Filter(const GrayImage& image, GrayImage& out);

  // Disparities of filtered images of the width; nothing is written before kDecide.
  void Correlate(const GrayImage& left, const GrayImage& right, RowStage last, DisparityImage& out);

 private:
  const ScalarStages* stages_;
  ScalarFilter filter_;
  PeakLimits limits_;
  ScalarRows rows_;
  std::vector<std::uint16_t> columns_, scores_, left_best_, right_best_;
  std::vector<std::int16_t> left_index_, right_index_;
  std::vector<std::int32_t> sums_;
  std::vector<std::uint8_t> zeros_;
};

}  // namespace rockyard::vision
