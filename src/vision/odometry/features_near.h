// Which features lie near a place: MatchFeatures compares those near a prediction.
#pragma once

#include <cstdint>
#include <span>

#include "vision/cameras/camera_types.h"
#include "vision/odometry/feature.h"
#include "vision/stereo/aligned_buffer.h"

namespace rockyard::vision {

class FeaturesNear {
 public:
  explicit FeaturesNear(const Features& features);

  // Returns the indices of the features at most so many columns and rows (>= 0) from `place`, none
  // where `place` is not finite. Must stay in ascending order, as matching decides ties by it. The
  // result is valid until the next call. Cost: 0.2 us for 400 features with 64 bytes a vector.
  std::span<const std::int32_t> Find(const Pixel& place, double columns_px, double rows_px);

 private:
  std::size_t count_;
  AlignedBuffer<std::int32_t> columns_;
  AlignedBuffer<std::int32_t> rows_;
  AlignedBuffer<std::int32_t> found_;
};

}  // namespace rockyard::vision
