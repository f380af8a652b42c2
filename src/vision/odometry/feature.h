// Points of an image that can be found again in another one, and the words of visual odometry.
//
// A feature is a corner of a left image; a window is a square of pixels about it. The first image
// or pair is that of the keyframe, the second a later one; "in time" is between both left images.
// The eyes of a pair are the left and the right camera. The place of a feature is where it is to a
// fraction of a pixel, and how far, by its disparity. The residual of a window is the root mean
// square of what two windows differ by where they fit best, grey levels.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace rockyard::vision {

// A corner, on a whole pixel. 16 bits are enough, as images that are read or aligned have at most
// 16384 pixels a side.
struct Feature {
  std::int16_t column = 0;
  std::int16_t row = 0;
  std::int32_t strength = 0;  // the detector's response there (harris.h)

  bool operator==(const Feature&) const = default;
};

using Features = std::vector<Feature>;

// Two features that look alike, by their indices in the first and the second image.
struct FeatureMatch {
  std::int32_t first = 0;
  std::int32_t second = 0;
  std::int32_t difference = 0;  // sum of absolute differences of their windows, grey levels

  bool operator==(const FeatureMatch&) const = default;
};

using FeatureMatches = std::vector<FeatureMatch>;

// How one view of a plane follows from another, about a point: what the one view shows at the
// offset o (px) from the point, the other has at the offset by_offset o / (1 + by_distance . o).
struct ViewChange {
  Eigen::Matrix2d by_offset = Eigen::Matrix2d::Identity();
  Eigen::Vector2d by_distance = Eigen::Vector2d::Zero();  // 1/px
};

}  // namespace rockyard::vision
