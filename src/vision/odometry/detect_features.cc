#include "vision/odometry/detect_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"
#include "vision/odometry/harris.h"

namespace rockyard::vision {
namespace {

// Columns from `left` to before `right`, rows likewise.
struct Region {
  int left = 0;
  int right = 0;
  int top = 0;
  int bottom = 0;
};

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

// The corners of one region by one weight.
class RegionCorners {
 public:
  RegionCorners(const GradientSums& sums, const Image<std::uint8_t>& allowed, const Region& region,
                int reach)
      : sums_(sums),
        allowed_(allowed),
        region_(region),
        reach_(reach),
        first_column_(std::max(region.left - reach, 0)),
        first_row_(std::max(region.top - reach, 0)),
        response_(std::min(region.right + reach, sums.xx.width()) - first_column_,
                  std::min(region.bottom + reach, sums.xx.height()) - first_row_) {}

  // From the strongest on.
  Features Find(double weight, std::int32_t threshold) {
    HarrisResponse(sums_, HarrisWeight(weight), first_column_, first_row_, response_);
    Features corners;
    for (int y = region_.top; y < region_.bottom; ++y) {
      for (int x = region_.left; x < region_.right; ++x) {
        if (allowed_.At(x, y) == 0) continue;
        const std::int32_t value = response_.At(x - first_column_, y - first_row_);
        if (value < threshold || !IsLargest(x - first_column_, y - first_row_, value)) continue;
        corners.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), value});
      }
    }
    std::stable_sort(corners.begin(), corners.end(),
                     [](const Feature& a, const Feature& b) { return a.strength > b.strength; });
    return corners;
  }

 private:
  bool IsLargest(int x, int y, std::int32_t value) const {
    const int last_row = std::min(y + reach_, response_.height() - 1);
    const int first = std::max(x - reach_, 0);
    const int last = std::min(x + reach_, response_.width() - 1);
    for (int row = std::max(y - reach_, 0); row <= last_row; ++row) {
      for (int column = first; column <= last; ++column) {
        const std::int32_t other = response_.At(column, row);
        const bool before = row < y || (row == y && column < x);
        if (before ? other >= value : other > value) return false;
      }
    }
    return true;
  }

  const GradientSums& sums_;
  const Image<std::uint8_t>& allowed_;
  Region region_;
  int reach_;
  int first_column_;
  int first_row_;
  Image<std::int32_t> response_;
};

std::int32_t Whole(double threshold) { return static_cast<std::int32_t>(std::lround(threshold)); }

std::size_t CountFrom(const Features& sorted, std::int32_t threshold) {
  return static_cast<std::size_t>(
      std::find_if(sorted.begin(), sorted.end(),
                   [&](const Feature& corner) { return corner.strength < threshold; }) -
      sorted.begin());
}

Features ByThreshold(const FeatureDetectorParams& params, RegionCorners& region) {
  Features corners = region.Find(params.weight, Whole(params.min_threshold));
  std::size_t count = CountFrom(corners, Whole(params.threshold));
  const auto least = static_cast<std::size_t>(params.min_of_region());
  const auto most = static_cast<std::size_t>(params.max_of_region());
  count = std::min(std::clamp(count, std::min(least, most), most), corners.size());
  corners.resize(count);
  return corners;
}

Features ByWeight(const FeatureDetectorParams& params, RegionCorners& region) {
  constexpr int kBisections = 8;
  constexpr double kLargestWeight = 0.24;
  const auto least = static_cast<std::size_t>(params.min_of_region());
  const auto most = static_cast<std::size_t>(params.max_of_region());
  double low = 0.0;
  double high = kLargestWeight;
  double weight = params.weight;
  Features corners = region.Find(weight, Whole(params.threshold));
  for (int i = 0; i < kBisections && (corners.size() < least || corners.size() > most); ++i) {
    (corners.size() > most ? low : high) = weight;
    weight = 0.5 * (low + high);
    corners = region.Find(weight, Whole(params.threshold));
  }
  if (corners.size() > most) corners.resize(most);
  return corners;
}

}  // namespace

FeatureDetector::FeatureDetector(const FeatureDetectorParams& params, const ImageSize& size,
                                 const Image<std::uint8_t>& free)
    : params_(params),
      size_(size),
      allowed_(AllowedPixels(size, static_cast<int>(params.border_px), free)) {
  EXPECT(free.empty() || (free.width() == size.columns && free.height() == size.rows));
}

Features FeatureDetector::Detect(const GrayImage& image) const {
  EXPECT(image.width() == size_.columns && image.height() == size_.rows);
  const GradientSums sums = GradientSumsOf(image);
  Features features;
  for (std::int64_t down = 0; down < params_.regions_down; ++down) {
    for (std::int64_t across = 0; across < params_.regions_across; ++across) {
      const Region region{PartOf(size_.columns, across, params_.regions_across),
                          PartOf(size_.columns, across + 1, params_.regions_across),
                          PartOf(size_.rows, down, params_.regions_down),
                          PartOf(size_.rows, down + 1, params_.regions_down)};
      RegionCorners corners(sums, allowed_, region, static_cast<int>(params_.suppression_px));
      const Features found = params_.adapted == Adapted::kThreshold ? ByThreshold(params_, corners)
                                                                    : ByWeight(params_, corners);
      features.insert(features.end(), found.begin(), found.end());
    }
  }
  return features;
}

}  // namespace rockyard::vision
