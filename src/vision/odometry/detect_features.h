// Corners of an image, evenly over its regions (Howard 2012 section 2): the first stage of
// VisualOdometer.
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
// corner is a pixel that LocalMaxima (harris.h) finds within suppression_px. The strongest
// max_of_region() corners of a region that reach the threshold are its features. Where these are
// fewer than min_of_region(), weaker corners follow down to min_threshold (Adapted::kThreshold); or
// the weight of the trace is bisected between 0 and 0.24, eight times at most, until the number
// lies between both (Adapted::kWeight).
class FeatureDetector {
 public:
  // `free` has the images' size, and is 1 where a pixel shows the world and 0 where it shows the
  // rover; it is empty where all pixels show the world. Features keep border_px from the edges and
  // from pixels that are not free.
  FeatureDetector(const FeatureDetectorParams& params, const ImageSize& size,
                  const Image<std::uint8_t>& free = {});

  // Returns the features of `image`, which has the detector's size: region by region in the order
  // of rows, within a region from the strongest on, of equal ones in the order of rows. Records
  // depend on this order, as matching decides ties by it. Cost: 0.4 ms for 512 x 384 pixels with
  // 64 bytes a vector, eight times that where the weight is adapted.
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
  // The number of a pixel's region is the sum of its row's and its column's number.
  std::vector<std::size_t> of_row_;
  std::vector<std::size_t> of_column_;
};

}  // namespace rockyard::vision
