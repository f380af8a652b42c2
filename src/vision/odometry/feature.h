// Points of an image that can be found again in another one.
#pragma once

#include <cstdint>
#include <vector>

namespace rockyard::vision {

// A corner, on a whole pixel.
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

}  // namespace rockyard::vision
