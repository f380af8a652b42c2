#include "plain_features.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <tuple>

#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

// Division by 2^shift that rounds down, without a shift.
std::int64_t DownBy(std::int64_t value, int shift) {
  const std::int64_t divisor = std::int64_t{1} << shift;
  const std::int64_t rest = ((value % divisor) + divisor) % divisor;
  return (value - rest) / divisor;
}

// Gradients of a pixel that has eight neighbours.
struct PlainGradient {
  PlainGradient() = default;
  PlainGradient(const GrayImage& image, int x, int y) {
    constexpr int kWeights[3] = {1, 2, 1};
    for (int i = -1; i <= 1; ++i) {
      gx += kWeights[i + 1] * (image.At(x + 1, y + i) - image.At(x - 1, y + i));
      gy += kWeights[i + 1] * (image.At(x + i, y + 1) - image.At(x + i, y - 1));
    }
    gx = std::clamp<std::int64_t>(DownBy(gx + 1, 1), -63, 63);
    gy = std::clamp<std::int64_t>(DownBy(gy + 1, 1), -63, 63);
  }

  std::int64_t gx = 0;
  std::int64_t gy = 0;
};

std::int64_t ResponseAt(const Image<PlainGradient>& gradients, int x, int y, std::int64_t weight) {
  std::int64_t xx = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
  for (int column = x - 2; column <= x + 2; ++column) {
    std::int64_t column_xx = 0;
    std::int64_t column_xy = 0;
    std::int64_t column_yy = 0;
    for (int row = y - 2; row <= y + 2; ++row) {
      const PlainGradient& at = gradients.At(column, row);
      column_xx += at.gx * at.gx;
      column_xy += at.gx * at.gy;
      column_yy += at.gy * at.gy;
    }
    xx += DownBy(column_xx, 2);
    xy += DownBy(column_xy, 2);
    yy += DownBy(column_yy, 2);
  }
  const std::int64_t half_trace = DownBy(xx + yy, 1);
  return xx * yy - xy * xy - DownBy(half_trace * half_trace, 8) * weight;
}

// Whether a pixel is `border` away from every edge and from all that is not free.
bool IsAllowed(const Image<std::uint8_t>& free, int width, int height, int border, int x, int y) {
  if (x < border || y < border || x + border >= width || y + border >= height) return false;
  if (free.empty()) return true;
  for (int row = y - border; row <= y + border; ++row) {
    for (int column = x - border; column <= x + border; ++column) {
      if (free.At(column, row) == 0) return false;
    }
  }
  return true;
}

struct PlainRegion {
  int left, right, top, bottom;
};

// Those of an image, by weight.
using Responses = std::map<std::int64_t, Image<std::int64_t>>;

// From the strongest on, of equal ones in the order of rows.
Features CornersOf(const GrayImage& image, const FeatureDetectorParams& params,
                   const Image<std::uint8_t>& free, const PlainRegion& region, double weight,
                   double threshold, Responses& responses) {
  const std::int64_t whole = std::lround(1024.0 * weight);
  const auto found = responses.find(whole);
  const Image<std::int64_t>& response =
      found != responses.end()
          ? found->second
          : responses.emplace(whole, PlainResponse(image, whole)).first->second;
  Features corners;
  for (int y = region.top; y < region.bottom; ++y) {
    for (int x = region.left; x < region.right; ++x) {
      if (response.At(x, y) >= std::lround(threshold) &&
          IsAllowed(free, image.width(), image.height(), static_cast<int>(params.border_px), x,
                    y) &&
          IsPeak(response, x, y, static_cast<int>(params.suppression_px))) {
        corners.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
                           static_cast<std::int32_t>(response.At(x, y))});
      }
    }
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Feature& a, const Feature& b) { return a.strength > b.strength; });
  return corners;
}

