#include "vision/odometry/detect_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/check.h"

namespace rockyard::vision {
namespace {

int PartOf(int whole, std::int64_t part, std::int64_t parts) {
  return static_cast<int>(static_cast<std::int64_t>(whole) * part / parts);
}

// Returns, for each pixel of a side, the number of its part times `step`.
std::vector<std::size_t> PartsOf(int whole, std::int64_t parts, std::int64_t step) {
  std::vector<std::size_t> numbers(static_cast<std::size_t>(whole));
  for (std::int64_t part = 0; part < parts; ++part) {
    std::fill(numbers.begin() + PartOf(whole, part, parts),
              numbers.begin() + PartOf(whole, part + 1, parts),
              static_cast<std::size_t>(part * step));
  }
  return numbers;
}

// Returns the pixels that features may lie on: `border` away from the edges and from pixels that
// are not free.
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

// Keeps the `most` strongest features, from the strongest on. Must stay: of equal ones the earlier
// in the order of rows comes first.
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
      allowed_(AllowedPixels(size, static_cast<int>(params.border_px), free)),
      of_row_(PartsOf(size.rows, params.regions_down, params.regions_across)),
      of_column_(PartsOf(size.columns, params.regions_across, 1)) {
  EXPECT(free.empty() || (free.width() == size.columns && free.height() == size.rows));
}

ImageArea FeatureDetector::Region(std::int64_t across, std::int64_t down) const {
  return {PartOf(size_.columns, across, params_.regions_across),
          PartOf(size_.columns, across + 1, params_.regions_across),
          PartOf(size_.rows, down, params_.regions_down),
          PartOf(size_.rows, down + 1, params_.regions_down)};
}

GradientSums FeatureDetector::SumsAround(const GrayImage& image, const ImageArea& area) const {
  return {image,
          Widened(area, static_cast<int>(params_.suppression_px), size_.columns, size_.rows)};
}

Features FeatureDetector::Corners(const ResponseWriter& write, const ImageArea& all,
                                  const ImageArea& area, double threshold) const {
  Features corners =
      LocalMaxima(write, all, area, static_cast<int>(params_.suppression_px), Whole(threshold));
  std::erase_if(corners,
                [&](const Feature& corner) { return allowed_.At(corner.column, corner.row) == 0; });
  return corners;
}

Features FeatureDetector::CornersOf(const GradientSums& sums, const ImageArea& area,
                                    double weight) const {
  const std::int32_t whole = HarrisWeight(weight);
  const auto write = [&](int row, std::int32_t* response) {
    sums.WriteResponse(row, whole, response);
  };
  return Corners(write, sums.area(), area, params_.threshold);
}

// Detects in the whole image at once, as all regions have one weight and so one response.
Features FeatureDetector::DetectByThreshold(const GrayImage& image) const {
  const ImageArea all{0, size_.columns, 0, size_.rows};
  HarrisRows rows(image, all, HarrisWeight(params_.weight));
  const auto write = [&](int row, std::int32_t* response) { rows.WriteResponse(row, response); };
  const Features corners = Corners(write, all, all, params_.min_threshold);
  std::vector<Features> regions(static_cast<std::size_t>(params_.regions()));
  for (const Feature& corner : corners) {
    regions[of_row_[static_cast<std::size_t>(corner.row)] +
            of_column_[static_cast<std::size_t>(corner.column)]]
        .push_back(corner);
  }
  const auto least = static_cast<std::size_t>(params_.min_of_region());
  const auto most = static_cast<std::size_t>(params_.max_of_region());
  Features features;
  for (Features& region : regions) {
    const auto strong = static_cast<std::size_t>(std::count_if(
        region.begin(), region.end(),
        [&](const Feature& corner) { return corner.strength >= Whole(params_.threshold); }));
    KeepStrongest(std::clamp(strong, std::min(least, most), most), region);
    features.insert(features.end(), region.begin(), region.end());
  }
  return features;
}

void FeatureDetector::AddByWeight(const GrayImage& image, const ImageArea& region,
                                  Features& features) const {
  constexpr int kBisections = 8;
  // Must be the bound of `weight` in FeatureDetectorParams::Visit: from 1/4 on det - k trace^2 is
  // never positive.
  constexpr double kLargestWeight = 0.24;
  const auto least = static_cast<std::size_t>(params_.min_of_region());
  const auto most = static_cast<std::size_t>(params_.max_of_region());
  const GradientSums sums = SumsAround(image, region);
  double low = 0.0;
  double high = kLargestWeight;
  double weight = params_.weight;
  Features corners = CornersOf(sums, region, weight);
  for (int i = 0; i < kBisections && (corners.size() < least || corners.size() > most); ++i) {
    // A larger weight lowers all responses.
    (corners.size() > most ? low : high) = weight;
    weight = 0.5 * (low + high);
    corners = CornersOf(sums, region, weight);
  }
  KeepStrongest(most, corners);
  features.insert(features.end(), corners.begin(), corners.end());
}

Features FeatureDetector::Detect(const GrayImage& image) const {
  EXPECT(image.width() == size_.columns && image.height() == size_.rows);
  if (params_.adapted == Adapted::kThreshold) return DetectByThreshold(image);
  Features features;
  for (std::int64_t down = 0; down < params_.regions_down; ++down) {
    for (std::int64_t across = 0; across < params_.regions_across; ++across) {
      AddByWeight(image, Region(across, down), features);
    }
  }
  return features;
}

}  // namespace rockyard::vision
