// Corners of an image, evenly over its regions (Howard 2012 section 2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"
#include "vision/odometry/feature.h"
#include "vision/odometry/feature_params.h"
#include "vision/odometry/harris.h"

namespace rockyard::vision {

// The detector for images of one size and one mask.
//
// Region i of n covers the columns from i w / n, rounded down, to (i + 1) w / n, rows likewise. A
// corner is a pixel whose response (harris.h) is larger than that of the pixels within
// suppression_px columns and rows before it in the order of rows, and not smaller than that of
// those behind it. Of a region's corners at least as strong as the threshold, the strongest
// max_of_region() are features. Where there are fewer than min_of_region(), weaker ones follow down
// to min_threshold (Adapted::kThreshold); or the weight of the trace is bisected between 0 and 0.24
// until the number lies between both (Adapted::kWeight), eight times at most.
class FeatureDetector {
 public:
  // `free`: pixels that show the world (1) and not the carrier (0), of the images' size; empty
  // where all do. Features keep border_px from the edges and from what is not free.
  FeatureDetector(const FeatureDetectorParams& params, const ImageSize& size,
                  const Image<std::uint8_t>& free = {});

  // The features, region by region in the order of rows, within a region from the strongest on,
  // then in the order of rows, by which ties of matching go. Pure function; `image` has the
  // detector's size. Cost: 0.4 ms for 512 x 384 pixels with 64 bytes a vector, eight times that
  // where the weight is adapted.
  Features Detect(const GrayImage& image) const;

 private:
  ImageArea Region(std::int64_t across, std::int64_t down) const;
  GradientSums SumsAround(const GrayImage& image, const ImageArea& area) const;
  Features Corners(const ResponseWriter& write, const ImageArea& all, const ImageArea& area,
                   double threshold) const;
  Features CornersOf(const GradientSums& sums, const ImageArea& area, double weight) const;
  Features DetectByThreshold(const GrayImage& image) const;
  void AddByWeight(const GrayImage& image, const ImageArea& region, Features& features) const;

  FeatureDetectorParams params_;
  ImageSize size_;
  Image<std::uint8_t> allowed_;
  // The number of the region of a pixel is the sum of its row's and its column's.
  std::vector<std::size_t> of_row_;
  std::vector<std::size_t> of_column_;
};

}  // namespace rockyard::vision