Features OfRegion(const GrayImage& image, const FeatureDetectorParams& params,
                  const Image<std::uint8_t>& free, const PlainRegion& region,
                  Responses& responses) {
  const auto least = static_cast<std::size_t>(params.min_of_region());
  const auto most = static_cast<std::size_t>(params.max_of_region());
  if (params.adapted == Adapted::kThreshold) {
    Features corners =
        CornersOf(image, params, free, region, params.weight, params.min_threshold, responses);
    while (!corners.empty() &&
           (corners.size() > most ||
            (corners.size() > least && corners.back().strength < std::lround(params.threshold)))) {
      corners.pop_back();
    }
    return corners;
  }
  double low = 0.0, high = 0.24;
  double weight = params.weight;
  Features corners;
  for (int tries = 0; tries <= 8; ++tries) {
    corners = CornersOf(image, params, free, region, weight, params.threshold, responses);
    if (corners.size() >= least && corners.size() <= most) break;
    if (corners.size() > most) {
      low = weight;
    } else {
      high = weight;
    }
    weight = (low + high) / 2.0;
  }
  while (corners.size() > most) corners.pop_back();
  return corners;
}

// What two features differ by, where they are compared.
using Differences = Image<std::optional<int>>;

Differences DifferencesOf(const GrayImage& first, const Features& first_features,
                          const GrayImage& second, const Features& second_features,
                          const FeatureMatcherParams& params, const PredictedFeatures& predicted) {
  const int side = static_cast<int>(params.window_px);
  Differences differences(static_cast<int>(second_features.size()),
                          static_cast<int>(first_features.size()));
  std::vector<PlainWindow> windows;
  for (const Feature& feature : second_features) {
    windows.push_back(PlainWindowAt(second, feature, side));
  }
  for (std::size_t i = 0; i < first_features.size(); ++i) {
    const bool warp = params.warp == MatchWarp::kPredicted && !predicted.empty();
    const PlainWindow window =
        warp ? PlainWarpedWindow(first, first_features[i], predicted[i].view.by_offset, side)
             : PlainWindowAt(first, first_features[i], side);
    for (std::size_t j = 0; j < second_features.size(); ++j) {
      if (params.search == MatchSearch::kPredicted && !predicted.empty() &&
          !(std::abs(predicted[i].pixel.x() - second_features[j].column) <=
                params.search_columns_px &&
            std::abs(predicted[i].pixel.y() - second_features[j].row) <= params.search_rows_px)) {
        continue;
      }
      differences.At(static_cast<int>(j), static_cast<int>(i)) =
          PlainDifference(window, windows[j]);
    }
  }
  return differences;
}

}  // namespace

int PlainDifference(const PlainWindow& a, const PlainWindow& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

Image<std::int64_t> PlainResponse(const GrayImage& image, std::int64_t weight) {
  Image<std::int64_t> response(image.width(), image.height(), 0);
  Image<PlainGradient> gradients(image.width(), image.height());
  for (int y = 1; y + 1 < image.height(); ++y) {
    for (int x = 1; x + 1 < image.width(); ++x) gradients.At(x, y) = PlainGradient(image, x, y);
  }
  for (int y = 3; y + 3 < image.height(); ++y) {
    for (int x = 3; x + 3 < image.width(); ++x) {
      response.At(x, y) = ResponseAt(gradients, x, y, weight);
    }
  }
  return response;
}

bool IsPeak(const Image<std::int64_t>& response, int x, int y, int reach) {
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, response.height() - 1); ++row) {
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, response.width() - 1);
         ++column) {
      if (row == y && column == x) continue;
      const bool before = std::tie(row, column) < std::tie(y, x);
      const std::int64_t other = response.At(column, row);
      if (other > response.At(x, y) || (before && other == response.At(x, y))) return false;
    }
  }
  return true;
}

