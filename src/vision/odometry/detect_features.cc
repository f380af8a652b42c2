#include "vision/odometry/detect_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/check.h"
#include "vision/odometry/local_maxima.h"

namespace rockyard::vision {
namespace {

int PartOf(int whole, std::int64_t part, std::int64_t parts) {
  return static_cast<int>(static_cast<std::int64_t>(whole) * part / parts);
}

// Pixels that features may lie on: `border` away from the edges and from what is not free.
Image<std::uint8_t> AllowedPixels(const ImageSize& size, int border,
                                  const Image<std::uint8_t>& free) {
  Image<std::uint8_t> allowed(size.columns, size.rows, 0);
  const auto is_free = [&](int x, int y) { return free.empty() || free.At(x, y) != 0; };
  // Free pixels in a row of 2 border + 1 about each pixel, then such rows in a column.
  Image<std::uint8_t> rows_free(size.columns, size.rows, 0);
  for (int y = 0; y < size.rows; ++y) {
    int run = 0;
    for (int x = 0; x < size.columns; ++x) {
      run = is_free(x, y) ? run + 1 : 0;
      if (run > 2 * border) rows_free.At(x - border, y) = 1;
    }
  }
  for (int x = 0; x < size.columns; ++x) {
    int run = 0;
    for (int y = 0; y < size.rows; ++y) {
      run = rows_free.At(x, y) != 0 ? run + 1 : 0;
      if (run > 2 * border) allowed.At(x, y - border) = 1;
    }
  }
  return allowed;
}

std::int32_t Whole(double threshold) { return static_cast<std::int32_t>(std::lround(threshold)); }

// Of features in the order of rows, the `most` strongest, from the strongest on; of equal ones the
// earlier is the stronger.
void KeepStrongest(std::size_t most, Features& features) {
  const auto stronger = [](const Feature& a, const Feature& b) {
    if (a.strength != b.strength) return a.strength > b.strength;
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  };
  if (features.size() > most) {
    const auto end = features.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(features.begin(), end, features.end(), stronger);
    features.erase(end, features.end());
  }
  std::sort(features.begin(), features.end(), stronger);
}

}  // namespace

FeatureDetector::FeatureDetector(const FeatureDetectorParams& params, const ImageSize& size,
                                 const Image<std::uint8_t>& free)
    : params_(params),
      size_(size),
      allowed_(AllowedPixels(size, static_cast<int>(params.border_px), free)) {
  EXPECT(free.empty() || (free.width() == size.columns && free.height() == size.rows));
}

ImageArea FeatureDetector::Region(std::int64_t across, std::int64_t down) const {
  return {PartOf(size_.columns, across, params_.regions_across),
          PartOf(size_.columns, across + 1, params_.regions_across),
          PartOf(size_.rows, down, params_.regions_down),
          PartOf(size_.rows, down + 1, params_.regions_down)};
}

GradientSums FeatureDetector::SumsAround(const GrayImage& image, const ImageArea& area) const {
  return {image, Widened(area, static_cast<int>(params_.suppression_px), size_.columns, size_.rows)};
}

Features FeatureDetector::Corners(const GradientSums& sums, const ImageArea& area, double weight,
                                  double threshold) const {
  Features corners = LocalMaxima(sums, HarrisWeight(weight), area,
                                 static_cast<int>(params_.suppression_px), Whole(threshold));
  std::erase_if(corners, [&](const Feature& corner) {
    return allowed_.At(corner.column, corner.row) == 0;
  });
  return corners;
}

// All regions of a row of them have one weight, hence one response.
void FeatureDetector::AddByThreshold(const GrayImage& image, std::int64_t down,
                                     Features& features) const {
  const ImageArea first = Region(0, down);
  const ImageArea band{0, size_.columns, first.top, first.bottom};
  const Features corners =
      Corners(SumsAround(image, band), band, params_.weight, params_.min_threshold);
  std::vector<Features> regions(static_cast<std::size_t>(params_.regions_across));
  std::vector<std::size_t> of_column(static_cast<std::size_t>(size_.columns));
  for (std::int64_t across = 0; across < params_.regions_across; ++across) {
    const ImageArea region = Region(across, down);
    std::fill(of_column.begin() + region.left, of_column.begin() + region.right,
              static_cast<std::size_t>(across));
  }
  for (const Feature& corner : corners) {
    regions[of_column[static_cast<std::size_t>(corner.column)]].push_back(corner);
  }
  const auto least = static_cast<std::size_t>(params_.min_of_region());
  const auto most = static_cast<std::size_t>(params_.max_of_region());
  for (Features& region : regions) {
    const auto strong = static_cast<std::size_t>(
        std::count_if(region.begin(), region.end(), [&](const Feature& corner) {
          return corner.strength >= Whole(params_.threshold);
        }));
    KeepStrongest(std::clamp(strong, std::min(least, most), most), region);
    features.insert(features.end(), region.begin(), region.end());
  }
}

void FeatureDetector::AddByWeight(const GrayImage& image, const ImageArea& region,
                                  Features& features) const {
  constexpr int kBisections = 8;
  constexpr double kLargestWeight = 0.24;
  const auto least = static_cast<std::size_t>(params_.min_of_region());
  const auto most = static_cast<std::size_t>(params_.max_of_region());
  const GradientSums sums = SumsAround(image, region);
  double low = 0.0;
  double high = kLargestWeight;
  double weight = params_.weight;
  Features corners = Corners(sums, region, weight, params_.threshold);
  for (int i = 0; i < kBisections && (corners.size() < least || corners.size() > most); ++i) {
    (corners.size() > most ? low : high) = weight;
    weight = 0.5 * (low + high);
    corners = Corners(sums, region, weight, params_.threshold);
  }
  KeepStrongest(most, corners);
  features.insert(features.end(), corners.begin(), corners.end());
}

Features FeatureDetector::Detect(const GrayImage& image) const {
  EXPECT(image.width() == size_.columns && image.height() == size_.rows);
  Features features;
  for (std::int64_t down = 0; down < params_.regions_down; ++down) {
    if (params_.adapted == Adapted::kThreshold) {
      AddByThreshold(image, down, features);
      continue;
    }
    for (std::int64_t across = 0; across < params_.regions_across; ++across) {
      AddByWeight(image, Region(across, down), features);
    }
  }
  return features;
}

}  // namespace rockyard::vision
