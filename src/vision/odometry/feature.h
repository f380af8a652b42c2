// Points of an image that can be found again in another one.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace rockyard::vision {

// A corner, on a whole pixel. Sides of images that are read or aligned end at 16384 pixels, which
// 16 bits hold.
struct Feature {
  std::int16_t column = 0;
  std::int16_t row = 0;
  std::int32_t strength = 0;  // what the detector found there; of one detector, larger is better

  bool operator==(const Feature&) const = default;
};

using Features = std::vector<Feature>;

// Features of two images that look alike, by their indices.
struct FeatureMatch {
  std::int32_t first = 0;
  std::int32_t second = 0;
  std::int32_t difference = 0;  // sum of absolute differences of their windows, grey levels

  bool operator==(const FeatureMatch&) const = default;
};

using FeatureMatches = std::vector<FeatureMatch>;

// How one view of a plane follows from another, about a point: what the one shows at the offset o
// (px) from it, the other has at the offset by_offset o / (1 + by_distance . o).
struct ViewChange {
  Eigen::Matrix2d by_offset = Eigen::Matrix2d::Identity();
  Eigen::Vector2d by_distance = Eigen::Vector2d::Zero();  // 1/px
};

}  // namespace rockyard::vision