Features PlainFeatures(const GrayImage& image, const FeatureDetectorParams& params,
                       const Image<std::uint8_t>& free) {
  const auto across = static_cast<int>(params.regions_across);
  const auto down = static_cast<int>(params.regions_down);
  Features features;
  Responses responses;
  ForEachPixel(across, down, [&](int i, int j) {
    const PlainRegion region{i * image.width() / across, (i + 1) * image.width() / across,
                             j * image.height() / down, (j + 1) * image.height() / down};
    for (const Feature& feature : OfRegion(image, params, free, region, responses)) {
      features.push_back(feature);
    }
  });
  return features;
}

PlainWindow PlainWindowAt(const GrayImage& image, const Feature& feature, int side) {
  PlainWindow window;
  for (int row = -(side / 2); row <= side / 2; ++row) {
    for (int column = -(side / 2); column <= side / 2; ++column) {
      window.push_back(image.At(feature.column + column, feature.row + row));
    }
  }
  return window;
}

PlainWindow PlainWarpedWindow(const GrayImage& image, const Feature& feature,
                              const Eigen::Matrix2d& by_offset, int side) {
  const auto fixed = [](double value) {
    return static_cast<std::int64_t>(std::floor(std::clamp(value, -64.0, 64.0) * 4096.0 + 0.5));
  };
  const auto grey = [&](std::int64_t x, std::int64_t y) {
    return static_cast<std::int64_t>(
        image.At(static_cast<int>(std::clamp<std::int64_t>(x, 0, image.width() - 1)),
                 static_cast<int>(std::clamp<std::int64_t>(y, 0, image.height() - 1))));
  };
  PlainWindow window;
  for (int row = -(side / 2); row <= side / 2; ++row) {
    for (int column = -(side / 2); column <= side / 2; ++column) {
      const std::int64_t x =
          DownBy(fixed(by_offset(0, 0)) * column + fixed(by_offset(0, 1)) * row + 8, 4);
      const std::int64_t y =
          DownBy(fixed(by_offset(1, 0)) * column + fixed(by_offset(1, 1)) * row + 8, 4);
      const std::int64_t left = feature.column + DownBy(x, 8);
      const std::int64_t top = feature.row + DownBy(y, 8);
      const std::int64_t u = x - 256 * DownBy(x, 8);
      const std::int64_t v = y - 256 * DownBy(y, 8);
      const std::int64_t sum =
          (256 - u) * (256 - v) * grey(left, top) + u * (256 - v) * grey(left + 1, top) +
          (256 - u) * v * grey(left, top + 1) + u * v * grey(left + 1, top + 1);
      window.push_back(static_cast<int>(DownBy(sum + 32768, 16)));
    }
  }
  return window;
}

FeatureMatches PlainMatches(const GrayImage& first, const Features& first_features,
                            const GrayImage& second, const Features& second_features,
                            const FeatureMatcherParams& params,
                            const PredictedFeatures& predicted) {
  const Differences differences =
      DifferencesOf(first, first_features, second, second_features, params, predicted);
  const double most =
      params.max_difference * static_cast<double>(params.window_px * params.window_px);
  FeatureMatches matches;
  for (int i = 0; i < differences.height(); ++i) {
    // All that the feature was compared with, the best first.
    std::vector<std::tuple<int, int>> ranked;
    for (int j = 0; j < differences.width(); ++j) {
      if (differences.At(j, i)) ranked.emplace_back(*differences.At(j, i), j);
    }
    std::sort(ranked.begin(), ranked.end());
    if (ranked.empty()) continue;
    const auto [difference, j] = ranked.front();
    if (difference > most) continue;
    if (ranked.size() > 1 && params.ratio < 1.0 &&
        difference > params.ratio * std::get<0>(ranked[1])) {
      continue;
    }
    bool is_mutual = true;
    for (int other = 0; other < differences.height(); ++other) {
      const std::optional<int>& rival = differences.At(j, other);
      if (rival && std::tie(*rival, other) < std::tie(difference, i)) is_mutual = false;
    }
    if (is_mutual || !params.mutual) matches.push_back({i, j, difference});
  }
  return matches;
}

}  // namespace rockyard::vision
